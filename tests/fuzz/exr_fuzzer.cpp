/// Feeds random bytes to the OpenEXR reader: whatever comes, it ends with an image or a SceneError. For libFuzzer;
/// scripts/fuzz runs it.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "io/image.h"

namespace {

/// A file in memory, by the name under which it can be opened.
int openFile() { return memfd_create("importon_fuzz", 0); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int kFile = openFile();
  const auto length = static_cast<ssize_t>(size);
  if (ftruncate(kFile, 0) != 0 || pwrite(kFile, data, size, 0) != length) std::abort();
  try {
    (void)importon::readExr("/proc/self/fd/" + std::to_string(kFile));
  } catch (const importon::SceneError&) {
  }
  return 0;
}
