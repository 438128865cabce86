#include <array>
#include <charconv>
#include <cmath>

#include "app/commands.h"
#include "app/load_scene.h"
#include "app/output_folder.h"
#include "app/reference_errors.h"
#include "fmt/format.h"
#include "io/image.h"
#include "io/layers.h"
#include "io/output_file.h"
#include "report/converge_files.h"
#include "report/merge.h"

namespace importon {
namespace {

using Clock = std::chrono::steady_clock;

/// What is given, else what `merge` wrote into the image.
std::optional<double> referenceError(const ConvergeCommand& command, const Image& reference) {
  if (command.referenceError) return command.referenceError;
  const auto found = reference.attributes.find(kOwnError);
  if (found == reference.attributes.end()) return {};
  double error = 0;
  const std::string& text = found->second;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), error);
  if (read.ec == std::errc() && std::isfinite(error)) return error;
  return {};
}

constexpr std::array kFiles{"results.json", "results.csv", "index.html"};

}  // namespace

ExitStatus runConverge(const ConvergeCommand& command, const std::atomic<bool>& isInterrupted) {
  makeFolder(command.folder, kFiles);
  Log log(command.verbosity);
  Image reference = takeColor(readExr(command.reference), "", command.reference.string());
  const Clock::time_point loadStart = Clock::now();
  const Scene scene = loadScene(command.configs.front().job, log);
  reference = ofFilm(std::move(reference), command.reference.string(), command.configs.front().job, scene);
  ConvergePlan plan{{}, command.times, command.seeds, 0};
  plan.loadSeconds = std::chrono::duration<double>(Clock::now() - loadStart).count();
  for (const NamedJob& config : command.configs) plan.configs.push_back({config.name, config.options, config.job});

  const auto tell = [&log](const std::string& line) { log.note(line); };
  const ConvergeReport report = converge(plan, scene, reference, command.reference.string(), log, isInterrupted, tell);
  const ConvergeTitle title{
      IMPORTON_VERSION, command.scene.filename().string(), command.reference.filename().string(), command.seeds,
      command.times,    referenceError(command, reference)};
  writeTextFile(command.folder / kFiles[0], convergeJson(title, report));
  writeTextFile(command.folder / kFiles[1], convergeCsv(report));
  writeTextFile(command.folder / kFiles[2], convergePage(title, report, reference));
  return isInterrupted ? ExitStatus::interrupted : ExitStatus::ok;
}

}  // namespace importon
