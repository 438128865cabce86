#include "app/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <sstream>

#include "app/converge_options.h"
#include "base/error.h"
#include "render/options/gather_source.h"
#include "render/options/option_table.h"

namespace importon::command_line_test {
namespace {

/// Cuts at spaces.
std::vector<std::string> words(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

Command parse(const std::string& line) { return parseCommandLine(words(line)); }
RenderCommand parseRender(const std::string& line) { return std::get<RenderCommand>(parse(line)); }

/// The message of the UsageError that the line leads to.
std::string refusal(const std::string& line) {
  try {
    (void)parse(line);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << line;
  return "";
}

TEST(CommandLine, RendersWithDefaults) {
  const RenderCommand command = parseRender("render room.gltf -o room.exr");
  const RenderJob defaults;
  EXPECT_EQ(command.job.scene, "room.gltf");
  EXPECT_EQ(command.job.output, "room.exr");
  EXPECT_EQ(command.job.png, "");
  EXPECT_FALSE(command.job.width.has_value());
  EXPECT_FALSE(command.job.passes.has_value());
  EXPECT_FALSE(command.job.seconds.has_value());
  EXPECT_EQ(command.job.integrator, Integrator::photon);
  EXPECT_EQ(command.job.control, DensityControl::density);
  EXPECT_EQ(command.job.causticDensity, defaults.causticDensity);
  EXPECT_EQ(command.job.redistribute, defaults.redistribute);
  EXPECT_TRUE(command.job.sharesLight);
  EXPECT_EQ(command.verbosity, Log::Verbosity::normal);
  EXPECT_EQ(command.job.commandLine, words("render room.gltf -o room.exr"));
}

TEST(CommandLine, RendersWithoutTheWord) {
  EXPECT_EQ(parseRender("room.gltf -o room.exr").job.scene, "room.gltf");
  EXPECT_EQ(parseRender("-o room.exr room.gltf").job.scene, "room.gltf");
  EXPECT_EQ(parseRender("--output=room.exr room.gltf").job.output, "room.exr");
}

TEST(CommandLine, TalkSetsWhatIsNotGiven) {
  const RenderJob talk = parseRender("a.gltf -o o.exr --talk").job;
  EXPECT_EQ(talk.importons, 80'000u);
  EXPECT_EQ(talk.redistribute, 20);
  EXPECT_EQ(talk.lookup, MapLookup::nearest);
  EXPECT_EQ(talk.lookupPhotons, 80);
  EXPECT_EQ(talk.emission, EmissionChoice::power);
  EXPECT_TRUE(talk.hasProgramLimits);
  EXPECT_FALSE(talk.sharesLight);
  const RenderJob other = parseRender("a.gltf --redistribute 4 -o o.exr --talk --lookup radius --max-depth 16").job;
  EXPECT_EQ(other.redistribute, 4);
  EXPECT_EQ(other.lookup, MapLookup::radius);
  EXPECT_EQ(other.maxDepth, 16);
  EXPECT_EQ(other.importons, 80'000u);
}

TEST(CommandLine, OptionsAboutPhotonsMakeGatherRaysReadThem) {
  EXPECT_EQ(gatherSource(parseRender("a.gltf -o o.exr").job), GatherSource::cells);
  EXPECT_EQ(gatherSource(parseRender("a.gltf -o o.exr --control density").job), GatherSource::cells);
  EXPECT_EQ(gatherSource(parseRender("a.gltf -o o.exr --gather-from cells --lookup-photons 9").job),
            GatherSource::cells);
  EXPECT_EQ(gatherSource(parseRender("a.gltf -o o.exr --gather-from photons").job), GatherSource::photons);
  for (const std::string option :
       {"--control off", "--control probability", "--redistribute 4", "--lookup radius", "--lookup nearest",
        "--irradiance photons", "--irradiance importons", "--importance differentials", "--talk"}) {
    EXPECT_EQ(gatherSource(parseRender("a.gltf -o o.exr " + option).job), GatherSource::photons) << option;
    (void)parseRender("a.gltf -o o.exr --gather-from photons " + option);
    const std::string message = refusal("a.gltf -o o.exr --gather-from cells " + option);
    EXPECT_NE(message.find("--gather-from cells contradicts " + option.substr(0, option.find(' '))), std::string::npos)
        << message;
  }
}

TEST(CommandLine, CollectsWhatThePathTracerHasNoUseFor) {
  const RenderCommand command = parseRender(
      "a.gltf -o o.exr --integrator path --photons 9 --guide-by deficit --quota 9 "
      "--redistribute 2 --gather 4 --seed 1");
  EXPECT_EQ(command.photonOptions, (std::vector<std::string>{"--photons", "--guide-by", "--redistribute", "--quota"}));
  EXPECT_TRUE(parseRender("a.gltf -o o.exr --integrator path --max-depth 3").photonOptions.empty());
}

TEST(CommandLine, OptionsOfTheQuotaNeedReceivers) {
  for (const std::string option :
       {"--acceptance cosine", "--shares distance", "--quota 20", "--density-limits program"})
    EXPECT_NE(refusal("a.gltf -o o.exr " + option).find("needs --redistribute"), std::string::npos) << option;
  const RenderJob job =
      parseRender("a.gltf -o o.exr --redistribute 8 --acceptance cosine --shares direction --quota 20").job;
  EXPECT_EQ(job.acceptance, Acceptance::cosine);
  EXPECT_EQ(job.shares, PowerShares::direction);
  EXPECT_EQ(job.quota, 20);
}

TEST(CommandLine, TakesProbabilityOnlyWithItsControl) {
  const RenderCommand command = parseRender("a.gltf -o o.exr --control probability --probability-floor 0.1");
  EXPECT_EQ(command.job.control, DensityControl::probability);
  EXPECT_EQ(command.job.probabilityFloor, 0.1);
  EXPECT_NE(refusal("a.gltf -o o.exr --probability-floor 0.1").find("--control probability"), std::string::npos);
  EXPECT_NE(refusal("a.gltf -o o.exr --control probability --probability-floor 1.5").find("0 to 1"), std::string::npos);
}

TEST(CommandLine, TakesEveryOptionOfRender) {
  const RenderCommand command = parseRender(
      "render s.glb -o o.exr --png o.png --width 320 --height 200 --camera top --integrator path --passes 7 "
      "--time 2.5 --error 0.01 --photon-batch 512 --photons 1000 --importons 2000 --control off "
      "--caustic-density 30 --global-density 2 "
      "--redistribute 4 --gather 3 --indirect-filter off --max-depth 5 --aov albedo,N,importance.caustic "
      "--seed 42 "
      "--device llvm --threads 2 --memory 512 --stats s.json --no-cache --validation --all-features -v");
  const RenderJob& job = command.job;
  EXPECT_EQ(job.png, "o.png");
  EXPECT_EQ(job.width, 320);
  EXPECT_EQ(job.height, 200);
  EXPECT_EQ(job.camera, "top");
  EXPECT_EQ(job.integrator, Integrator::path);
  EXPECT_EQ(job.passes, 7);
  EXPECT_EQ(job.seconds, 2.5);
  EXPECT_EQ(job.error, 0.01);
  EXPECT_EQ(job.photonBatch, 512u);
  EXPECT_EQ(job.photons, 1000u);
  EXPECT_EQ(job.importons, 2000u);
  EXPECT_EQ(job.control, DensityControl::off);
  EXPECT_EQ(job.causticDensity, 30);
  EXPECT_EQ(job.globalDensity, 2);
  EXPECT_EQ(job.redistribute, 4);
  EXPECT_EQ(job.gather, 3);
  EXPECT_FALSE(job.sharesLight);
  EXPECT_EQ(job.maxDepth, 5);
  EXPECT_EQ(job.aovs, (std::vector<std::string>{"albedo", "N", "importance.caustic"}));
  EXPECT_EQ(job.seed, 42u);
  EXPECT_EQ(job.device, "llvm");
  EXPECT_EQ(job.threads, 2);
  EXPECT_EQ(job.memoryMiB, 512u);
  EXPECT_EQ(job.stats, "s.json");
  EXPECT_TRUE(job.leavesCache);
  EXPECT_TRUE(job.validation);
  EXPECT_TRUE(job.forcesAllFeatures);
  EXPECT_EQ(command.verbosity, Log::Verbosity::verbose);
}

TEST(CommandLine, TakesTheLookOfThePng) {
  const RenderJob defaults = parseRender("s.glb -o o.exr").job;
  EXPECT_FALSE(defaults.look.exposure);
  EXPECT_EQ(defaults.look.toneMap, ToneMap::neutral);
  const RenderJob job = parseRender("s.glb -o o.exr --png o.png --exposure -1.5 --tone-map agx").job;
  EXPECT_EQ(job.look.exposure, -1.5);
  EXPECT_EQ(job.look.toneMap, ToneMap::agx);
  EXPECT_FALSE(parseRender("s.glb -o o.exr --exposure auto").job.look.exposure);
  const auto merge = std::get<MergeCommand>(parse("merge a.exr b.exr -o c.exr --exposure 2 --tone-map none"));
  EXPECT_EQ(merge.job.look.exposure, 2);
  EXPECT_EQ(merge.job.look.toneMap, ToneMap::none);
}

TEST(CommandLine, TakesLightAndBackground) {
  const RenderJob defaults = parseRender("s.glb -o o.exr").job;
  EXPECT_EQ(defaults.light, LightChoice::automatic);
  EXPECT_FALSE(defaults.isTransparent);
  EXPECT_FALSE(defaults.background);
  const RenderJob job =
      parseRender("s.glb -o o.exr --light studio --environment-rotation -90 --background 0.5,1,2e1").job;
  EXPECT_EQ(job.light, LightChoice::studio);
  EXPECT_EQ(job.environmentRotation, -90);
  EXPECT_EQ(job.background, (std::array{0.5f, 1.0f, 20.0f}));
  EXPECT_TRUE(parseRender("s.glb -o o.exr --background transparent").job.isTransparent);
  EXPECT_TRUE(parseRender("s.glb -o o.exr --transparent").job.isTransparent);
  EXPECT_EQ(std::get<InfoCommand>(parse("info s.glb --light studio")).job.light, LightChoice::studio);
}

TEST(CommandLine, TakesAConstantDensity) {
  EXPECT_EQ(parseRender("s.glb -o o.exr --constant-density 1e6").job.constantDensity, 1e6);
}

TEST(CommandLine, TakesPathDifferentials) {
  EXPECT_EQ(parseRender("s.glb -o o.exr").job.importance, ImportanceChoice::map);
  const RenderJob job = parseRender("s.glb -o o.exr --importance differentials --differential-bound pixel").job;
  EXPECT_EQ(job.importance, ImportanceChoice::differentials);
  EXPECT_EQ(job.differentialBound, DifferentialBound::pixel);
}

TEST(CommandLine, TakesTheGreatestSeed) {
  EXPECT_EQ(parseRender("s.glb -o o.exr --seed 4294967295").job.seed, 4294967295u);
}

TEST(CommandLine, ComparesAndInforms) {
  const auto compare =
      std::get<CompareCommand>(parse("compare a.exr r.exr --json --max-relmse 0.1 --max-flip 0.2 --floor 0.01"));
  EXPECT_EQ(compare.image, "a.exr");
  EXPECT_EQ(compare.reference, "r.exr");
  EXPECT_TRUE(compare.isJson);
  EXPECT_EQ(compare.maxRelmse, 0.1);
  EXPECT_EQ(compare.maxFlip, 0.2);
  EXPECT_EQ(compare.floor, 0.01);
  EXPECT_EQ(std::get<InfoCommand>(parse("info s.gltf")).job.scene, "s.gltf");
  EXPECT_FALSE(std::get<InfoCommand>(parse("info s.gltf")).isJson);
  EXPECT_TRUE(std::get<InfoCommand>(parse("info --json s.gltf")).isJson);
  EXPECT_TRUE(std::holds_alternative<DevicesCommand>(parse("devices")));
}

TEST(CommandLine, Merges) {
  const auto merge = std::get<MergeCommand>(parse("merge a.exr b.exr c.exr -o d.exr"));
  EXPECT_EQ(merge.images, (std::vector<std::filesystem::path>{"a.exr", "b.exr", "c.exr"}));
  EXPECT_EQ(merge.output, "d.exr");
}

TEST(CommandLine, ConvergesWithConfigurations) {
  auto arguments = words(
      "converge s.gltf --reference r.exr -o dir --configs path,uncontrolled --times 4,1,2.5 "
      "--seeds 5 --width 64 --height 48 --reference-error 0.001");
  arguments.insert(arguments.end(), {"--config", "many rays=--gather 8 --photons 1000"});
  const auto converge = std::get<ConvergeCommand>(parseCommandLine(arguments));
  EXPECT_EQ(converge.scene, "s.gltf");
  EXPECT_EQ(converge.reference, "r.exr");
  EXPECT_EQ(converge.folder, "dir");
  EXPECT_EQ(converge.times, (std::vector<double>{1, 2.5, 4}));
  EXPECT_EQ(converge.seeds, 5);
  EXPECT_EQ(converge.referenceError, 0.001);
  ASSERT_EQ(converge.configs.size(), 3u);
  EXPECT_EQ(converge.configs[0].job.integrator, Integrator::path);
  EXPECT_EQ(converge.configs[1].job.control, DensityControl::off);
  EXPECT_EQ(converge.configs[1].job.gatherFrom, GatherSource::photons);
  EXPECT_EQ(converge.configs[2].name, "many rays");
  EXPECT_EQ(converge.configs[2].options, "--gather 8 --photons 1000");
  EXPECT_EQ(converge.configs[2].job.gather, 8);
  for (const NamedJob& config : converge.configs) EXPECT_EQ(config.job.width, 64) << config.name;
}

TEST(CommandLine, KnowsOnlyConfigurationsThatRender) {
  for (const KnownConfig& config : knownConfigs()) {
    const auto line = std::string("converge s.gltf --reference r.exr -o dir --configs ") + config.name;
    EXPECT_EQ(std::get<ConvergeCommand>(parse(line)).configs[0].options, config.options);
  }
}

TEST(CommandLine, RefusesBadConfigurations) {
  const std::string start = "converge s.gltf --reference r.exr -o dir ";
  EXPECT_NE(refusal(start + "--configs none").find("choose among default"), std::string::npos);
  EXPECT_NE(refusal(start + "--bogus").find("--bogus"), std::string::npos);
  EXPECT_NE(refusal(start + "--config x=--gather=none").find("configuration x"), std::string::npos);
  EXPECT_NE(refusal(start + "--config default=").find("twice"), std::string::npos);
  EXPECT_NE(refusal(start + "--config nothing").find("no plain name"), std::string::npos);
  EXPECT_NE(refusal(start + "--times 1,soon").find("soon"), std::string::npos);
  EXPECT_NE(refusal("converge s.gltf -o dir").find("--reference"), std::string::npos);
}

TEST(CommandLine, NamesWhatIsMissing) {
  EXPECT_EQ(refusal(""), "no arguments (command line): see importon --help");
  EXPECT_EQ(refusal("s.gltf"), "--output is required (command line): see importon render --help");
  EXPECT_EQ(refusal("render -o o.exr"), "SCENE is required (command line): see importon render --help");
  EXPECT_EQ(refusal("compare a.exr"), "REF.exr is required (command line): see importon compare --help");
}

TEST(CommandLine, RefusesWhatItDoesNotKnow) {
  EXPECT_NE(refusal("s.gltf -o o.exr --bogus").find("--bogus"), std::string::npos);
  EXPECT_NE(refusal("info s.gltf t.gltf").find("t.gltf"), std::string::npos);
  EXPECT_NE(refusal("study s.gltf t.gltf -o out").find("one picture"), std::string::npos);
  EXPECT_NE(refusal("devices all").find("all"), std::string::npos);
}

TEST(CommandLine, RefusesNumbersOutOfRange) {
  EXPECT_EQ(refusal("s.gltf -o o.exr --width 0"),
            "--width: \"0\" is not a whole number from 1 to 65536 pixels (command line): see importon render --help");
  for (const char* bad : {"--width -1",
                          "--width 1e3",
                          "--width 1.5",
                          "--width x",
                          "--height 65537",
                          "--passes 0",
                          "--passes 99999999999",
                          "--time 0",
                          "--time -1",
                          "--time nan",
                          "--time inf",
                          "--time 3s",
                          "--photons 0",
                          "--photon-batch 0",
                          "--error 0",
                          "--importons 0",
                          "--caustic-density 0",
                          "--global-density -2",
                          "--constant-density inf",
                          "--redistribute 0",
                          "--gather 0",
                          "--max-depth 0",
                          "--seed -1",
                          "--seed 4294967296",
                          "--threads 0",
                          "--light dark",
                          "--exposure bright",
                          "--exposure 1e9",
                          "--exposure nan",
                          "--exposure 1EV",
                          "--tone-map filmic",
                          "--environment-rotation x",
                          "--f-stop 0",
                          "--f-stop -2",
                          "--f-stop 0.001",
                          "--f-stop nan",
                          "--f-stop inf",
                          "--f-stop f/2",
                          "--focus 0",
                          "--focus -1",
                          "--focus nan",
                          "--focus inf",
                          "--crop 0 0 4 0",
                          "--environment-rotation inf",
                          "--background white",
                          "--background 1,2",
                          "--background 1,2,3,4",
                          "--background 1,2,-3",
                          "--background 1,2,nan",
                          "--background 1,2,",
                          "--memory 0"}) {
    EXPECT_NE(refusal("s.gltf -o o.exr " + std::string(bad)).find("see importon render --help"), std::string::npos)
        << bad;
  }
  for (const char* bad : {"--max-relmse -1", "--max-flip nan", "--floor x"}) {
    EXPECT_NE(refusal("compare a.exr r.exr " + std::string(bad)).find("see importon compare"), std::string::npos)
        << bad;
  }
}

TEST(CommandLine, ListsTheNamesOfAnOption) {
  EXPECT_EQ(refusal("s.gltf -o o.exr --integrator mlt"),
            "--integrator: \"mlt\" is none of path, photon (command line): see importon render --help");
  const std::string message = refusal("s.gltf -o o.exr --aov albedo,colour");
  EXPECT_NE(message.find("--aov: \"colour\" is not known"), std::string::npos);
  EXPECT_NE(message.find("albedo, N, P, depth, direct"), std::string::npos);
}

TEST(CommandLine, RefusesContradictions) {
  for (const char* bad : {"s.gltf -o o.exr -q -v", "s.gltf -o o.exr --control off --constant-density 5",
                          "s.gltf -o s.gltf", "s.gltf -o o.exr --png o.exr", "s.gltf -o o.exr --stats ./o.exr",
                          "s.gltf -o o.exr --aov N,N", "s.gltf -o o.exr --light studio --environment e.exr",
                          "s.gltf -o o.exr --transparent --background 1,1,1", "s.gltf -o o.exr --width 5 --width 6"}) {
    EXPECT_NE(refusal(bad), "") << bad;
  }
}

TEST(CommandLine, RefusesEmptyNames) {
  EXPECT_THROW((void)parseCommandLine(std::vector<std::string>{"", "-o", "o.exr"}), UsageError);
  EXPECT_THROW((void)parseCommandLine(std::vector<std::string>{"s.gltf", "-o", ""}), UsageError);
  EXPECT_THROW((void)parseCommandLine(std::vector<std::string>{"s.gltf", "-o", "o.exr", "--aov", ""}), UsageError);
}

TEST(CommandLine, HelpNamesEveryCommandAndOption) {
  const std::string help = std::get<TextCommand>(parse("--help-all")).text;
  for (const OptionRow& row : optionTable()) EXPECT_NE(help.find(row.name()), std::string::npos) << row.name();
  for (const char* name : {"render", "info", "compare", "devices", "--quiet", "--verbose", "--talk", "--max-relmse",
                           "--max-flip", "--floor", "--json", "Exit status"}) {
    EXPECT_NE(help.find(name), std::string::npos) << name;
  }
}

/// What one needs every day, in one screen; the rest is a word away.
TEST(CommandLine, HelpOfRenderIsOneScreen) {
  const std::string help = std::get<TextCommand>(parse("render --help")).text;
  EXPECT_LE(std::ranges::count(help, '\n'), 50);
  for (const char* name : {"--output", "--png", "--time", "--error", "--seed", "--device", "--help-all"})
    EXPECT_NE(help.find(name), std::string::npos) << name;
  EXPECT_EQ(help.find("--quota"), std::string::npos);
}

TEST(CommandLine, HelpFollowsAnyArguments) {
  for (const char* line : {"-h", "render -h", "s.gltf --help", "info --help", "compare a.exr --help", "devices -h"}) {
    EXPECT_NE(std::get<TextCommand>(parse(line)).text.find("Usage"), std::string::npos) << line;
  }
}

TEST(CommandLine, TellsItsVersion) { EXPECT_EQ(std::get<TextCommand>(parse("--version")).text.find("importon "), 0u); }

}  // namespace
}  // namespace importon::command_line_test
