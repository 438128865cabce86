/// What a driver made of kernels, kept in a file from one run to the next: that of a VkPipelineCache.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace importon::gpu {

/// What kept pipelines are good for.
struct PipelineKey {
  std::array<std::uint8_t, 16> cacheId{};  // pipelineCacheUUID
  std::uint32_t vendor = 0, device = 0, driver = 0;
  std::uint64_t kernels = 0;  // a hash of their code
};

/// Every key has a file of its own in the folder. Processes may read and write it at the same time: it is replaced as a
/// whole. A folder has at most kMostFiles of up to kMostBytes each; the oldest ones go. Throws nothing of the disk's.
class PipelineFile {
 public:
  static constexpr std::size_t kMostFiles = 16;
  static constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;

  /// Without a folder nothing is read or written. It is made when first written to.
  PipelineFile(std::filesystem::path folder, const PipelineKey& key);

  [[nodiscard]] bool isKept() const { return !folder_.empty(); }
  /// Where it is or would be.
  [[nodiscard]] std::filesystem::path path() const { return folder_ / name_; }
  /// What was last written; empty if there is nothing, or not all of it as it was written.
  [[nodiscard]] std::vector<std::byte> read() const;
  /// False if it could not be written; what was there before then stays.
  bool write(std::span<const std::byte> data) const;  // NOLINT(modernize-use-nodiscard): a loss is no error

 private:
  std::filesystem::path folder_;
  std::string name_;
  std::uint64_t key_;
};

/// $XDG_CACHE_HOME/importon, else ~/.cache/importon; empty if neither variable names an absolute path.
[[nodiscard]] std::filesystem::path userCacheFolder();

}  // namespace importon::gpu
