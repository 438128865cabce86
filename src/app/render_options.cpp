#include "app/render_options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "app/option_choice.h"
#include "app/talk_options.h"
#include "base/error.h"
#include "fmt/format.h"
#include "render/aov_names.h"
#include "render/gather_source.h"

namespace importon {
namespace {

constexpr const char* kDensityGroup = "Density control";
constexpr std::int64_t kMostPixelsWide = 65536, kMostPasses = 1'000'000, kMostPaths = 1 << 30,
                       kMostThreads = 4096;
constexpr std::int64_t kMostDepth = 1000, kMostGatherRays = 65536, kMostReceivers = 32, kMostMiB = 1 << 30;
constexpr std::int64_t kMostSeed = std::numeric_limits<std::uint32_t>::max();

std::vector<std::string> aovNames() { return {kAovNames.begin(), kAovNames.end()}; }

template <class Value>
std::string withDefault(const std::string& help, Value value) {
  return fmt::format("{} (default: {})", help, value);
}

void addOutputOptions(CLI::App& app, RenderCommand& command) {
  RenderJob& job = command.job;
  const std::string group = "Output";
  app.add_option("-o,--output", job.output, "linear RGB OpenEXR, 32-bit float, with a layer for each AOV")
      ->required()
      ->check(notEmpty())
      ->type_name("F.exr")
      ->group(group);
  app.add_option("--png", job.png, "tone-mapped preview beside it (default: none)")
      ->check(notEmpty())
      ->type_name("F.png")
      ->group(group);
  app.add_option_function<std::string>(
         "--aov", [&job](const std::string& list) { job.aovs = splitNames(list, aovNames(), "--aov"); },
         "extra layers, comma separated (default: none), of\nalbedo N P depth direct caustic indirect emission "
         "variance error\n"
         "importance.caustic importance.global required.caustic\nrequired.global density.caustic "
         "density.global radiance.caustic\nradiance.global importons.caustic importons.global\nphotons.caustic "
         "photons.global")
      ->type_name("LIST")
      ->group(group);
  app.add_option("--reference", job.reference,
                 "image to measure the error against after each pass, for\n--stats (default: none)")
      ->check(notEmpty())
      ->type_name("REF.exr")
      ->group(group);
  app.add_option("--stats", job.stats, "counts, times and warnings as JSON (default: none)")
      ->check(notEmpty())
      ->type_name("F.json")
      ->group(group);
}

void addImageOptions(CLI::App& app, RenderJob& job) {
  const std::string group = "Image";
  app.add_option("--width", job.width, "width of the image (default: the camera's extras.width, else 640)")
      ->check(wholeNumber(1, kMostPixelsWide, "pixels"))
      ->type_name("PIXELS")
      ->group(group);
  app.add_option("--height", job.height, "height of the image (default: by the camera's aspect ratio)")
      ->check(wholeNumber(1, kMostPixelsWide, "pixels"))
      ->type_name("PIXELS")
      ->group(group);
  app.add_option("--camera", job.camera, "which glTF camera, by name or index (default: the first)")
      ->type_name("NAME")
      ->group(group);
}

void addFilterOption(CLI::App& app, RenderJob& job) {
  addChoice<PixelFilter>(app, "--filter",
                         {{"box", PixelFilter::box},
                          {"gaussian", PixelFilter::gaussian},
                          {"blackman-harris", PixelFilter::blackmanHarris}},
                         job.filter, "pixel filter (default: box)")
      ->group("Image");
}

void addLightOptions(CLI::App& app, RenderJob& job) {
  app.add_option("--environment", job.environment,
                 "lat-long environment map; its middle looks along -z, its top is\n+y (default: the scene's)")
      ->check(notEmpty())
      ->type_name("F.exr")
      ->group("Image");
}

void addStoppingOptions(CLI::App& app, RenderJob& job) {
  const std::string group =
      "When to stop, whichever comes first (default: --error 0.05, and 64 passes at most)";
  app.add_option("--passes", job.passes, "after so many passes")
      ->check(wholeNumber(1, kMostPasses, "passes"))
      ->type_name("N")
      ->group(group);
  app.add_option("--time", job.seconds, "after so long, start-up counted")
      ->check(positive("seconds"))
      ->type_name("SECONDS")
      ->group(group);
  app.add_option("--error", job.error, "when the estimated relative error of the image is at most E")
      ->check(positive(""))
      ->type_name("E")
      ->group(group);
}

void addMethodOptions(CLI::App& app, RenderJob& job) {
  const std::string group = "Method";
  addChoice<Integrator>(app, "--integrator", {{"photon", Integrator::photon}, {"path", Integrator::path}},
                        job.integrator,
                        "importance-driven photon map, or the unbiased path tracer\nthat serves as reference "
                        "(default: photon)")
      ->group(group);
  app.add_option("--photons", job.photons, "photons emitted per pass at most (default: automatic)")
      ->check(wholeNumber(1, kMostPaths, "photons"))
      ->type_name("N")
      ->group(group);
  app.add_option("--photon-batch", job.photonBatch, "photons traced at once (default: automatic)")
      ->check(wholeNumber(1, kMostPaths, "photons"))
      ->type_name("N")
      ->group(group);
  app.add_option("--importons", job.importons, "importons per importance map (default: automatic)")
      ->check(wholeNumber(1, kMostPaths, "importons"))
      ->type_name("N")
      ->group(group);
  app.add_option("--gather", job.gather, "final gather rays, or paths of the path tracer, per pixel and\npass (default: automatic)")
      ->check(wholeNumber(1, kMostGatherRays, "rays"))
      ->type_name("N")
      ->group(group);
  addChoice<bool>(
      app, "--adaptive-samples", {{"auto", true}, {"off", false}}, job.isAdaptive,
      "more camera paths for pixels that are noisier; not with\n--gather (default: auto)")
      ->group(group);
  addChoice<bool>(
      app, "--indirect-filter", {{"auto", true}, {"off", false}}, job.filtersIndirect,
      "share gathered irradiance among neighbouring visible points,\nwith a radius that shrinks with "
      "the error (default: auto)")
      ->group(group);
  app.add_option("--max-depth", job.maxDepth, withDefault("longest path, in scattering events", job.maxDepth))
      ->check(wholeNumber(1, kMostDepth, "events"))
      ->type_name("N")
      ->group(group);
  app.add_option("--seed", job.seed, withDefault("same seed, device and options: the same bits", job.seed))
      ->check(wholeNumber(0, kMostSeed, ""))
      ->type_name("N")
      ->group(group);
}

void addDensityOptions(CLI::App& app, RenderJob& job) {
  const std::string group = kDensityGroup;
  addChoice<DensityControl>(app, "--control",
                            {{"off", DensityControl::off},
                             {"density", DensityControl::density},
                             {"probability", DensityControl::probability}},
                            job.control,
                            "the classical photon map, which stores all photons; store or\nredistribute each by the "
                            "required density; or store each with\nthe probability that the density asks for (default: "
                            "density)")
      ->group(group);
  app.add_option("--probability-floor", job.probabilityFloor,
                 withDefault("least such probability, 0 to 1", job.probabilityFloor))
      ->check(share())
      ->type_name("E")
      ->group(group);
  addChoice<ImportanceChoice>(app, "--importance",
                              {{"map", ImportanceChoice::map}, {"differentials", ImportanceChoice::differentials}},
                              job.importance,
                              "required density by the density of importons, or by the\nfootprints of their paths "
                              "(default: map)")
      ->group(group);
  addChoice<DifferentialBound>(app, "--differential-bound",
                               {{"pixel", DifferentialBound::pixel}, {"screen", DifferentialBound::screen}},
                               job.differentialBound,
                               "with --importance differentials: the most that a path nearby\nasks for, or the sum "
                               "(default: screen)")
      ->group(group);
  addChoice<RequiredBy>(app, "--required-density",
                        {{"importance", RequiredBy::importance},
                         {"contribution", RequiredBy::contribution},
                         {"direction", RequiredBy::direction}},
                        job.requiredBy,
                        "in the caustic map by importance; or lower where other light\ndrowns the caustic; or lower for "
                        "light that glossy surfaces do\nnot show from where they are seen (default: importance)")
      ->group(group);
  addChoice<EmissionChoice>(app, "--emission",
                            {{"power", EmissionChoice::power}, {"guided", EmissionChoice::guided}}, job.emission,
                            "photons by the lights' power, or guided to what matters\n(default: guided where it pays)")
      ->group(group);
  addChoice<ScatterChoice>(app, "--scatter",
                           {{"material", ScatterChoice::material}, {"guided", ScatterChoice::guided}}, job.scatter,
                           "photons of the global map scatter by the material alone, or by a\nmixture with what importance "
                           "asks for (default: material)")
      ->group(group);
  addChoice<GuideWeight>(app, "--guide-by",
                         {{"importance", GuideWeight::importance},
                          {"deficit", GuideWeight::deficit},
                          {"potential", GuideWeight::potential}},
                         job.guideWeight,
                         "guided photons go so that noise is least where it is important,\nor there but where photons "
                         "by power leave less than is\nrequired, or in proportion to what they bring to important\nplaces "
                         "(default: deficit)")
      ->group(group);
  addChoice<PhotonsShot>(app, "--shoot", {{"all", PhotonsShot::all}, {"enough", PhotonsShot::enough}}, job.shooting,
                         "all photons of a pass, or as many as important places require\n(default: all)")
      ->group(group);
  addChoice<GatherSource>(app, "--gather-from",
                          {{"cells", GatherSource::cells}, {"photons", GatherSource::photons}}, job.gatherFrom,
                          "final gather rays read the irradiance of the surface cell that\nthey meet, or the photons around "
                          "it, which --control off,\n--control probability, --redistribute, --lookup, --irradiance,\n"
                          "--importance differentials and --talk imply (default: cells)")
      ->group(group);
  app.add_option("--caustic-density", job.causticDensity,
                 withDefault("required in the caustic map, photons per pixel footprint; lookups\nread as many, 5 to 20", job.causticDensity))
      ->check(positive("photons"))
      ->type_name("M")
      ->group(group);
  app.add_option("--global-density", job.globalDensity,
                 withDefault("required in the global map, photons per pixel footprint", job.globalDensity))
      ->check(positive("photons"))
      ->type_name("M")
      ->group(group);
  app.add_option("--constant-density", job.constantDensity,
                 "the same required density everywhere, photons/m²\n(default: off, by importance)")
      ->check(positive("photons/m²"))
      ->type_name("D")
      ->group(group);
  app.add_option("--redistribute", job.redistribute,
                 "nearest stored photons that share a rejected photon's power\n(default: the one of its cell)")
      ->check(wholeNumber(1, kMostReceivers, "photons"))
      ->type_name("M")
      ->group(group);
}

void addMachineOptions(CLI::App& app, RenderCommand& command) {
  RenderJob& job = command.job;
  const std::string group = "Machine";
  app.add_option(
         "--device", job.device,
         "Vulkan device, by name or index, see `importon devices`\n(default: the first discrete GPU, else "
         "integrated, else a CPU)")
      ->check(notEmpty())
      ->type_name("NAME")
      ->group(group);
  app.add_option("--threads", job.threads, "host threads (default: all)")
      ->check(wholeNumber(1, kMostThreads, "threads"))
      ->type_name("N")
      ->group(group);
  app.add_option(
         "--memory", job.memoryMiB,
         "cap on device memory for photon maps; past it they are\ncontrolled harder, with a warning (default: "
         "a quarter of the heap)")
      ->check(wholeNumber(1, kMostMiB, "MiB"))
      ->type_name("MIB")
      ->group(group);
}

void addPauseOptions(CLI::App& app, RenderJob& job) {
  const std::string group = "Pausing";
  app.add_option("--checkpoint", job.checkpoint,
                 "write the state every minute and at the end, Ctrl-C\nincluded (default: none)")
      ->check(notEmpty())
      ->type_name("F")
      ->group(group);
  app.add_option("--resume", job.resume,
                 "go on from a checkpoint of this job, to the same image\nas a run never stopped (default: none)")
      ->check(notEmpty())
      ->type_name("F")
      ->group(group);
}

void addMessageOptions(CLI::App& app, RenderCommand& command) {
  const std::string group = "Messages and checks";
  const auto set = [&command](Log::Verbosity verbosity) {
    if (command.verbosity != Log::Verbosity::normal) {
      throw UsageError("--quiet and --verbose contradict each other", "command line", "leave one of them out");
    }
    command.verbosity = verbosity;
  };
  app.add_flag_callback(
         "-q,--quiet", [=] { set(Log::Verbosity::quiet); }, "warnings and errors only")
      ->group(group);
  app.add_flag_callback(
         "-v,--verbose", [=] { set(Log::Verbosity::verbose); }, "say more")
      ->group(group);
  app.add_flag("--validation", command.job.validation, "Vulkan validation layers")->group(group);
  app.add_flag("--all-features", command.job.forcesAllFeatures,
               "model every feature, whether the scene needs it or not:\nslower, the same image")
      ->group(group);
}

bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  return fs::equivalent(a, b, error) ||
         fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error);
}

