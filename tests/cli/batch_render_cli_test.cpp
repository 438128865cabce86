// Batches on the device.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::readFile;
using test::runImporton;
using test::RunOptions;
using test::TemporaryFolder;
using test::writeFile;

const std::string kGlassBall = std::string(IMPORTON_SCENES) + "/glass_ball/glass_ball.gltf";

class CliBatchRender : public testing::Test {
 protected:
  /// A small render of few photons with these arguments.
  [[nodiscard]] Outcome run(std::vector<std::string> arguments, const RunOptions& options = {}) const {
    arguments.insert(arguments.end(), {"--width", "32", "--height", "24", "--photons", "4096", "--importons", "2048"});
    return runImporton(arguments, options);
  }
  /// The box under another name.
  std::string copyBox(const std::string& name) const {
    nlohmann::json scene = nlohmann::json::parse(readFile(kCornellBox));
    const std::string buffer = scene["buffers"][0]["uri"];
    if (!std::filesystem::exists(folder_ / buffer))
      std::filesystem::copy_file(std::filesystem::path(kCornellBox).parent_path() / buffer, folder_ / buffer);
    writeFile(folder_ / name, scene.dump());
    return folder_ / name;
  }
  [[nodiscard]] nlohmann::json summary() const { return nlohmann::json::parse(readFile(folder_ / "s.json")); }
  [[nodiscard]] bool isMade(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
  /// What watched_device.cpp counts.
  struct Counts {
    int devices = 0, pipelines = 0, submissions = 0;
  };
  /// With what watched_device.cpp does.
  [[nodiscard]] RunOptions watched(std::map<std::string, std::string> faults = {}) const {
    faults.insert({{"LD_PRELOAD", IMPORTON_WATCHED_DEVICE}, {"IMPORTON_TEST_COUNTS", folder_ / "counts"}});
    return {.environment = faults};
  }
  /// Of the last watched run.
  [[nodiscard]] Counts counts() const {
    Counts made;
    std::istringstream(readFile(folder_ / "counts")) >> made.devices >> made.pipelines >> made.submissions;
    return made;
  }

  TemporaryFolder folder_;
};

TEST_F(CliBatchRender, SmokeGivesTheBitsOfSingleRendersAndGoesOnAfterABadFile) {
  const std::string box = copyBox("box.gltf");
  const Outcome outcome = run({box, "none.glb", kGlassBall, "-o", folder_ / "out", "--png", folder_ / "out", "--stats",
                               folder_ / "s.json", "--passes", "1"});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("importon: error: the file does not exist (none.glb)"), std::string::npos) << outcome.err;
  for (const auto& [scene, name] : {std::pair(box, "box"), {kGlassBall, "glass_ball"}}) {
    ASSERT_EQ(run({scene, "-o", folder_ / "one.exr", "--png", folder_ / "one.png", "--passes", "1"}).status, 0);
    for (const std::string end : {".exr", ".png"})
      EXPECT_EQ(readFile(folder_ / ("out/" + std::string(name) + end)), readFile(folder_ / ("one" + end))) << name;
  }
  const nlohmann::json all = summary();
  EXPECT_EQ(all["status"], 2);
  EXPECT_EQ(all["pictures"], 2);
  ASSERT_EQ(all["jobs"].size(), 3u);
  EXPECT_EQ(all["jobs"][0]["status"], 0);
  EXPECT_EQ(all["jobs"][0]["camera"], "Camera");
  EXPECT_EQ(all["jobs"][0]["stats"]["image"]["width"], 32);
  EXPECT_TRUE(all["jobs"][0]["error"].is_null());
  EXPECT_EQ(all["jobs"][1]["status"], 2);
  EXPECT_NE(all["jobs"][1]["error"].get<std::string>().find("none.glb"), std::string::npos);
  EXPECT_TRUE(all["jobs"][1]["stats"].is_null());
  EXPECT_EQ(all["jobs"][2]["output"], (folder_ / "out/glass_ball.exr").string());
}

