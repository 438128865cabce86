/// URIs of external buffers and images.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace importon {

/// The head of a "data:" URI whose content is base64.
struct DataUri {
  std::string_view mediaType;
  std::string_view base64;
};

[[nodiscard]] bool isDataUri(std::string_view uri);

/// Takes a data URI apart; empty if it isn't base64.
[[nodiscard]] std::optional<DataUri> parseDataUri(std::string_view uri);

/// How many bytes `base64` decodes to; empty if it is malformed (foreign characters, wrong length or padding).
[[nodiscard]] std::optional<std::size_t> base64DecodedSize(std::string_view base64);

/// Replaces %XX by the byte. What isn't a valid escape stays as it is.
[[nodiscard]] std::string percentDecode(std::string_view uri);

/// Whether an asset may name files outside its folder.
enum class OutsideFiles { refused, allowed };

/// Where the external files of an asset lie.
struct AssetFolder {
  std::filesystem::path path;  // relative URIs start here; empty: no external files
  OutsideFiles outside = OutsideFiles::refused;
};

/// The file that a decoded URI names; empty if it is no path (a scheme, a drive, a NUL) or leaves the folder by its
/// words (absolute, "..") where that is refused.
[[nodiscard]] std::optional<std::filesystem::path> resolveUri(const AssetFolder& folder, const std::string& decodedUri);

/// True where symbolic links lead from `folder` to a file outside it.
[[nodiscard]] bool leadsOutside(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace importon