/// Names of the given options that only the photon map has a use for.
std::vector<std::string> givenPhotonOptions(const CLI::App& app) {
  constexpr std::array<std::string_view, 5> kOfMethod{"--photons", "--photon-batch", "--importons", "--adaptive-samples",
                                                      "--indirect-filter"};
  std::vector<std::string> given;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_name();
    const bool isOfMethod = std::find(kOfMethod.begin(), kOfMethod.end(), name) != kOfMethod.end();
    const bool isOfGroup = option->get_group() == kDensityGroup || option->get_group() == kTalkGroup;
    if (option->count() > 0 && (isOfMethod || isOfGroup)) given.push_back(name);
  }
  return given;
}

/// Photons are read where an option is about them; then --gather-from cells contradicts it.
void checkGatherSource(const RenderCommand& command) {
  const RenderJob& job = command.job;
  const std::string reason = command.isTalk ? "--talk" : std::string(photonReason(job));
  if (job.gatherFrom == GatherSource::cells && !reason.empty())
    throw UsageError("--gather-from cells contradicts " + reason + ", for which gather rays read photons",
                     "command line", "leave one of them out");
}

void checkRenderCommand(const RenderCommand& command) {
  const RenderJob& job = command.job;
  using Named = std::pair<const char*, const std::filesystem::path*>;
  const std::array<Named, 7> files{Named{"SCENE", &job.scene}, Named{"--output", &job.output},
                                   Named{"--png", &job.png}, Named{"--stats", &job.stats},
                                   Named{"--reference", &job.reference},
                                   Named{"--checkpoint", &job.checkpoint},
                                   Named{"--environment", &job.environment}};
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = i + 1; j < files.size(); ++j) {
      if (files[i].second->empty() || files[j].second->empty()) continue;
      if (isSameFile(*files[i].second, *files[j].second)) {
        throw UsageError(std::string(files[i].first) + " and " + files[j].first + " are the same file",
                         files[j].second->string(), "give each its own name");
      }
    }
  }
  checkGatherSource(command);
  if (job.probabilityFloor > 0 && job.control != DensityControl::probability) {
    throw UsageError("--probability-floor needs --control probability", "command line", "give both, or leave it out");
  }
  if (job.constantDensity && job.control == DensityControl::off) {
    throw UsageError("--constant-density needs density control, which --control off leaves out", "command line",
                     "leave one of them out");
  }
}

}  // namespace

