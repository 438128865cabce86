// Exit statuses and one-line errors that need neither a device nor a render.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::runImporton;
using test::TemporaryFolder;
using test::writeFile;

const std::map<std::string, std::string> kNoDriver{{"VK_DRIVER_FILES", "/nowhere.json"},
                                                   {"VK_ICD_FILENAMES", "/nowhere.json"}};

/// One line of the form `importon: error: WHAT (WHERE): WHAT TO DO`, and nothing on stdout.
void expectError(const Outcome& outcome, int status, const std::string& part) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.find("importon: error: "), 0u) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.back(), '\n');
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

TEST(Cli, NoArgumentsIsAUsageError) { expectError(runImporton({}), 1, "see importon --help"); }

TEST(Cli, AnUnknownOptionIsAUsageError) {
  expectError(runImporton({"render", kCornellBox, "-o", "o.exr", "--frobnicate"}), 1, "--frobnicate");
  expectError(runImporton({"--frobnicate"}), 1, "importon render --help");
}

TEST(Cli, ABadValueIsAUsageError) {
  expectError(runImporton({kCornellBox, "-o", "o.exr", "--width", "0"}), 1, "--width");
  expectError(runImporton({kCornellBox, "-o", "o.exr", "--time", "soon"}), 1, "--time");
  expectError(runImporton({kCornellBox, "-o", "o.exr", "--aov", "beauty"}), 1, "choose among albedo");
  expectError(runImporton({kCornellBox, "-o", "o.exr", "--control", "maybe"}), 1, "off");
}

TEST(Cli, ACropThatIsNoneIsAUsageError) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"0", "0", "0", "4"},
                                                {"0", "0", "4", "0"},
                                                {"-1", "0", "4", "4"},
                                                {"0", "0", "4", "-4"},
                                                {"0", "0", "4", "x"},
                                                {"0", "0", "4", "1e9"},
                                                {"0", "0", "4", "70000"},
                                                {"0", "0", "4", "4.5"},
                                                {"0", "0", "4"},
                                                {"0", "0", "4", ""},
                                                {"0 0", "4 4", "", ""},
                                                {}}) {
    std::vector<std::string> arguments{kCornellBox, "-o", "o.exr", "--crop"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    expectError(runImporton(arguments), 1, "--crop");
  }
  expectError(runImporton({kCornellBox, "-o", "o.exr", "--crop", "0", "0", "4", "4", "--crop", "0", "0", "4", "4"}), 1,
              "--crop");
}

TEST(Cli, HelpAndVersionGoToStdout) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--help"}, {"render", "--help"}, {"compare", "-h"}, {"--version"}}) {
    const Outcome outcome = runImporton(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("importon"), std::string::npos);
    EXPECT_EQ(outcome.out.back(), '\n');
  }
}

TEST(Cli, AMissingSceneIsASceneErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  expectError(runImporton({folder / "none.gltf", "-o", folder / "o.exr", "--png", folder / "o.png"}), 2, "none.gltf");
  expectError(runImporton({"info", folder / "none.gltf"}), 2, "none.gltf");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Cli, AMalformedSceneIsASceneErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  writeFile(folder / "bad.gltf", "{ \"asset\": ");
  expectError(runImporton({folder / "bad.gltf", "-o", folder / "o.exr"}), 2, "bad.gltf");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Cli, OutputsAreCheckedBeforeTheSceneIsRead) {
  const TemporaryFolder folder;
  const std::string scene = folder / "none.gltf", good = folder / "o.exr", bad = folder / "no/folder/o";
  expectError(runImporton({scene, "-o", bad}), 4, "create the folder");
  expectError(runImporton({scene, "-o", good, "--png", bad}), 4, "create the folder");
  expectError(runImporton({scene, "-o", good, "--stats", bad}), 4, "create the folder");
  expectError(runImporton({scene, "-o", folder.path()}), 4, "file name");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Cli, NoVulkanDeviceIsADeviceErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  expectError(runImporton({"devices"}, {.environment = kNoDriver}), 3, "driver");
  expectError(
      runImporton({kCornellBox, "-o", folder / "o.exr", "--png", folder / "o.png", "--stats", folder / "o.json"},
                  {.environment = kNoDriver}),
      3, "driver");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Cli, AFullDiskBehindStdoutIsAnOutputError) {
  const Outcome outcome = runImporton({"--help"}, {.outFile = "/dev/full"});
  expectError(outcome, 4, "standard output");
}

