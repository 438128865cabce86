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

/// The six bits of a digit of base64; -1 if it is none.
int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
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

std::optional<std::vector<unsigned char>> decodeDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!isDataUri(uri) || comma == std::string_view::npos) return std::nullopt;
  const std::string_view content = uri.substr(comma + 1);
  if (uri.substr(0, comma).ends_with(";base64")) return decodeBase64(content);
  const std::string decoded = percentDecode(content);
  return std::vector<unsigned char>(decoded.begin(), decoded.end());
}

std::optional<std::vector<unsigned char>> decodeBase64(std::string_view base64) {
  std::size_t padding = 0;
  while (padding < 2 && base64.ends_with('=')) {
    base64.remove_suffix(1);
    ++padding;
  }
  const std::size_t rest = base64.size() % 4;
  if (rest == 1 || (padding != 0 && rest + padding != 4)) return std::nullopt;
  std::vector<unsigned char> bytes;
  bytes.reserve(base64.size() / 4 * 3 + 2);
  unsigned pending = 0;
  int bits = 0;
  for (const char c : base64) {
    const int digit = base64Digit(c);
    if (digit < 0) return std::nullopt;
    pending = (pending << 6 | static_cast<unsigned>(digit)) & 0xFFFFu;
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(pending >> bits & 0xFFu));
  }
  return bytes;
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

UriFile resolveUri(const AssetFolder& folder, std::string_view uri) {
  if (uri.empty()) return {UriFault::empty};
  if (hasScheme(uri)) return {UriFault::scheme};
  std::string decoded = percentDecode(uri);
  if (decoded.find('\0') != std::string::npos) return {UriFault::nul};
  const bool hadBackslashes = decoded.find('\\') != std::string::npos;
  std::replace(decoded.begin(), decoded.end(), '\\', '/');
  const std::filesystem::path normal = std::filesystem::path(decoded).lexically_normal();
  const bool isOutside = normal.empty() || normal.is_absolute() || *normal.begin() == "..";
  if (isOutside && folder.outside == OutsideFiles::refused) return {UriFault::outside};
  return {UriFault::none, folder.path / normal, hadBackslashes};
}

bool leadsOutside(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path inside = std::filesystem::weakly_canonical(folder, error);
  const std::filesystem::path found = std::filesystem::weakly_canonical(file, error);
  return std::mismatch(inside.begin(), inside.end(), found.begin(), found.end()).first != inside.end();
}

}  // namespace importon
