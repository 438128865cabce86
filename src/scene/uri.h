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

/// The file that a decoded relative URI names below `folder`; empty if it would leave the folder (absolute, a
/// drive, "..", a scheme) or holds a NUL.
[[nodiscard]] std::optional<std::filesystem::path> resolveInFolder(const std::filesystem::path& folder,
                                                                   const std::string& decodedUri);

}  // namespace importon
