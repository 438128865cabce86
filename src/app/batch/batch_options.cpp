#include "app/batch/batch_options.h"

#include "app/batch/job_files.h"
#include "app/batch/job_list.h"
#include "app/render_options.h"
#include "base/error.h"
#include "fmt/format.h"
#include "io/picture_file.h"

namespace importon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAllCameras = "all";

void checkFolder(const char* option, const fs::path& folder) {
  if (folder.extension().empty() || !pictureKind(folder, PictureKind::exr)) return;
  throw UsageError(fmt::format("{} names a folder where there may be several pictures", option), folder.string(),
                   "give the name of a folder");
}

/// What one file cannot serve all jobs for.
void checkCommon(const RenderCommand& common) {
  checkFolder("--output", common.job.output);
  checkFolder("--png", common.job.png);
  for (const auto& [name, file] : {std::pair("--checkpoint", &common.job.checkpoint), {"--resume", &common.job.resume}})
    if (!file->empty())
      throw UsageError(fmt::format("{} is of one picture, not of several", name), file->string(),
                       "give it in the lines of a --list");
}

/// What all jobs have: no scene and no files to write yet. The command line stands in the batch alone, as it may be
/// long.
RenderCommand sharedPart(const RenderCommand& common) {
  RenderCommand shared = common;
  shared.scenes.clear();
  shared.job.commandLine.clear();
  for (fs::path* file : {&shared.job.scene, &shared.job.output, &shared.job.png, &shared.job.stats}) file->clear();
  return shared;
}

/// `camera` goes into the names that the job is given.
void addEntry(BatchCommand& command, RenderCommand render, const std::string& camera) {
  const bool hasAllCameras = render.job.camera == kAllCameras;
  nameOutputs(render.job, command.folder, command.pngFolder, hasAllCameras ? "" : camera);
  command.entries.push_back({std::move(render), hasAllCameras});
}

void addLine(BatchCommand& command, const RenderCommand& shared, const ListLine& line, const ListFolders& folders) {
  const std::string where =
      fmt::format("{}:{}", shared.list == "-" ? "standard input" : shared.list.string(), line.number);
  RenderCommand render = shared;
  render.job.camera.clear();
  try {
    parseListLine(line.words, render, folders);
    if (render.job.output.empty() && command.folder.empty())
      throw UsageError("--output is required, here or for all", "", "");
  } catch (const UsageError& error) {
    throw UsageError(error.problem(), where, "see importon render --help");
  }
  const std::string own = render.job.camera;
  if (own.empty()) render.job.camera = shared.job.camera;
  addEntry(command, std::move(render), own);
}

}  // namespace

bool isBatch(const RenderCommand& command) {
  return command.scenes.size() > 1 || !command.list.empty() || command.job.camera == kAllCameras;
}

BatchCommand makeBatchCommand(const RenderCommand& common) {
  checkCommon(common);
  BatchCommand command{
      {}, common.job.output, common.job.png, common.job.stats, common.job.commandLine, common.verbosity};
  const RenderCommand shared = sharedPart(common);
  if (!common.scenes.empty() && command.folder.empty())
    throw UsageError("--output is required", "command line", "see importon render --help");
  for (const fs::path& scene : common.scenes) {
    RenderCommand render = shared;
    render.job.scene = scene;
    addEntry(command, std::move(render), "");
  }
  if (!common.list.empty()) {
    std::error_code ignored;
    const fs::path ownFolder = fs::is_regular_file(common.list, ignored) ? common.list.parent_path() : fs::path();
    const ListFolders folders{ownFolder, command.folder.empty() ? ownFolder : command.folder};
    for (const ListLine& line : readJobList(common.list)) addLine(command, shared, line, folders);
  }
  checkJobFiles(command);
  return command;
}

}  // namespace importon
