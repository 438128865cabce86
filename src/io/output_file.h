/// An output file that is either whole or not there.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace importon {

/// Collects what is written under a temporary name in the folder of `target`; commit() renames it into place.
/// Destroyed without commit(), it leaves nothing behind, and an older file of that name as it was. A link is
/// followed; a device such as /dev/null is written to directly. Every member throws OutputError.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& target);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void seek(std::uint64_t position);
  [[nodiscard]] std::uint64_t position() const { return position_; }
  void commit();

 private:
  [[noreturn]] void fail(const std::string& what, int errorNumber) const;
  void flush();

  std::filesystem::path shownAs_;    // as the caller named it
  std::filesystem::path target_;     // with links followed
  std::filesystem::path temporary_;  // empty: written to directly
  int descriptor_ = -1;
  std::string buffer_;
  std::uint64_t position_ = 0;
};

/// Writes a whole text file. Throws OutputError and leaves no file then.
void writeTextFile(const std::filesystem::path& file, std::string_view text);

}  // namespace importon
