/// URIs of external buffers and images.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace importon {

[[nodiscard]] bool isDataUri(std::string_view uri);

/// The bytes of a data URI, whatever media type it names or leaves out [RFC 2397]; empty if it has no comma or its
/// base64 is malformed.
[[nodiscard]] std::optional<std::vector<unsigned char>> decodeDataUri(std::string_view uri);

/// The bytes of `base64`; empty if it is malformed (foreign characters, wrong length or padding).
[[nodiscard]] std::optional<std::vector<unsigned char>> decodeBase64(std::string_view base64);

/// Replaces %XX by the byte. What isn't a valid escape stays as it is.
[[nodiscard]] std::string percentDecode(std::string_view uri);

/// Whether an asset may name files outside its folder.
enum class OutsideFiles { refused, allowed };

/// Where the external files of an asset lie.
struct AssetFolder {
  std::filesystem::path path;  // relative URIs start here; empty: no external files
  OutsideFiles outside = OutsideFiles::refused;
};

/// Why a URI names no file that may be read.
enum class UriFault { none, empty, scheme, nul, outside };

/// What a URI names.
struct UriFile {
  UriFault fault = UriFault::none;
  std::filesystem::path path{};  // without fault
  bool hadBackslashes = false;   // they stand for slashes, which a URI has
};

/// The file that a URI names. A scheme ("http:", or the "C:" of a drive) is looked for before percent-decoding, as RFC
/// 3986 says: "a%3Ab.png" is a file. Outside: it leaves the folder by its words (absolute, "..") where that is refused.
[[nodiscard]] UriFile resolveUri(const AssetFolder& folder, std::string_view uri);

/// True where symbolic links lead from `folder` to a file outside it.
[[nodiscard]] bool leadsOutside(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace importon
