#include "io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

#include "base/error.h"
#include "fmt/format.h"
#include "io/image.h"

namespace importon {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;

/// What to do about an error number of the system.
std::string remedyFor(int errorNumber) {
  switch (errorNumber) {
    case ENOSPC:
    case EDQUOT:
      return "free some space, or choose another folder";
    case ENOENT:
    case ENOTDIR:
      return "create the folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to";
    case EISDIR:
      return "give a file name, not a folder";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case ESPIPE:
      return "choose a regular file, not a pipe";
    default:
      return "choose another file name or folder";
  }
}

[[noreturn]] void throwOutputError(const std::string& what, const fs::path& file, int errorNumber) {
  throw OutputError(fmt::format("{}: {}", what, std::generic_category().message(errorNumber)), file.string(),
                    remedyFor(errorNumber));
}

/// False, with errno set, when the system forbids it.
bool mayWrite(const fs::path& file) { return faccessat(AT_FDCWD, file.c_str(), W_OK, AT_EACCESS) == 0; }

/// The file that a chain of symbolic links leads to, whether it exists or not.
fs::path followLinks(fs::path file) {
  constexpr int kMostLinks = 40;  // as Linux allows
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(file, error); ++i) {
    const fs::path next = fs::read_symlink(file, error);
    if (error) break;
    file = next.is_absolute() ? next : file.parent_path() / next;
  }
  return file;
}

/// A name beside `target` that no other process or thread uses.
fs::path temporaryBeside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() / fmt::format(".importon-{}-{}.tmp", getpid(), counter.fetch_add(1));
}

}  // namespace

OutputFile::OutputFile(const fs::path& target) : shownAs_(target), target_(target) {
  struct stat status {};
  if (stat(target.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail("cannot write", EISDIR);
    if (!S_ISREG(status.st_mode)) {
      descriptor_ = open(target.c_str(), O_WRONLY | O_CLOEXEC);
      if (descriptor_ < 0) fail("cannot write", errno);
      return;
    }
    if (!mayWrite(target)) fail("cannot write", errno);
  } else if (errno != ENOENT) {
    fail("cannot write", errno);
  }
  target_ = followLinks(target);
  if (!target_.has_filename()) fail("cannot write", EISDIR);
  temporary_ = temporaryBeside(target_);
  constexpr mode_t kMode = 0666;  // less the user's mask
  descriptor_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  if (descriptor_ < 0) {
    temporary_.clear();
    fail("cannot create", errno);
  }
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::fail(const std::string& what, int errorNumber) const { throwOutputError(what, shownAs_, errorNumber); }

void OutputFile::write(std::span<const std::byte> bytes) {
  buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  position_ += bytes.size();
  if (buffer_.size() >= kBufferBytes) flush();
}

void OutputFile::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t count = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("cannot write", errno);
    done += static_cast<std::size_t>(count);
  }
  buffer_.clear();
}

void OutputFile::seek(std::uint64_t position) {
  if (position == position_) return;
  flush();
  if (lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0) fail("cannot write", errno);
  position_ = position;
}

void OutputFile::commit() {
  flush();
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (close(descriptor) != 0) fail("cannot write", errno);  // some file systems tell only now that they are full
  if (temporary_.empty()) return;
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot write", errno);
  temporary_.clear();
}

void writeTextFile(const fs::path& file, std::string_view text) {
  OutputFile output(file);
  output.write(std::as_bytes(std::span(text)));
  output.commit();
}

void checkWritable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  const bool isStream = fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
  if (!isStream) {
    const OutputFile created(file);
  } else if (!mayWrite(file)) {  // opening and closing would end a pipe for its reader
    throwOutputError("cannot write", file, errno);
  }
}

}  // namespace importon
