#include "app/converge_options.h"

#include <algorithm>
#include <sstream>

#include "app/named_job.h"
#include "base/error.h"
#include "base/value_checks.h"
#include "fmt/format.h"

namespace importon {
namespace {

constexpr const char* kDefaultNames = "default,photons,uncontrolled,path";

std::vector<std::string> knownNames() {
  std::vector<std::string> names;
  for (const KnownConfig& config : knownConfigs()) names.emplace_back(config.name);
  return names;
}

std::string optionsOf(const std::string& name) {
  for (const KnownConfig& config : knownConfigs()) {
    if (config.name == name) return config.options;
  }
  return "";
}

std::vector<double> timesOf(const std::string& list) {
  std::vector<double> times;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) {
    if (const std::string wrong = positive("seconds")(part); !wrong.empty())
      throw UsageError("--times: " + wrong, "command line", "give seconds, comma separated");
    times.push_back(std::stod(part));
  }
  if (times.empty()) throw UsageError("--times is empty", "command line", "give seconds, comma separated");
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace

std::vector<KnownConfig> knownConfigs() {
  return {{"default", ""},
          {"photons", "--gather-from photons"},
          {"uncontrolled", "--control off --gather-from photons"},
          {"density", "--control density"},
          {"unfiltered", "--indirect-filter off"},
          {"even", "--adaptive-samples off"},
          {"differentials", "--importance differentials"},
          {"probability", "--control probability"},
          {"power", "--emission power"},
          {"guided", "--emission guided"},
          {"path", "--integrator path"}};
}

void addConvergeOptions(CLI::App& app, ConvergeOptions& options) {
  app.add_option("SCENE", options.scene, "the scene, .gltf or .glb")->required()->check(notEmpty())->type_name("");
  app.add_option("--reference", options.reference, "the image to measure against, converged, of the same size")
      ->required()
      ->check(notEmpty())
      ->type_name("REF.exr");
  app.add_option("-o,--output", options.folder, "folder for results.json, results.csv and index.html")
      ->required()
      ->check(notEmpty())
      ->type_name("DIR");
  std::string known;
  for (const KnownConfig& config : knownConfigs()) known += fmt::format("\n{}: {}", config.name, config.options);
  options.names = splitNames(kDefaultNames, knownNames(), "--configs");
  app.add_option_function<std::string>(
         "--configs",
         [&options](const std::string& list) { options.names = splitNames(list, knownNames(), "--configs"); },
         fmt::format("configurations, comma separated (default: {}), of{}", kDefaultNames, known))
      ->type_name("LIST");
  app.add_option("--config", options.custom, "a further one: a name and options of render, may come\nseveral times")
      ->type_name("\"NAME=OPTIONS\"")
      ->expected(1)
      ->take_all();
  options.times = {5, 10, 20, 40};
  app.add_option_function<std::string>(
         "--times", [&options](const std::string& list) { options.times = timesOf(list); },
         "time budgets in seconds, comma separated (default: 5,10,20,40)")
      ->type_name("LIST");
  app.add_option("--seeds", options.seeds, "runs of each configuration (default: 4)")
      ->check(wholeNumber(1, 10000, "seeds"))
      ->type_name("N");
  app.add_option("--reference-error", options.referenceError,
                 "trimmed relMSE of the reference's own noise (default: what\nmerge wrote into it, else unknown)")
      ->check(notNegative("error"))
      ->type_name("X");
  app.allow_extras();
  app.footer("All other options are those of render, for every configuration: --width, --device, ...");
}

ConvergeCommand makeConvergeCommand(const ConvergeOptions& options, const std::vector<std::string>& common) {
  ConvergeCommand command{options.scene, options.reference, options.folder,         {},
                          options.times, options.seeds,     options.referenceError, {}};
  for (const std::string& name : options.names)
    command.configs.push_back(makeNamedJob(name, optionsOf(name), options.scene, common));
  for (const std::string& text : options.custom) command.configs.push_back(parseNamedJob(text, options.scene, common));
  checkNames(command.configs);
  return command;
}

}  // namespace importon
