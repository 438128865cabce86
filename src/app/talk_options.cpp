#include "app/talk_options.h"

#include <array>

#include "app/option_choice.h"
#include "base/error.h"

namespace importon {
namespace {

constexpr std::int64_t kMostNeighbours = 1000;

void addQuotaOptions(CLI::App& app, RenderJob& job) {
  addChoice<Acceptance>(app, "--acceptance", {{"step", Acceptance::step}, {"cosine", Acceptance::cosine}},
                        job.acceptance,
                        "store below the required density, or with a probability that\nfalls as a cosine up to it; with "
                        "--redistribute (default: step)")
      ->group(kTalkGroup);
  addChoice<PowerShares>(app, "--shares",
                         {{"count", PowerShares::count},
                          {"distance", PowerShares::distance},
                          {"direction", PowerShares::direction}},
                         job.shares,
                         "what a rejected photon's power is shared out by; with\n--redistribute (default: count, equal "
                         "shares)")
      ->group(kTalkGroup);
  app.add_option("--quota", job.quota, "photons by which density is judged; with --redistribute\n(default: automatic)")
      ->check(wholeNumber(1, kMostNeighbours, "photons"))
      ->type_name("Q")
      ->group(kTalkGroup);
  addChoice<bool>(app, "--density-limits", {{"own", false}, {"program", true}}, job.hasProgramLimits,
                  "of the talk's author's program: at least 1 photon/m²; up to 3\nneighbours count as none; a bounded "
                  "search (default: own)")
      ->group(kTalkGroup);
}

void addLookupOptions(CLI::App& app, RenderJob& job) {
  addChoice<MapLookup>(app, "--lookup", {{"radius", MapLookup::radius}, {"nearest", MapLookup::nearest}}, job.lookup,
                       "gather rays and camera paths read photons within a radius that\nfollows from the density, or the "
                       "nearest photons: slower\n(default: radius, of the caustic map)")
      ->group(kTalkGroup);
  addChoice<IrradianceCache>(app, "--irradiance",
                             {{"off", IrradianceCache::off},
                              {"photons", IrradianceCache::photons},
                              {"importons", IrradianceCache::importons}},
                             job.irradiance,
                             "read the global map's irradiance precomputed at the nearest\nphoton (too bright at edges "
                             "of light) or importon (default:\noff)")
      ->group(kTalkGroup);
  const auto check = wholeNumber(2, kMostNeighbours, "photons");
  app.add_option_function<std::string>(
         "--lookup-photons",
         [&job](const std::string& text) {
           job.choosesLookups = text == "auto";
           if (text != "auto") job.lookupPhotons = std::stoi(text);
         },
         "photons of a lookup; auto: as many as a pilot finds best for\neach map (default: 20 in the caustic map, 8 in the "
         "global map)")
      ->check([check](const std::string& text) { return text == "auto" ? std::string() : check(text); })
      ->type_name("M|auto")
      ->group(kTalkGroup);
  app.add_option("--nearest-importons", job.nearestImportons, "importons of an importance estimate (default: automatic)")
      ->check(wholeNumber(2, kMostNeighbours, "importons"))
      ->type_name("M")
      ->group(kTalkGroup);
}

}  // namespace

void addTalkOptions(CLI::App& app, RenderJob& job, bool& isTalk) {
  app.add_flag("--talk", isTalk, "all settings of the talk and its author's program, where no\nother is given")
      ->group(kTalkGroup);
  addQuotaOptions(app, job);
  addLookupOptions(app, job);
}

void applyTalk(const CLI::App& app, RenderJob& job) {
  const auto set = [&app](const char* option, auto& target, auto value) {
    if (app.count(option) == 0) target = value;
  };
  set("--importons", job.importons, 80'000u);  // the talk's global map
  set("--photons", job.photons, 400'000u);
  set("--redistribute", job.redistribute, 20);
  set("--caustic-density", job.causticDensity, 25.0);  // from here on the program's
  set("--global-density", job.globalDensity, 1.0);
  set("--nearest-importons", job.nearestImportons, 200);
  set("--lookup", job.lookup, MapLookup::nearest);
  set("--lookup-photons", job.lookupPhotons, 80);
  set("--quota", job.quota, 20);
  set("--acceptance", job.acceptance, Acceptance::step);
  set("--shares", job.shares, PowerShares::count);
  set("--density-limits", job.hasProgramLimits, true);
  set("--emission", job.emission, EmissionChoice::power);
  set("--indirect-filter", job.filtersIndirect, false);
  set("--adaptive-samples", job.isAdaptive, false);
  set("--max-depth", job.maxDepth, 7);
}

void checkTalkOptions(const CLI::App& app, const RenderJob& job) {
  constexpr std::array kOfQuota{"--acceptance", "--shares", "--quota", "--density-limits"};
  for (const char* option : kOfQuota) {
    if (app.count(option) > 0 && !job.redistribute)
      throw UsageError(std::string(option) + " needs --redistribute", "command line", "give both, or leave it out");
  }
}

}  // namespace importon
