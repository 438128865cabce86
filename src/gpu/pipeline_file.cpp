#include "gpu/pipeline_file.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "base/hash.h"

namespace importon::gpu {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "pipelines-";

/// What stands before the data.
struct Header {
  std::array<char, 8> magic{'i', 'm', 'p', 'p', 'i', 'p', 'e', '1'};
  std::uint64_t key = 0, bytes = 0, hash = 0;  // of the data
  bool operator==(const Header&) const = default;
};

std::uint64_t hashOf(std::span<const std::byte> data) {
  ContentHash hash;
  hash.add(data);
  return hash.value();
}

std::uint64_t hashOf(const PipelineKey& key) {
  ContentHash hash;
  hash.add(std::as_bytes(std::span(key.cacheId)));
  const std::array<std::uint64_t, 4> numbers{key.vendor, key.device, key.driver, key.kernels};
  hash.add(std::as_bytes(std::span(numbers)));
  return hash.value();
}

std::string nameOf(std::uint64_t key) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  constexpr int kBits = 64, kDigitBits = 4;
  std::string name(kPrefix);
  for (int shift = kBits - kDigitBits; shift >= 0; shift -= kDigitBits) name += kDigits[key >> shift & 15u];
  return name;
}

Header headerOf(std::uint64_t key, std::span<const std::byte> data) {
  Header header;
  header.key = key;
  header.bytes = data.size();
  header.hash = hashOf(data);
  return header;
}

bool writeAll(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return true;
}

/// Under a temporary name, then in place.
bool replace(const fs::path& file, const Header& header, std::span<const std::byte> data) {
  std::string temporary = file.string() + ".XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) return false;
  const bool isWhole = writeAll(descriptor, std::as_bytes(std::span(&header, 1))) && writeAll(descriptor, data);
  const bool isClosed = close(descriptor) == 0;
  if (isWhole && isClosed && rename(temporary.c_str(), file.c_str()) == 0) return true;
  unlink(temporary.c_str());
  return false;
}

/// What others left there under temporary names too.
void removeOldest(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (!at->path().filename().string().starts_with(kPrefix)) continue;
    std::error_code unknown;
    const auto time = at->last_write_time(unknown);
    if (!unknown) files.emplace_back(time, at->path());
  }
  std::ranges::sort(files, std::greater());
  for (std::size_t i = PipelineFile::kMostFiles; i < files.size(); ++i) fs::remove(files[i].second, error);
}

}  // namespace

PipelineFile::PipelineFile(fs::path folder, const PipelineKey& key)
    : folder_(std::move(folder)), name_(nameOf(hashOf(key))), key_(hashOf(key)) {}

std::vector<std::byte> PipelineFile::read() const {
  if (!isKept()) return {};
  std::error_code error;
  if (!fs::is_regular_file(path(), error)) return {};
  std::ifstream stream(path(), std::ios::binary);
  Header header;
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof(header)) || header.bytes > kMostBytes) return {};
  std::vector<std::byte> data(header.bytes);
  if (!stream.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()))) return {};
  return header == headerOf(key_, data) ? data : std::vector<std::byte>();
}

bool PipelineFile::write(std::span<const std::byte> data) const {
  if (!isKept() || data.size() > kMostBytes) return false;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!replace(path(), headerOf(key_, data), data)) return false;
  removeOldest(folder_);
  return true;
}

fs::path userCacheFolder() {
  const auto folderIn = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value == nullptr ? fs::path() : fs::path(value);
  };
  if (const fs::path cache = folderIn("XDG_CACHE_HOME"); cache.is_absolute()) return cache / "importon";
  if (const fs::path home = folderIn("HOME"); home.is_absolute()) return home / ".cache" / "importon";
  return {};
}

}  // namespace importon::gpu
