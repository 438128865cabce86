#include "render/resume/checkpoint.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "base/hash.h"
#include "io/output_file.h"

namespace importon {
namespace {

constexpr std::string_view kMagic = "importon checkpoint 1\n";

/// Writes and hashes at once.
class Sink {
 public:
  explicit Sink(OutputFile& file) : file_(file) {}
  void put(std::span<const std::byte> bytes) {
    hash_.add(bytes);
    file_.write(bytes);
  }
  void put(std::uint64_t number) { put(std::as_bytes(std::span(&number, 1))); }
  void put(std::string_view text) { put(std::as_bytes(std::span(text))); }
  void putHash() {
    const std::uint64_t hash = hash_.value();
    file_.write(std::as_bytes(std::span(&hash, 1)));
  }

 private:
  OutputFile& file_;
  ContentHash hash_;
};

/// Reads and hashes at once, in pieces as they were written.
class Source {
 public:
  Source(std::span<const std::byte> bytes, std::string where) : rest_(bytes), where_(std::move(where)) {}

  std::span<const std::byte> take(std::uint64_t count) {
    if (count > rest_.size()) refuse();
    const auto piece = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(piece.size());
    hash_.add(piece);
    return piece;
  }
  std::uint64_t takeNumber() {
    std::uint64_t number = 0;
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  }
  void checkHash() {
    const std::uint64_t expected = hash_.value();
    if (takeNumber() != expected || !rest_.empty()) refuse();
  }
  [[noreturn]] void refuse() const {
    throw SceneError("the checkpoint is torn or damaged", where_, "start again without --resume");
  }

 private:
  std::span<const std::byte> rest_;
  std::string where_;
  ContentHash hash_;
};

std::vector<char> readWhole(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream || std::filesystem::is_directory(file, ignored))
    throw SceneError("cannot read the checkpoint", file.string(), "check the name");
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

const CheckpointBlock* Checkpoint::find(const std::string& name) const {
  const auto found = std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block.name == name; });
  return found == blocks.end() ? nullptr : &*found;
}

void writeCheckpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  OutputFile output(file);
  Sink sink(output);
  sink.put(kMagic);
  sink.put(checkpoint.fingerprint);
  sink.put(static_cast<std::uint64_t>(checkpoint.passes));
  sink.put(checkpoint.blocks.size());
  for (const CheckpointBlock& block : checkpoint.blocks) {
    sink.put(block.name.size());
    sink.put(std::string_view(block.name));
    sink.put(block.bytes.size());
    sink.put(std::span(block.bytes));
  }
  sink.putHash();
  output.commit();
}

Checkpoint readCheckpoint(const std::filesystem::path& file) {
  const std::vector<char> bytes = readWhole(file);
  if (bytes.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin()))
    throw SceneError("this is no checkpoint of this version", file.string(), "give what --checkpoint wrote");
  Source source(std::as_bytes(std::span(bytes)), file.string());
  (void)source.take(kMagic.size());
  Checkpoint checkpoint;
  checkpoint.fingerprint = source.takeNumber();
  checkpoint.passes = static_cast<int>(source.takeNumber());
  const std::uint64_t blocks = source.takeNumber();
  for (std::uint64_t i = 0; i < blocks; ++i) {
    CheckpointBlock block;
    const auto name = source.take(source.takeNumber());
    block.name.assign(reinterpret_cast<const char*>(name.data()), name.size());
    const auto content = source.take(source.takeNumber());
    block.bytes.assign(content.begin(), content.end());
    checkpoint.blocks.push_back(std::move(block));
  }
  source.checkHash();
  return checkpoint;
}

}  // namespace importon
