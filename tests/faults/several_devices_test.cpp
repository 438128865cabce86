// Renders on two devices: what they make together is what each makes alone, added up; one that is lost is left out.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "io/image.h"
#include "support/temporary_folder.h"

namespace importon {
namespace {

using test::kCornellBox;
using test::Outcome;
using test::readFile;
using Words = std::vector<std::string>;

const std::string kSecondSeed = "2654435769";  // of the second device, if that of the job is 0

/// Renders with the same driver twice, by two files that name it: two devices that are alike.
class SeveralDevices : public testing::Test {
 protected:
  void SetUp() override {
    const char* const driver = std::getenv("VK_DRIVER_FILES");
    if (driver == nullptr) GTEST_SKIP() << "VK_DRIVER_FILES names no driver";
    const std::filesystem::path file = std::string(driver).substr(0, std::string(driver).find(':'));
    auto manifest = nlohmann::json::parse(readFile(file));
    auto& library = manifest["ICD"]["library_path"];
    if (library.get<std::string>().starts_with("."))
      library = (file.parent_path() / library.get<std::string>()).string();
    for (const char* name : {"a.json", "b.json"}) test::writeFile(drivers_ / name, manifest.dump());
    environment_ = {{"VK_DRIVER_FILES", (drivers_ / "a.json").string() + ":" + (drivers_ / "b.json").string()}};
  }

  [[nodiscard]] Outcome run(const Words& arguments, const std::string& fault = "",
                            const test::RunOptions& given = {}) const {
    test::RunOptions options = given;
    options.environment.insert(environment_.begin(), environment_.end());
    if (!fault.empty()) {
      options.environment["VK_INSTANCE_LAYERS"] = "VK_LAYER_IMPORTON_fault";
      options.environment["VK_LAYER_PATH"] = IMPORTON_FAULT_LAYER;
      options.environment["IMPORTON_TEST_FAULT"] = fault;
    }
    return test::runImporton(arguments, options);
  }