/// Kernels of jobs with other constants are not mixed up.
TEST_F(CliBatchRender, ListHasOptionsByLine) {
  copyBox("box.gltf");
  writeFile(folder_ / "jobs.list",
            "\xEF\xBB\xBF# comment\n\n"
            "box.gltf --camera 0  # beside the list\r\n"
            "box.gltf -o path.exr --integrator path --passes 2\n"
            "  'box.gltf' -o \"tall one.exr\" --width 16 --stats tall.json\n"
            "box.gltf -o gauss.exr --filter gaussian\n"
            "box.gltf -o again.exr\n");
  const Outcome outcome = run({"--list", folder_ / "jobs.list", "-o", folder_ / "out", "--passes", "1", "-q"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;  // of photons that the path tracer lacks
  EXPECT_EQ(outcome.err.find("importon: warning: box.gltf: the path tracer"), 0u) << outcome.err;
  const auto stats = nlohmann::json::parse(readFile(folder_ / "out/tall.json"));
  EXPECT_EQ(stats["image"]["width"], 16);
  EXPECT_EQ(stats["command"][0], "--list");
  EXPECT_EQ(readExr(folder_ / "out/tall one.exr").width, 16);
  const auto expectSame = [&](const std::string& name, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{folder_ / "box.gltf", "-o", folder_ / "one.exr"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ASSERT_EQ(run(arguments).status, 0);
    EXPECT_EQ(readFile(folder_ / ("out/" + name)), readFile(folder_ / "one.exr")) << name;
  };
  expectSame("box.0.exr", {"--passes", "1"});
  expectSame("again.exr", {"--passes", "1"});
  expectSame("path.exr", {"--passes", "2", "--integrator", "path"});
  expectSame("gauss.exr", {"--passes", "1", "--filter", "gaussian"});
}

TEST_F(CliBatchRender, WithoutAFolderWritesBesideTheList) {
  copyBox("box.gltf");
  writeFile(folder_ / "jobs.list", "box.gltf -o own.exr\n");
  EXPECT_EQ(run({"--list", folder_ / "jobs.list", "--passes", "1"}).status, 0);
  EXPECT_TRUE(isMade("own.exr"));
}

/// Three cameras: one of them has no name that is fit for a file, and another has that of the first.
TEST_F(CliBatchRender, RendersAllCameras) {
  nlohmann::json scene = nlohmann::json::parse(readFile(copyBox("box.gltf")));
  const std::size_t count = scene["nodes"].size();
  const auto cameraNode =
      *std::ranges::find_if(scene["nodes"], [](const nlohmann::json& n) { return n.contains("camera"); });
  for (const char* name : {"a/b", "Top"}) {
    nlohmann::json camera = scene["cameras"][0];
    camera["name"] = name;
    nlohmann::json node = cameraNode;
    node["camera"] = scene["cameras"].size();
    node.erase("name");
    if (name == std::string("Top")) node["translation"][0] = 0.5;
    scene["cameras"].push_back(camera);
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
    scene["nodes"].push_back(node);
  }
  ASSERT_EQ(scene["nodes"].size(), count + 2);
  writeFile(folder_ / "box.gltf", scene.dump());
  const Outcome outcome = run(
      {folder_ / "box.gltf", "--camera", "all", "-o", folder_ / "out", "--stats", folder_ / "s.json", "--passes", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"out/box.Camera.exr", "out/box.1.exr", "out/box.Top.exr"}) EXPECT_TRUE(isMade(name)) << name;
  EXPECT_EQ(summary()["jobs"].size(), 3u);
  EXPECT_EQ(summary()["jobs"][1]["camera"], "1");
  ASSERT_EQ(run({folder_ / "box.gltf", "--camera", "Top", "-o", folder_ / "one.exr", "--passes", "1"}).status, 0);
  EXPECT_EQ(readFile(folder_ / "out/box.Top.exr"), readFile(folder_ / "one.exr"));
  EXPECT_NE(readFile(folder_ / "out/box.Top.exr"), readFile(folder_ / "out/box.Camera.exr"));
}

TEST_F(CliBatchRender, GoesOnAfterAJobThatCannotBeRendered) {
  copyBox("box.gltf");
  std::filesystem::create_directory(folder_ / "out");
  std::filesystem::create_directory(folder_ / "out/dir.exr");
  writeFile(folder_ / "jobs.list",
            "box.gltf --camera none\nbox.gltf -o dir.exr\nbox.gltf --device none -o d.exr\nbox.gltf -o good.exr\n");
  const Outcome outcome =
      run({"--list", folder_ / "jobs.list", "-o", folder_ / "out", "--passes", "1", "--stats", folder_ / "s.json"});
  EXPECT_EQ(outcome.status, 4) << outcome.err;
  EXPECT_EQ(outcome.err.find("once more"), std::string::npos) << outcome.err;  // no device was there to fail
  EXPECT_TRUE(isMade("out/good.exr"));
  std::vector<int> statuses;
  const nlohmann::json all = summary();
  for (const nlohmann::json& job : all["jobs"]) statuses.push_back(job["status"]);
  EXPECT_EQ(statuses, (std::vector<int>{1, 4, 3, 0}));
}

TEST_F(CliBatchRender, SharesDeviceAndKernels) {
  std::vector<std::string> boxes;
  for (const char* name : {"a.gltf", "b.gltf", "c.gltf"}) boxes.push_back(copyBox(name));
  ASSERT_EQ(run({boxes[0], "-o", folder_ / "one.exr", "--passes", "1"}, watched()).status, 0);
  const Counts one = counts();
  EXPECT_GT(one.pipelines, 10);
  ASSERT_EQ(run({boxes[0], boxes[1], boxes[2], "-o", folder_ / "out", "--passes", "1"}, watched()).status, 0);
  EXPECT_EQ(counts().devices, 1);
  EXPECT_EQ(counts().pipelines, one.pipelines);
  EXPECT_EQ(counts().submissions, 3 * one.submissions);
  // Another scene shares those that its features do not change.
  ASSERT_EQ(run({kGlassBall, "-o", folder_ / "one.exr", "--passes", "1"}, watched()).status, 0);
  const Counts other = counts();
  ASSERT_EQ(run({boxes[0], kGlassBall, "-o", folder_ / "out", "--passes", "1"}, watched()).status, 0);
  EXPECT_LT(counts().pipelines, one.pipelines + other.pipelines - 10);
}

/// The second scene is gone when the first is seen to be rendered, but it was loaded by then; the third was not.
TEST_F(CliBatchRender, LoadsOneSceneAhead) {
  const std::string a = copyBox("a.gltf"), b = copyBox("b.gltf"), c = copyBox("c.gltf");
  const auto onErr = [&](const std::string& err) {
    if (err.find("pass 1/") != std::string::npos) {
      std::filesystem::remove(b);
      std::filesystem::remove(c);
    }
    return 0;
  };
  const Outcome outcome =
      run({a, b, c, "-o", folder_ / "out", "--passes", "40"}, {.hasTerminal = true, .onErr = onErr});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_TRUE(isMade("out/b.exr")) << outcome.err;
  EXPECT_FALSE(isMade("out/c.exr"));
}

TEST_F(CliBatchRender, GoesOnWithAFreshDeviceWhereOneIsLost) {
  const std::vector<std::string> arguments{
      copyBox("a.gltf"), copyBox("b.gltf"),  copyBox("c.gltf"), "-o", folder_ / "out",
      "--stats",         folder_ / "s.json", "--passes",        "1"};
  ASSERT_EQ(run({copyBox("a.gltf"), "-o", folder_ / "one.exr", "--passes", "1"}, watched()).status, 0);
  const int inSecond = counts().submissions + 3;
  const Outcome outcome = run(arguments, watched({{"IMPORTON_TEST_LOST_AT", std::to_string(inSecond)}}));
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(counts().devices, 2);
  EXPECT_NE(outcome.err.find("importon: warning: b.gltf: the device was lost"), std::string::npos) << outcome.err;
  EXPECT_EQ(summary()["pictures"], 3);
  const Image one = readExr(folder_ / "one.exr");
  for (const char* name : {"out/a.exr", "out/b.exr", "out/c.exr"})
    EXPECT_EQ(readExr(folder_ / name).find("G")->values, one.find("G")->values) << name;

  std::filesystem::remove_all(folder_ / "out");
  const Outcome never = run(arguments, watched({{"IMPORTON_TEST_LOST_FROM", std::to_string(inSecond)}}));
  EXPECT_EQ(never.status, 3) << never.err;
  EXPECT_EQ(counts().devices, 3);  // that of a and b, b's second, and c's only one
  EXPECT_TRUE(isMade("out/a.exr"));
  const nlohmann::json all = summary();
  EXPECT_EQ(all["pictures"], 1);
  EXPECT_EQ(all["jobs"][2]["status"], 3);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "out"), {}), 1);
}

