#include "app/batch/job_files.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "app/render_options.h"
#include "base/error.h"
#include "fmt/format.h"

namespace importon {
namespace {

namespace fs = std::filesystem;

constexpr std::array kWritten{&RenderJob::output, &RenderJob::png, &RenderJob::stats, &RenderJob::checkpoint};
constexpr std::array kRead{&RenderJob::scene, &RenderJob::environment, &RenderJob::reference};

fs::path withCamera(const fs::path& file, const std::string& camera) {
  fs::path name = file.stem();
  name += "." + camera;
  name += file.extension();
  return file.parent_path() / name;
}

/// The same for all names of a file.
std::string placeOf(const fs::path& file) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file.string() : place.string();
}

bool isFit(const std::string& name) {
  constexpr std::size_t kLongest = 100;  // bytes
  const bool isNumber = std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
  return !isNumber && name.size() <= kLongest && fileNameOf(name) == name;  // a number may be another one's index
}

/// Finds files that are there twice.
class Places {
 public:
  void reads(const fs::path& file) { read_.insert(placeOf(file)); }
  void writes(const fs::path& file, bool hasAllCameras) {
    const std::string place = placeOf(file);
    if (!written_.insert(place).second) refuse(file);
    if (hasAllCameras) ofCameras_[place] = file;
  }
  /// After all.
  void check() const {
    for (const std::string& place : written_) {
      if (read_.contains(place))
        throw UsageError("what a job of the batch reads would be written over", place, "choose another folder");
      checkCameras(place);
    }
  }

 private:
  [[noreturn]] static void refuse(const fs::path& file) {
    throw UsageError("two files of the batch would have the same name", file.string(),
                     "give each its own -o in a list, or render them into different folders");
  }
  /// NAME.CAMERA.exr of one job may be NAME2.exr of another.
  void checkCameras(const std::string& place) const {
    const fs::path path = place;
    const std::string stem = path.stem().string();
    for (std::size_t dot = stem.find('.', 1); dot != std::string::npos; dot = stem.find('.', dot + 1)) {
      fs::path shorter = path.parent_path() / stem.substr(0, dot);
      shorter += path.extension();
      if (ofCameras_.contains(shorter.string())) refuse(place);
    }
  }

  std::set<std::string> read_, written_;
  std::map<std::string, fs::path> ofCameras_;
};

}  // namespace

void nameOutputs(RenderJob& job, const fs::path& folder, const fs::path& pngFolder, const std::string& camera) {
  const std::string stem = job.scene.stem().string() + (camera.empty() ? "" : "." + fileNameOf(camera));
  if (job.output.empty()) job.output = folder / (stem + ".exr");
  if (job.png.empty() && !pngFolder.empty()) job.png = pngFolder / (job.output.stem().string() + ".png");
}

void addCamera(RenderJob& job, const std::string& camera) {
  for (const auto file : kWritten)
    if (!(job.*file).empty()) job.*file = withCamera(job.*file, camera);
}

std::string cameraLabel(std::span<const Camera> cameras, std::size_t index) {
  const std::string& name = cameras[index].name;
  const auto isNamesake = [&](const Camera& camera) { return camera.name == name; };
  return isFit(name) && std::ranges::count_if(cameras, isNamesake) == 1 ? name : std::to_string(index);
}

std::string fileNameOf(const std::string& name) {
  std::string fit = name;
  std::ranges::replace_if(
      fit, [](char c) { return (c >= 0 && c < ' ') || c == '/' || c == '\\' || c == '\x7f'; }, '_');
  return fit;
}

void checkJobFiles(const BatchCommand& command) {
  Places places;
  for (const BatchEntry& entry : command.entries) {
    const RenderJob& job = entry.render.job;
    for (const auto file : kRead)
      if (!(job.*file).empty()) places.reads(job.*file);
    for (const auto file : kWritten)
      if (!(job.*file).empty()) places.writes(job.*file, entry.hasAllCameras);
    if (!entry.render.list.empty()) places.reads(entry.render.list);
  }
  if (!command.summary.empty()) places.writes(command.summary, false);
  places.check();
  for (const BatchEntry& entry : command.entries) checkPictureKinds(entry.render.job);
}

}  // namespace importon
