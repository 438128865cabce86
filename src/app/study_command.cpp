#include <array>

#include "app/commands.h"
#include "app/load_scene.h"
#include "app/output_folder.h"
#include "fmt/format.h"
#include "io/output_file.h"
#include "report/study_files.h"

namespace importon {

ExitStatus runStudy(const StudyCommand& command, const std::atomic<bool>& isInterrupted) {
  constexpr std::array kFiles{"study.json", "index.html"};
  makeFolder(command.folder, kFiles);
  Log log(command.verbosity);
  const Scene scene = loadScene(command.configs.front().job, log);
  std::vector<StudyConfig> configs;
  for (const NamedJob& config : command.configs) configs.push_back({config.name, config.options, config.job});
  const auto tell = [&log](const std::string& line) { log.note(line); };
  const StudyReport report = study(configs, scene, log, isInterrupted, tell);
  const StudyTitle title{IMPORTON_VERSION, command.scene.filename().string()};
  writeTextFile(command.folder / kFiles[0], studyJson(title, report));
  writeTextFile(command.folder / kFiles[1], studyPage(title, report));
  return isInterrupted ? ExitStatus::interrupted : ExitStatus::ok;
}

}  // namespace importon
