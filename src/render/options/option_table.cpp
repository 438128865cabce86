#include "render/options/option_table.h"

#include <algorithm>
#include <limits>

#include "render/options/gather_source.h"
#include "render/options/image_options.h"
#include "render/options/output_options.h"
#include "render/options/sequence_options.h"

namespace importon {
namespace {

using namespace option_rows;
using Group = OptionGroup;
using Rows = std::vector<OptionRow>;

constexpr std::int64_t kMostPasses = 1'000'000, kMostPaths = 1 << 30, kMostThreads = 4096;
constexpr std::int64_t kMostDepth = 1000, kMostGatherRays = 65536, kMostReceivers = 32, kMostNeighbours = 1000;
constexpr std::int64_t kMostMiB = 1 << 30, kMostSeed = std::numeric_limits<std::uint32_t>::max();

constexpr OptionNeed kNeedsReceivers{.what = "--redistribute",
                                     .isMet = [](const RenderJob& job) { return job.redistribute.has_value(); }};

Rows stopOptions() {
  return {number(Group::stop, "--passes", "N", &RenderJob::passes, wholeNumber(1, kMostPasses, "passes"),
                 "after so many passes")
              .everyday(),
          number(Group::stop, "--time", "SECONDS", &RenderJob::seconds, positive("seconds"),
                 "after so long, start-up counted")
              .everyday(),
          number(Group::stop, "--error", "E", &RenderJob::error, positive(""),
                 "when the estimated relative error of the image is at most E")
              .everyday()};
}

Rows methodOptions() {
  return {
      choice<Integrator>(
          Group::method, "--integrator", &RenderJob::integrator,
          {{"path", Integrator::path}, {"photon", Integrator::photon}},
          "importance-driven photon map, or the unbiased path tracer\nthat serves as reference (default: "
          "photon)")
          .everyday()
          .forImage(),
      number(Group::method, "--photons", "N", &RenderJob::photons, wholeNumber(1, kMostPaths, "photons"),
             "photons emitted per pass at most (default: automatic)")
          .forPhotons(),
      number(Group::method, "--photon-batch", "N", &RenderJob::photonBatch, wholeNumber(1, kMostPaths, "photons"),
             "photons traced at once (default: automatic)")
          .forPhotons(),
      number(Group::method, "--importons", "N", &RenderJob::importons, wholeNumber(1, kMostPaths, "importons"),
             "importons per importance map (default: automatic)")
          .forPhotons(),
      number(Group::method, "--gather", "N", &RenderJob::gather, wholeNumber(1, kMostGatherRays, "rays"),
             "final gather rays, or paths of the path tracer, per pixel and\npass (default: automatic)")
          .forImage(),
      choice<bool>(Group::method, "--adaptive-samples", &RenderJob::isAdaptive, {{"auto", true}, {"off", false}},
                   "more camera paths for pixels that are noisier; not with\n--gather (default: auto)")
          .forPhotons(),
      choice<bool>(Group::method, "--indirect-filter", &RenderJob::sharesLight, {{"auto", true}, {"off", false}},
                   "share direct, caustic and indirect light among pixels that see\nthe same surface, as far as the "
                   "halves of the passes let tell\nlight from noise (default: auto)")
          .forPhotons(),
      number(Group::method, "--max-depth", "N", &RenderJob::maxDepth, wholeNumber(1, kMostDepth, "events"),
             "longest path, in scattering events")
          .forImage(),
      number(Group::method, "--seed", "N", &RenderJob::seed, wholeNumber(0, kMostSeed, ""),
             "same seed and options: the same bits")
          .everyday()};
}

Rows controlOptions() {
  return {
      choice<DensityControl>(
          Group::density, "--control", &RenderJob::control,
          {{"density", DensityControl::density},
           {"off", DensityControl::off},
           {"probability", DensityControl::probability}},
          "the classical photon map, which stores all photons; store or\nredistribute each by the "
          "required density; or store each with\nthe probability that the density asks for (default: "
          "density)")
          .forPhotons()
          .implyingPhotons([](const RenderJob& job) { return job.control != DensityControl::density; }),
      number(Group::density, "--probability-floor", "E", &RenderJob::probabilityFloor, share(),
             "least such probability, 0 to 1")
          .forPhotons()
          .needs({.what = "--control probability",
                  .isMet =
                      [](const RenderJob& job) {
                        return job.probabilityFloor == 0 || job.control == DensityControl::probability;
                      }}),
      choice<ImportanceChoice>(Group::density, "--importance", &RenderJob::importance,
                               {{"differentials", ImportanceChoice::differentials}, {"map", ImportanceChoice::map}},
                               "required density by the density of importons, or by the\nfootprints of their paths "
                               "(default: map)")
          .forPhotons()
          .implyingPhotons([](const RenderJob& job) { return job.importance == ImportanceChoice::differentials; }),
      choice<DifferentialBound>(Group::density, "--differential-bound", &RenderJob::differentialBound,
                                {{"pixel", DifferentialBound::pixel}, {"screen", DifferentialBound::screen}},
                                "with --importance differentials: the most that a path nearby\nasks for, or the sum "
                                "(default: screen)")
          .forPhotons(),
      choice<RequiredBy>(
          Group::density, "--required-density", &RenderJob::requiredBy,
          {{"contribution", RequiredBy::contribution},
           {"direction", RequiredBy::direction},
           {"importance", RequiredBy::importance}},
          "in the caustic map by importance; or lower where other light\ndrowns the caustic; or lower for "
          "light that glossy surfaces do\nnot show from where they are seen (default: importance)")
          .forPhotons()};
}

Rows emissionOptions() {
  return {
      choice<EmissionChoice>(Group::density, "--emission", &RenderJob::emission,
                             {{"guided", EmissionChoice::guided}, {"power", EmissionChoice::power}},
                             "photons by the lights' power, or guided to what matters\n(default: guided where it pays)")
          .forPhotons(),
      choice<ScatterChoice>(Group::density, "--scatter", &RenderJob::scatter,
                            {{"guided", ScatterChoice::guided}, {"material", ScatterChoice::material}},
                            "photons of the global map scatter by the material alone, or by a\nmixture with what "
                            "importance asks for (default: material)")
          .forPhotons(),
      choice<GuideWeight>(Group::density, "--guide-by", &RenderJob::guideWeight,
                          {{"deficit", GuideWeight::deficit},
                           {"importance", GuideWeight::importance},
                           {"potential", GuideWeight::potential}},
                          "guided photons go so that noise is least where it is important,\nor there but where photons "
                          "by power leave less than is\nrequired, or in proportion to what they bring to important\n"
                          "places (default: deficit)")
          .forPhotons(),
      choice<PhotonsShot>(Group::density, "--shoot", &RenderJob::shooting,
                          {{"all", PhotonsShot::all}, {"enough", PhotonsShot::enough}},
                          "all photons of a pass, or as many as important places require\n(default: all)")
          .forPhotons()};
}

OptionRow gatherFrom() {
  OptionRow row = choice<GatherSource>(Group::density, "--gather-from", &RenderJob::gatherFrom,
                                       {{"cells", GatherSource::cells}, {"photons", GatherSource::photons}},
                                       "final gather rays read the irradiance of the surface cell that\nthey meet, or "
                                       "the photons around it, which --control "
                                       "off,\n--control probability, --redistribute, --lookup, "
                                       "--irradiance,\n--importance differentials and --talk imply "
                                       "(default: cells)");
  row.value = [](const RenderJob& job) { return std::string(gatherSourceName(job)); };
  return std::move(row).forPhotons();
}

Rows densityOptions() {
  return {
      gatherFrom(),
      number(Group::density, "--caustic-density", "M", &RenderJob::causticDensity, positive("photons"),
             "required in the caustic map, photons per pixel footprint; lookups\nread as many, 5 to 20")
          .forPhotons(),
      number(Group::density, "--global-density", "M", &RenderJob::globalDensity, positive("photons"),
             "required in the global map, photons per pixel footprint")
          .forPhotons(),
      number(Group::density, "--constant-density", "D", &RenderJob::constantDensity, positive("photons/m²"),
             "the same required density everywhere, photons/m²\n(default: off, by importance)")
          .forPhotons()
          .needs({.what = "density control, which --control off leaves out",
                  .advice = "leave one of them out",
                  .isMet = [](const RenderJob& job) { return job.control != DensityControl::off; }}),
      number(Group::density, "--redistribute", "M", &RenderJob::redistribute, wholeNumber(1, kMostReceivers, "photons"),
             "nearest stored photons that share a rejected photon's power\n(default: the one of its cell)")
          .forPhotons()
          .implyingPhotons([](const RenderJob& job) { return job.redistribute.has_value(); })};
}

Rows quotaOptions() {
  return {
      choice<Acceptance>(
          Group::talk, "--acceptance", &RenderJob::acceptance,
          {{"cosine", Acceptance::cosine}, {"step", Acceptance::step}},
          "store below the required density, or with a probability that\nfalls as a cosine up to it; with "
          "--redistribute (default: step)")
          .forPhotons()
          .needs(kNeedsReceivers),
      choice<PowerShares>(
          Group::talk, "--shares", &RenderJob::shares,
          {{"count", PowerShares::count}, {"direction", PowerShares::direction}, {"distance", PowerShares::distance}},
          "what a rejected photon's power is shared out by; with\n--redistribute (default: count, equal "
          "shares)")
          .forPhotons()
          .needs(kNeedsReceivers),
      number(Group::talk, "--quota", "Q", &RenderJob::quota, wholeNumber(1, kMostNeighbours, "photons"),
             "photons by which density is judged; with --redistribute\n(default: automatic)")
          .forPhotons()
          .needs(kNeedsReceivers),
      choice<bool>(Group::talk, "--density-limits", &RenderJob::hasProgramLimits, {{"own", false}, {"program", true}},
                   "of the talk's author's program: at least 1 photon/m²; up to 3\nneighbours count as none; a bounded "
                   "search (default: own)")
          .forPhotons()
          .needs(kNeedsReceivers)};
}

OptionRow lookupPhotons() {
  const auto check = wholeNumber(2, kMostNeighbours, "photons");
  OptionRow row{
      "--lookup-photons",
      "M|auto",
      "photons of a lookup; auto: as many as a pilot finds best for\neach map (default: 20 in the caustic map, 8 in "
      "the global map)",
      Group::talk,
      [check](const std::string& given) { return given == "auto" ? std::string() : check(given); },
      [](RenderJob& job, const std::string& given) {
        job.choosesLookups = given == "auto";
        if (!job.choosesLookups) job.lookupPhotons = numberOf<int>(given);
      },
      [](const RenderJob& job) { return job.choosesLookups ? "auto" : textOf(job.lookupPhotons); }};
  return std::move(row).forPhotons();
}

Rows lookupOptions() {
  return {
      choice<MapLookup>(
          Group::talk, "--lookup", &RenderJob::lookup, {{"nearest", MapLookup::nearest}, {"radius", MapLookup::radius}},
          "gather rays and camera paths read photons within a radius that\nfollows from the density, or the "
          "nearest photons: slower\n(default: radius, of the caustic map)")
          .forPhotons()
          .implyingPhotons([](const RenderJob& job) { return job.lookup.has_value(); }),
      choice<IrradianceCache>(
          Group::talk, "--irradiance", &RenderJob::irradiance,
          {{"importons", IrradianceCache::importons},
           {"off", IrradianceCache::off},
           {"photons", IrradianceCache::photons}},
          "read the global map's irradiance precomputed at the nearest\nphoton (too bright at edges "
          "of light) or importon (default:\noff)")
          .forPhotons()
          .implyingPhotons([](const RenderJob& job) { return job.irradiance != IrradianceCache::off; }),
      lookupPhotons(),
      number(Group::talk, "--nearest-importons", "M", &RenderJob::nearestImportons,
             wholeNumber(2, kMostNeighbours, "importons"), "importons of an importance estimate (default: automatic)")
          .forPhotons()};
}

Rows runOptions() {
  return {
      text(Group::pausing, "--checkpoint", "F", &RenderJob::checkpoint,
           "write the state every minute and at the end (default: none)")
          .everyday(),
      text(Group::pausing, "--resume", "F", &RenderJob::resume,
           "go on from a checkpoint, to the same image (default: none)")
          .everyday(),
      text(
          Group::machine, "--device", "NAME", &RenderJob::device,
          "Vulkan device, by name or index, or several: A,B or all\n(default: the first discrete GPU, else integrated, "
          "else a CPU)")
          .everyday(),
      number(Group::machine, "--threads", "N", &RenderJob::threads, wholeNumber(1, kMostThreads, "threads"),
             "host threads (default: all)")
          .everyday(),
      number(Group::machine, "--memory", "MIB", &RenderJob::memoryMiB, wholeNumber(1, kMostMiB, "MiB"),
             "cap on device memory for photon maps; past it they are\ncontrolled harder, with a warning (default: a "
             "quarter of the heap)")
          .forImage(),
      flag(Group::machine, "--no-cache", &RenderJob::leavesCache,
           "neither read nor write kernels that the driver has compiled, in\n$XDG_CACHE_HOME/importon or "
           "~/.cache/importon"),
      flag(Group::machine, "--allow-outside-files", &RenderJob::allowsOutsideFiles,
           "let SCENE name buffers and images outside its folder, which\nonly a scene that you trust should"),
      flag(Group::checks, "--strict", &RenderJob::isStrict,
           "refuse SCENE for small faults, which are otherwise mended with a\nwarning"),
      flag(Group::checks, "--validation", &RenderJob::validation, "Vulkan validation layers"),
      flag(Group::checks, "--all-features", &RenderJob::forcesAllFeatures,
           "model every feature, whether the scene needs it or not:\nslower, the same image")};
}

}  // namespace

const std::vector<OptionRow>& optionTable() {
  static const Rows kTable = [] {
    Rows all;
    for (const Rows& rows :
         {outputOptions(), imageOptions(), sequenceOptions(), stopOptions(), methodOptions(), controlOptions(),
          emissionOptions(), densityOptions(), quotaOptions(), lookupOptions(), runOptions()})
      all.insert(all.end(), rows.begin(), rows.end());
    return all;
  }();
  return kTable;
}

std::string_view headingOf(OptionGroup group) {
  switch (group) {
    case Group::output:
      return "Output";
    case Group::image:
      return "Image";
    case Group::stop:
      return "When to stop, whichever comes first (default: --error 0.05, and 64 passes at most)";
    case Group::method:
      return "Method";
    case Group::density:
      return "Density control and guiding";
    case Group::talk:
      return "As in the talk";
    case Group::pausing:
      return "Pausing";
    case Group::machine:
      return "Machine";
    case Group::checks:
      return "Messages and checks";
  }
  return "";
}

const std::vector<TalkSetting>& talkSettings() {
  static const std::vector<TalkSetting> kSettings{{"--importons", "80000"},  // the talk's global map
                                                  {"--photons", "400000"},
                                                  {"--redistribute", "20"},
                                                  {"--caustic-density", "25"},  // from here on the program's
                                                  {"--global-density", "1"},
                                                  {"--nearest-importons", "200"},
                                                  {"--lookup", "nearest"},
                                                  {"--lookup-photons", "80"},
                                                  {"--quota", "20"},
                                                  {"--acceptance", "step"},
                                                  {"--shares", "count"},
                                                  {"--density-limits", "program"},
                                                  {"--emission", "power"},
                                                  {"--indirect-filter", "off"},
                                                  {"--adaptive-samples", "off"},
                                                  {"--max-depth", "7"}};
  return kSettings;
}

}  // namespace importon
