#include "app/output_folder.h"

#include <system_error>

#include "base/error.h"
#include "io/image.h"

namespace importon {

void makeFolder(const std::filesystem::path& folder, std::span<const char* const> files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError("cannot make the folder: " + error.message(), folder.string(), "choose another one");
  for (const char* file : files) checkWritable(folder / file);
}

}  // namespace importon
