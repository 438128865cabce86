#include "app/study_options.h"

#include <algorithm>
#include <array>

#include "app/named_job.h"
#include "base/value_checks.h"
#include "fmt/format.h"

namespace importon {
namespace {

struct StudyRender {
  const char *name, *options;
};

// The first one is what the others are held against.
constexpr std::array kRenders{
    StudyRender{"standard", "--control off --gather-from photons"},
    StudyRender{"importance-driven", "--control density --gather-from photons"},
    StudyRender{"by differentials", "--control density --importance differentials"},
    StudyRender{"by probability", "--control probability"},
    StudyRender{"by probability with a floor", "--control probability --probability-floor 0.1"}};

bool saysWhenToStop(const std::string& word) {
  constexpr std::array kOptions{"--passes", "--time", "--error"};
  return std::any_of(kOptions.begin(), kOptions.end(), [&](const char* option) { return word.starts_with(option); });
}

}  // namespace

void addStudyOptions(CLI::App& app, StudyOptions& options) {
  app.add_option("SCENE", options.scene, "the scene, .gltf or .glb")->required()->check(notEmpty())->type_name("");
  app.add_option("-o,--output", options.folder, "folder for study.json and index.html")
      ->required()
      ->check(notEmpty())
      ->type_name("DIR");
  std::string known;
  for (const StudyRender& render : kRenders) known += fmt::format("\n{}: {}", render.name, render.options);
  app.add_option(
         "--config", options.custom,
         fmt::format("a way to render beside these, a name and options of render;\nmay come several times:{}", known))
      ->type_name("\"NAME=OPTIONS\"")
      ->expected(1)
      ->take_all();
  app.allow_extras();
  app.footer("All other options are those of render, for every way: --width, --talk, ... (default: --passes 4)");
}

StudyCommand makeStudyCommand(const StudyOptions& options, const std::vector<std::string>& common) {
  StudyCommand command{options.scene, options.folder, {}, Log::Verbosity::normal};
  std::vector<std::string> all = common;
  if (std::none_of(common.begin(), common.end(), saysWhenToStop)) all.insert(all.end(), {"--passes", "4"});
  for (const StudyRender& render : kRenders)
    command.configs.push_back(makeNamedJob(render.name, render.options, options.scene, all));
  for (const std::string& text : options.custom) command.configs.push_back(parseNamedJob(text, options.scene, all));
  checkNames(command.configs);
  return command;
}

}  // namespace importon