CLI::Option* addOutsideFilesFlag(CLI::App& app, RenderJob& job) {
  return app.add_flag("--allow-outside-files", job.allowsOutsideFiles,
                      "let SCENE name buffers and images outside its folder, which\nonly a scene that you trust should");
}

void addRenderOptions(CLI::App& app, RenderCommand& command) {
  app.add_option("SCENE", command.job.scene, "the scene, .gltf or .glb")
      ->required()
      ->check(notEmpty())
      ->type_name("");
  addOutputOptions(app, command);
  addImageOptions(app, command.job);
  addFilterOption(app, command.job);
  addLightOptions(app, command.job);
  addOutsideFilesFlag(app, command.job)->group("Machine");
  addStoppingOptions(app, command.job);
  addMethodOptions(app, command.job);
  addDensityOptions(app, command.job);
  addTalkOptions(app, command.job, command.isTalk);
  addPauseOptions(app, command.job);
  addMachineOptions(app, command);
  addMessageOptions(app, command);
}

void finishRenderCommand(const CLI::App& app, RenderCommand& command) {
  if (command.isTalk) applyTalk(app, command.job);
  checkTalkOptions(app, command.job);
  command.photonOptions = givenPhotonOptions(app);
  checkRenderCommand(command);
}

}  // namespace importon
