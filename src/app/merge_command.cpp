#include "app/commands.h"
#include "io/image.h"
#include "io/picture_file.h"
#include "report/merge.h"

namespace importon {

ExitStatus runMerge(const MergeCommand& command) {
  checkWritable(command.output);
  if (!command.png.empty()) checkWritable(command.png);
  ImageMerger merger;
  for (const std::filesystem::path& file : command.images) merger.add(readExr(file), file.string());
  const Image merged = merger.result();
  writeExr(command.output, merged);
  if (!command.png.empty()) writePicture(command.png, merged, command.job.look, PictureKind::png);
  return ExitStatus::ok;
}

}  // namespace importon