TEST(Cli, FilesOutsideTheScenesFolderNeedAFlag) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scene");
  auto scene = nlohmann::json::parse(test::readFile(kCornellBox));
  scene["buffers"][0]["uri"] =
      (std::filesystem::path(kCornellBox).parent_path() / scene["buffers"][0]["uri"].get<std::string>()).string();
  writeFile(folder / "scene/scene.gltf", scene.dump());
  expectError(runImporton({"info", folder / "scene/scene.gltf"}), 2, "--allow-outside-files");
  const Outcome outcome = runImporton({"info", folder / "scene/scene.gltf", "--allow-outside-files"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

/// A small fault of a file is a warning, and with --strict an error.
TEST(Cli, StrictRefusesSmallFaults) {
  const TemporaryFolder folder;
  auto scene = nlohmann::json::parse(test::readFile(kCornellBox));
  const std::string buffer = scene["buffers"][0]["uri"];
  std::filesystem::copy_file(std::filesystem::path(kCornellBox).parent_path() / buffer, folder / buffer);
  scene["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 1.5;
  writeFile(folder / "scene.gltf", scene.dump());
  const Outcome forgiven = runImporton({"info", folder / "scene.gltf"});
  EXPECT_EQ(forgiven.status, 0) << forgiven.err;
  EXPECT_EQ(forgiven.err.find("importon: warning: "), 0u) << forgiven.err;
  EXPECT_NE(forgiven.err.find("roughnessFactor"), std::string::npos) << forgiven.err;
  expectError(runImporton({"info", folder / "scene.gltf", "--strict"}), 2, "roughnessFactor");
  expectError(runImporton({folder / "scene.gltf", "-o", folder / "o.exr", "--strict"}), 2, "roughnessFactor");
}

/// The box as scene 0 and, half as large, as scene "small", whose variant "dark" shows one material for all.
TEST(Cli, SceneAndVariantChooseWhatIsShown) {
  const TemporaryFolder folder;
  auto scene = nlohmann::json::parse(test::readFile(kCornellBox));
  const std::string buffer = scene["buffers"][0]["uri"];
  std::filesystem::copy_file(std::filesystem::path(kCornellBox).parent_path() / buffer, folder / buffer);
  const std::size_t node = scene["nodes"].size(), material = scene["materials"].size();
  const std::size_t mesh = scene["meshes"].size();
  nlohmann::json one = scene["meshes"][0];
  // array() everywhere: compilers disagree on whether {x} is an array of one or a copy.
  using Json = nlohmann::json;
  one["primitives"].erase(one["primitives"].begin() + 1, one["primitives"].end());
  one["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
      Json::array({{{"material", material}, {"variants", Json::array({0})}}});
  scene["meshes"].push_back(one);
  scene["nodes"].push_back({{"mesh", mesh}});
  scene["scenes"].push_back({{"name", "small"}, {"nodes", Json::array({node})}});
  scene["materials"].push_back({{"name", "coal"}});
  scene["extensionsUsed"].push_back("KHR_materials_variants");
  scene["extensions"]["KHR_materials_variants"]["variants"] = Json::array({{{"name", "dark"}}});
  writeFile(folder / "scene.gltf", scene.dump());
  const auto info = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"info", folder / "scene.gltf", "--light", "studio"});
    return runImporton(more);
  };
  EXPECT_NE(info({}).out.find("triangles  36"), std::string::npos) << info({}).out;
  for (const char* name : {"small", "1"})
    EXPECT_EQ(info({"--scene", name}).out.find("triangles  36"), std::string::npos) << name;
  EXPECT_NE(info({"--scene", "small"}).out, info({"--scene", "small", "--variant", "dark"}).out);
  EXPECT_EQ(info({"--scene", "small", "--variant", "dark"}).out, info({"--scene", "1", "--variant", "0"}).out);
  expectError(info({"--scene", "large"}), 1, "use one of: 0");
  expectError(info({"--variant", "bright"}), 1, "use one of: 0 dark");
}

TEST(Cli, InfoNeedsNoDevice) {
  const Outcome text = runImporton({"info", kCornellBox}, {.environment = kNoDriver});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("triangles  36"), std::string::npos) << text.out;
  const Outcome json = runImporton({"info", kCornellBox, "--json"}, {.environment = kNoDriver});
  EXPECT_EQ(json.status, 0) << json.err;
  EXPECT_EQ(nlohmann::json::parse(json.out)["triangles"], 36);
}

}  // namespace
}  // namespace importon
