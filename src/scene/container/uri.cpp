#include "scene/container/uri.h"

#include <algorithm>
#include <cctype>

namespace importon {
namespace {

constexpr std::string_view kDataScheme = "data:";

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool isBase64Digit(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
}

/// "http://host", "C:..." and the like: letters, digits, '+', '-', '.' and then a colon [RFC 3986,
/// section 3.1].
bool hasScheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
  });
}

}  // namespace

bool isDataUri(std::string_view uri) { return uri.starts_with(kDataScheme); }

std::optional<DataUri> parseDataUri(std::string_view uri) {
  constexpr std::string_view kBase64 = ";base64";
  const std::size_t comma = uri.find(',');
  if (!isDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
  std::string_view head = uri.substr(kDataScheme.size(), comma - kDataScheme.size());
  if (!head.ends_with(kBase64)) return std::nullopt;
  head.remove_suffix(kBase64.size());
  return DataUri{head, uri.substr(comma + 1)};
}

std::optional<std::size_t> base64DecodedSize(std::string_view base64) {
  std::size_t padding = 0;
  while (padding < 2 && base64.ends_with('=')) {
    base64.remove_suffix(1);
    ++padding;
  }
  const std::size_t rest = base64.size() % 4;
  if (rest == 1 || (padding != 0 && rest + padding != 4)) return std::nullopt;
  if (!std::all_of(base64.begin(), base64.end(), isBase64Digit)) return std::nullopt;
  return base64.size() / 4 * 3 + (rest == 0 ? 0 : rest - 1);
}

std::string percentDecode(std::string_view uri) {
  std::string decoded;
  decoded.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hexDigit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hexDigit(uri[i + 2]) : -1;
    if (low >= 0) {
      decoded += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      decoded += uri[i];
    }
  }
  return decoded;
}

std::optional<std::filesystem::path> resolveUri(const AssetFolder& folder, const std::string& decodedUri) {
  const bool isNoPath = decodedUri.empty() || decodedUri.find('\0') != std::string::npos ||
                        decodedUri.find('\\') != std::string::npos || hasScheme(decodedUri);
  if (isNoPath) return std::nullopt;
  const std::filesystem::path normal = std::filesystem::path(decodedUri).lexically_normal();
  const bool isOutside = normal.empty() || normal.is_absolute() || *normal.begin() == "..";
  if (isOutside && folder.outside == OutsideFiles::refused) return std::nullopt;
  return folder.path / normal;
}

bool leadsOutside(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path inside = std::filesystem::weakly_canonical(folder, error);
  const std::filesystem::path found = std::filesystem::weakly_canonical(file, error);
  return std::mismatch(inside.begin(), inside.end(), found.begin(), found.end()).first != inside.end();
}

}  // namespace importon