TEST_F(CliBatchRender, SkipsTheRestWhenInterrupted) {
  const std::vector<std::string> arguments{copyBox("a.gltf"), copyBox("b.gltf"), copyBox("c.gltf"),  "-o",
                                           folder_ / "out",   "--stats",         folder_ / "s.json", "--passes",
                                           "1000000"};
  const auto onErr = [this, isSent = false](const std::string& err) mutable {
    if (isSent || err.find("pass 1/") == std::string::npos) return 0;
    isSent = true;
    std::filesystem::remove(folder_ / "c.gltf");  // is not read any more
    return SIGINT;
  };
  const Outcome outcome = run(arguments, {.hasTerminal = true, .onErr = onErr});
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_NE(outcome.err.find("1 of 3 pictures"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("interrupted, so 2 are not made"), std::string::npos) << outcome.err;
  EXPECT_TRUE(isMade("out/a.exr"));
  EXPECT_FALSE(isMade("out/b.exr"));
  const nlohmann::json all = summary();
  EXPECT_EQ(all["status"], 130);
  EXPECT_GE(all["jobs"][0]["stats"]["image"]["passes"], 1);
  EXPECT_NE(all["jobs"][2]["error"].get<std::string>().find("not begun"), std::string::npos);
}

TEST_F(CliBatchRender, HasTheTimeOfEachJobToItself) {
  const Outcome outcome =
      run({copyBox("a.gltf"), copyBox("b.gltf"), "-o", folder_ / "out", "--stats", folder_ / "s.json", "--time", "4"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json all = summary();
  ASSERT_EQ(all["jobs"].size(), 2u);
  EXPECT_NEAR(all["seconds"].get<double>(), 8, 1.5);
  for (const nlohmann::json& job : all["jobs"]) EXPECT_NEAR(job["seconds"].get<double>(), 4, 1);
}

}  // namespace
}  // namespace importon