  [[nodiscard]] static Words small(const std::string& output, const Words& more) {
    Words words{kCornellBox, "-o",        output, "--width",     "32",  "--height",
                "24",        "--photons", "4096", "--importons", "2048"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// A small image, with these further options; its exit status must be 0.
  [[nodiscard]] Image render(const Words& more, const std::string& fault = "") const {
    const std::string output = folder_ / "o.exr";
    const Outcome outcome = run(small(output, more), fault);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    err_ = outcome.err;
    return readExr(output);
  }

  [[nodiscard]] nlohmann::json stats() const { return nlohmann::json::parse(readFile(folder_ / "o.json")); }
  [[nodiscard]] std::string statsFile() const { return folder_ / "o.json"; }

  test::TemporaryFolder folder_, drivers_;
  std::map<std::string, std::string> environment_;
  mutable std::string err_;
};

/// The largest difference of a channel, relative to the largest value of `b` in it.
double differenceOf(const Image& a, const Image& b, const std::string& channel) {
  const std::vector<float>&va = a.find(channel)->values, &vb = b.find(channel)->values;
  double most = 0, largest = 1e-30;
  for (std::size_t i = 0; i < va.size(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(va[i]) - static_cast<double>(vb[i])));
    largest = std::max(largest, std::abs(static_cast<double>(vb[i])));
  }
  return most / largest;
}

bool haveSameValues(const Image& a, const Image& b) {
  for (const Channel& channel : a.channels)
    if (b.find(channel.name) == nullptr || b.find(channel.name)->values != channel.values) return false;
  return a.channels.size() == b.channels.size();
}

double meanOf(const Image& image) {
  double sum = 0;
  for (const char* channel : {"R", "G", "B"})
    for (const float value : image.find(channel)->values) sum += static_cast<double>(value);
  return sum;
}

/// Five passes: three on the first device, two on the second. Without sharing light among pixels the image is what
/// `merge` makes of the two parts, up to rounding, and layers that no film holds are its to the bit.
TEST_F(SeveralDevices, MakeWhatMergeMakesOfTheirParts) {
  for (const char* integrator : {"photon", "path"}) {
    const Words common{"--integrator",       integrator, "--indirect-filter", "off", "--aov", "direct,P,density.global",
                       "--adaptive-samples", "off"};
    const auto with = [&](Words words) {
      words.insert(words.end(), common.begin(), common.end());
      return words;
    };
    const std::string a = folder_ / "a.exr", b = folder_ / "b.exr", m = folder_ / "m.exr";
    ASSERT_EQ(run(small(a, with({"--device", "0", "--passes", "3"}))).status, 0);
    ASSERT_EQ(run(small(b, with({"--device", "1", "--passes", "2", "--seed", kSecondSeed}))).status, 0);
    ASSERT_EQ(run({"merge", a, b, "-o", m}).status, 0);
    const Image merged = readExr(m), together = render(with({"--device", "all", "--passes", "5"}));
    ASSERT_EQ(together.channels.size(), merged.channels.size());
    for (const char* channel : {"R", "G", "B", "direct.R", "direct.G", "direct.B"})
      EXPECT_LT(differenceOf(together, merged, channel), 1e-6) << channel;
    for (const char* channel : {"P.X", "P.Y", "P.Z", "density.global.Y"})
      EXPECT_EQ(together.find(channel)->values, merged.find(channel)->values) << channel;
    for (const char* name : {"importon:seed", "importon:passes", "importon:job"})
      EXPECT_EQ(together.attributes.at(name), merged.attributes.at(name)) << name;
    EXPECT_GT(differenceOf(readExr(a), merged, "R"), 1e-3);
  }
}

/// Light is shared once, over the film of both: the same mean as of parts that share it each.
TEST_F(SeveralDevices, SlowShareLightOverTheWholeFilm) {
  const std::string a = folder_ / "a.exr", b = folder_ / "b.exr", m = folder_ / "m.exr";
  ASSERT_EQ(run(small(a, {"--device", "0", "--passes", "4"})).status, 0);
  ASSERT_EQ(run(small(b, {"--device", "1", "--passes", "4", "--seed", kSecondSeed})).status, 0);
  ASSERT_EQ(run({"merge", a, b, "-o", m}).status, 0);
  const Image together = render({"--device", "0,1", "--passes", "8", "--stats", statsFile()});
  EXPECT_NEAR(meanOf(together) / meanOf(readExr(m)), 1, 0.01);
  EXPECT_GT(stats()["error"]["estimated"], 0);
}

TEST_F(SeveralDevices, GiveTheSameBitsEachTime) {
  for (const Words& limit : {Words{"--passes", "4"}, Words{"--error", "0.2"}}) {
    Words words{"--device", "all"};
    words.insert(words.end(), limit.begin(), limit.end());
    const Image first = render(words);
    EXPECT_TRUE(haveSameValues(render(words), first));
  }
}

TEST_F(SeveralDevices, OfWhichThereIsOneRenderAsUsual) {
  const Image plain = render({"--passes", "2"});
  environment_["VK_DRIVER_FILES"] = drivers_ / "a.json";
  EXPECT_TRUE(haveSameValues(render({"--passes", "2", "--device", "all"}), plain));
  EXPECT_EQ(readExr(folder_ / "o.exr").attributes, plain.attributes);
}

/// One pass: the second device has nothing to do, and is not opened.
TEST_F(SeveralDevices, SlowAreNoMoreThanThePasses) {
  const Image image = render({"--passes", "1", "--device", "all", "--stats", statsFile()});
  EXPECT_EQ(stats()["devices"].size(), 1u);
  EXPECT_TRUE(haveSameValues(image, render({"--passes", "1"})));
}

TEST_F(SeveralDevices, StandInTheStatistics) {
  (void)render({"--passes", "5", "--device", "all", "--stats", statsFile()});
  const nlohmann::json all = stats();
  ASSERT_EQ(all["devices"].size(), 2u);
  EXPECT_EQ(all["devices"][0]["passes"], 3);
  EXPECT_EQ(all["devices"][1]["passes"], 2);
  EXPECT_EQ(all["devices"][1]["seed"], std::stoul(kSecondSeed));
  EXPECT_EQ(all["seed"], 0);
  EXPECT_EQ(all["image"]["passes"], 5);
  EXPECT_EQ(all["photons"]["emitted"].get<long>(),
            all["devices"][0]["photons_emitted"].get<long>() + all["devices"][1]["photons_emitted"].get<long>());
  (void)render({"--passes", "5", "--stats", statsFile()});
  EXPECT_EQ(stats()["photons"]["emitted"], all["photons"]["emitted"]);
  EXPECT_EQ(stats()["scene"], all["scene"]);
}

/// A pass on each makes both halves, of which the error is estimated.
TEST_F(SeveralDevices, SlowMakeBothHalvesInAPassEach) {
  (void)render({"--passes", "2", "--device", "all", "--stats", statsFile()});
  EXPECT_TRUE(stats()["error"].contains("estimated")) << stats()["error"];
}

TEST_F(SeveralDevices, SlowStopTogetherAtTheErrorOfTheirImage) {
  (void)render({"--error", "0.2", "--device", "all", "--stats", statsFile()});
  const nlohmann::json all = stats();
  EXPECT_LE(all["error"]["estimated"], 0.2);
  EXPECT_EQ(all["devices"][0]["passes"], all["devices"][1]["passes"]);
}

TEST_F(SeveralDevices, SlowKeepATime) {
  (void)render({"--time", "3", "--device", "all", "--stats", statsFile()});
  const nlohmann::json all = stats();
  EXPECT_LT(all["seconds"]["total"], 5);
  for (const auto& device : all["devices"]) EXPECT_GE(device["passes"], 1);
}

TEST_F(SeveralDevices, SlowGoOnFromACheckpoint) {
  const Image whole = render({"--passes", "8", "--device", "all"});
  const std::string state = folder_ / "o.state";
  (void)render({"--passes", "5", "--device", "all", "--checkpoint", state});
  EXPECT_TRUE(haveSameValues(render({"--passes", "8", "--device", "all", "--resume", state}), whole));
  for (const Words& devices : {Words{}, Words{"--device", "1"}}) {
    Words words{"--passes", "8", "--resume", state};
    words.insert(words.end(), devices.begin(), devices.end());
    const Outcome outcome = run(small(folder_ / "o.exr", words));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("the checkpoint is of another run"), std::string::npos) << outcome.err;
  }
}

/// Sends SIGINT once `text` shows in the progress line.
test::RunOptions interruptAt(const std::string& text) {
  test::RunOptions options;
  options.hasTerminal = true;
  options.onErr = [text](const std::string& err) {
    const bool isThere = err.find(text) != std::string::npos;
    return isThere && err.find("stopping") == std::string::npos ? SIGINT : 0;
  };
  return options;
}

TEST_F(SeveralDevices, SlowStopAtAnInterruptWithTheImageSoFar) {
  const Outcome outcome =
      run(small(folder_ / "o.exr", {"--passes", "1000000", "--device", "all"}), "", interruptAt("pass 6/"));
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_GE(std::stoi(readExr(folder_ / "o.exr").attributes.at("importon:passes")), 6);
}

/// An interrupt may find one device a pass ahead of the other.
TEST_F(SeveralDevices, SlowGoOnFromAnInterruptToTheSameBits) {
  const Words error{"--error", "0.1", "--device", "all"};
  const Image whole = render(error);
  const std::string state = folder_ / "o.state";
  for (const char* moment : {"pass 2/", "pass 4/", "pass 6/"}) {
    Words stopped = error, resumed = error;
    stopped.insert(stopped.end(), {"--checkpoint", state});
    resumed.insert(resumed.end(), {"--resume", state});
    ASSERT_EQ(run(small(folder_ / "o.exr", stopped), "", interruptAt(moment)).status, 130);
    EXPECT_TRUE(haveSameValues(render(resumed), whole)) << moment;
  }
}

/// Whenever the second device is lost, the first makes all passes, and the image is as from that device alone.
TEST_F(SeveralDevices, LeaveOutOneThatIsLost) {
  const Image alone = render({"--passes", "6"});
  for (const char* fault : {"lost 1 1", "lost 45 1", "lost 60 1"}) {
    const Image image = render({"--passes", "6", "--device", "all", "--stats", statsFile()}, fault);
    EXPECT_TRUE(haveSameValues(image, alone)) << fault;
    EXPECT_EQ(image.attributes.at("importon:seed"), "0");
    EXPECT_NE(err_.find("importon: warning: the device was lost"), std::string::npos) << err_;
    EXPECT_NE(err_.find("the other devices go on"), std::string::npos) << err_;
    EXPECT_EQ(stats()["devices"].size(), 1u);
  }
}

TEST_F(SeveralDevices, SlowLeaveOutTheFirstIfItIsLost) {
  const Image alone = render({"--passes", "6", "--device", "1", "--seed", kSecondSeed});
  const Image image = render({"--passes", "6", "--device", "all"}, "lost 60 0");
  EXPECT_EQ(image.attributes, alone.attributes);
  EXPECT_LT(differenceOf(image, alone, "R"), 1e-6);  // its halves have changed places
}

/// One that was lost begins anew when the render goes on, and catches up before the error is estimated again.
TEST_F(SeveralDevices, SlowGoOnWithOneThatWasLost) {
  const Image whole = render({"--passes", "8", "--device", "all"});
  const std::string state = folder_ / "o.state";
  (void)render({"--passes", "4", "--device", "all", "--checkpoint", state}, "lost 45 1");
  EXPECT_NE(err_.find("the device was lost"), std::string::npos) << err_;
  EXPECT_TRUE(haveSameValues(render({"--passes", "8", "--device", "all", "--resume", state}), whole));
  (void)render({"--error", "0.1", "--device", "all", "--resume", state, "--stats", statsFile()});
  EXPECT_EQ(stats()["devices"][0]["passes"], stats()["devices"][1]["passes"]);
}

TEST_F(SeveralDevices, AreAnErrorIfAllAreLost) {
  for (const char* fault : {"lost 1", "lost 45"}) {
    const Outcome outcome = run(small(folder_ / "o.exr", {"--passes", "6", "--device", "all"}), fault);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_NE(outcome.err.find("importon: error: the device was lost"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.entries(), 0);
  }
}

/// In a batch, a lost device is opened anew for the next picture.
TEST_F(SeveralDevices, SlowAreAllThereAgainForTheNextPicture) {
  test::writeFile(folder_ / "jobs.txt", "\"" + kCornellBox + "\" -o one.exr\n\"" + kCornellBox +
                                            "\" -o two.exr --integrator path --max-depth 1 --stats two.json\n");
  const std::string out = folder_ / "out";
  const Outcome outcome = run({"render", "--list", folder_ / "jobs.txt", "-o", out, "--width", "32", "--height", "24",
                               "--importons", "2048", "--photons", "4096", "--passes", "6", "--device", "all"},
                              "lost 60 1");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("the device was lost"), std::string::npos) << outcome.err;
  EXPECT_EQ(readExr(std::filesystem::path(out) / "one.exr").attributes.at("importon:seed"), "0");
  EXPECT_EQ(readExr(std::filesystem::path(out) / "two.exr").attributes.at("importon:seed"), "0 " + kSecondSeed);
}

TEST_F(SeveralDevices, MustEachBeThereOnce) {
  for (const char* devices : {"0,0", "0,voodoo", "0,7", "0,"}) {
    const Outcome outcome = run(small(folder_ / "o.exr", {"--passes", "2", "--device", devices}));
    EXPECT_EQ(outcome.status, 3) << devices;
    EXPECT_EQ(folder_.entries(), 0);
  }
}

}  // namespace
}  // namespace importon
