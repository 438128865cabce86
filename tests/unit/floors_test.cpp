// Reads the includes of the sources and holds the floors of the house:
// base <- {io, scene, accel, gpu} <- render <- report <- app <- main; and those between the folders of render.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace importon {
namespace {

namespace fs = std::filesystem;
using Folders = std::set<std::string>;

// What each folder of src may include, besides itself and shaders/shared. `scene` and `accel` never see Vulkan,
// `gpu` never sees a scene.
const std::map<std::string, Folders> kMayInclude{
    {"base", {}},
    {"io", {"base"}},
    {"scene", {"base", "io"}},
    {"accel", {"base"}},
    {"gpu", {"base"}},
    {"render", {"base", "io", "scene", "accel", "gpu"}},
    {"report", {"base", "io", "scene", "accel", "gpu", "render"}},
    {"app", {"base", "io", "scene", "accel", "gpu", "render", "report"}},
    {"", {"base", "app"}},  // main.cpp
};

// The folders of src/render, lowest first: each may include those before it. The files beside them stand above all but
// what is plain data.
const std::vector<std::string> kRenderFloors{"options", "features",      "plan",       "resume",     "device_scene",
                                             "device",  "lists",         "importance", "photon_map", "guiding",
                                             "photons", "surface_cache", "filter",     "film",       "camera"};
const std::set<std::string> kRenderData{"render_job.h", "render_stats.h", "map_kind.h"};

struct Include {
  fs::path file;       // relative to src
  std::string target;  // as written
};

/// What a line of the form `#include "..."` or `#include <...>` names; empty if it is another line.
std::string includeOn(const std::string& line) {
  const std::size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return "";
  const std::size_t word = line.find_first_not_of(" \t", hash + 1);
  if (word == std::string::npos || line.compare(word, 7, "include") != 0) return "";
  const std::size_t open = line.find_first_of("\"<", word), close = line.find_last_of("\">");
  return close != std::string::npos && open < close ? line.substr(open + 1, close - open - 1) : "";
}

std::vector<Include> includesOf(const fs::path& sources) {
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(sources)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream stream(entry.path());
    for (std::string line; std::getline(stream, line);) {
      if (const std::string target = includeOn(line); !target.empty()) {
        includes.push_back({fs::relative(entry.path(), sources), target});
      }
    }
  }
  return includes;
}

/// The folder below src that a path begins with; empty for none.
std::string folderOf(const fs::path& path) { return path.has_parent_path() ? path.begin()->string() : ""; }

/// Place of a file of src/render among the floors; of plain data -1. Throws std::out_of_range for an unknown folder.
int renderFloor(const fs::path& path) {
  if (kRenderData.contains(path.filename().string())) return -1;
  const fs::path folder = path.lexically_relative("render").parent_path();
  if (folder.empty()) return static_cast<int>(kRenderFloors.size());
  const auto at = std::ranges::find(kRenderFloors, folder.string());
  if (at == kRenderFloors.end()) throw std::out_of_range(folder.string());
  return static_cast<int>(at - kRenderFloors.begin());
}

/// "FILE includes TARGET" for each include that a folder may not have.
std::vector<std::string> breaches(const std::vector<Include>& includes) {
  std::vector<std::string> found;
  for (const Include& include : includes) {
    const std::string from = folderOf(include.file), to = folderOf(include.target);
    const auto rule = kMayInclude.find(from);
    const bool isOurs = kMayInclude.contains(to) && !to.empty();
    const bool isVulkan = to == "vulkan";
    const bool isUpInRender =
        from == "render" && to == "render" && renderFloor(include.file) < renderFloor(include.target);
    const bool isForbidden =
        isVulkan ? from != "gpu" : isUpInRender || (isOurs && to != from && !rule->second.contains(to));
    if (rule == kMayInclude.end() || isForbidden) {
      found.push_back(include.file.string() + " includes " + include.target);
    }
  }
  return found;
}

TEST(Floors, NoFileIncludesWhatStandsAboveIt) {
  const std::vector<Include> includes = includesOf(fs::path(IMPORTON_SOURCES) / "src");
  EXPECT_GT(includes.size(), 100u);
  EXPECT_EQ(breaches(includes), std::vector<std::string>{});
}

TEST(Floors, TheCheckFindsBreaches) {
  EXPECT_EQ(breaches({{"io/image.cpp", "render/render.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"scene/scene.h", "gpu/buffer.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"gpu/buffer.h", "scene/scene.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"render/film/film.cpp", "vulkan/vulkan.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"render/film/film.cpp", "app/progress.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"newfolder/a.cpp", "vector"}}).size(), 1u);
  EXPECT_EQ(breaches({{"render/importance/importance.cpp", "render/camera/eye_pass.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"render/film/film.cpp", "render/renderer.h"}}).size(), 1u);
  EXPECT_EQ(breaches({{"render/film/film.cpp", "render/render_job.h"}}).size(), 0u);
  EXPECT_EQ(
      breaches({{"gpu/device.cpp", "vulkan/vulkan.h"}, {"app/run.cpp", "app/run.h"}, {"io/a.cpp", "vector"}}).size(),
      0u);
}

TEST(Floors, TheCheckReadsIncludes) {
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "io");
  test::writeFile(folder / "io/a.cpp", "#include \"base/log.h\"\n  #  include <vulkan/vulkan.h>\n// #include <no>\n");
  const std::vector<Include> includes = includesOf(folder.path());
  ASSERT_EQ(includes.size(), 2u);
  EXPECT_EQ(includes[0].target, "base/log.h");
  EXPECT_EQ(includes[1].target, "vulkan/vulkan.h");
  EXPECT_EQ(includes[1].file, "io/a.cpp");
}

}  // namespace
}  // namespace importon
