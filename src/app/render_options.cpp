#include "app/render_options.h"

#include <algorithm>
#include <array>
#include <utility>

#include "app/batch/batch_options.h"
#include "base/error.h"
#include "fmt/format.h"
#include "fmt/ranges.h"
#include "io/picture_file.h"
#include "render/options/gather_source.h"
#include "render/options/option_table.h"
#include "render/options/sequence_options.h"

namespace importon {
namespace {

std::string headingAsText(OptionGroup group) { return std::string(headingOf(group)); }

/// A value of several words, which are checked as one text.
CLI::Option* addWords(CLI::App& app, const OptionRow& row, RenderJob& job) {
  const auto take = [&row, &job](const std::vector<std::string>& words) {
    const std::string text = fmt::format("{}", fmt::join(words, " ")), fault = row.check(text);
    if (!fault.empty()) throw CLI::ValidationError(row.name(), fault);
    row.set(job, text);
  };
  return app.add_option_function<std::vector<std::string>>(row.names, take, row.help)
      ->type_size(row.words)
      ->expected(1);
}

CLI::Option* addWord(CLI::App& app, const OptionRow& row, RenderJob& job) {
  CLI::Option* option = app.add_option_function<std::string>(
      row.names, [&row, &job](const std::string& text) { row.set(job, text); }, row.help);
  return row.check ? option->check(row.check) : option;
}

void addRow(CLI::App& app, const OptionRow& row, RenderJob& job, const std::string& group) {
  CLI::Option* option = nullptr;
  if (row.type.empty())
    option = app.add_flag_callback(
        row.names, [&row, &job] { row.set(job, {}); }, row.help);
  else
    option = (row.words > 1 ? addWords : addWord)(app, row, job)->type_name(row.type);
  if (row.isRequired) option->required();
  option->group(group);
}

const OptionRow& rowOf(const std::string& name) {
  const std::vector<OptionRow>& table = optionTable();
  return *std::ranges::find_if(table, [&](const OptionRow& row) { return row.name() == name; });
}

void addMessageOptions(CLI::App& app, RenderCommand& command) {
  const auto set = [&command](Log::Verbosity verbosity) {
    if (command.verbosity != Log::Verbosity::normal) {
      throw UsageError("--quiet and --verbose contradict each other", "command line", "leave one of them out");
    }
    command.verbosity = verbosity;
  };
  const std::string group = headingAsText(OptionGroup::checks);
  app.add_flag_callback(
         "-q,--quiet", [=] { set(Log::Verbosity::quiet); }, "warnings and errors only")
      ->group(group);
  app.add_flag_callback(
         "-v,--verbose", [=] { set(Log::Verbosity::verbose); }, "say more")
      ->group(group);
}

bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  namespace fs = std::filesystem;
  std::error_code error;
  return fs::equivalent(a, b, error) ||
         fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error);
}

/// A line of a list lacks some options.
bool isGiven(const CLI::App& app, const OptionRow& row) {
  const CLI::Option* option = app.get_option_no_throw(row.name());
  return option != nullptr && option->count() > 0;
}

/// Names of the given options that only the photon map has a use for.
std::vector<std::string> givenPhotonOptions(const CLI::App& app) {
  std::vector<std::string> given;
  for (const OptionRow& row : optionTable())
    if (row.isOfPhotons && isGiven(app, row)) given.push_back(row.name());
  if (app.count("--talk") > 0) given.emplace_back("--talk");
  return given;
}

/// Photons are read where an option is about them; then --gather-from cells contradicts it.
void checkGatherSource(const RenderCommand& command) {
  const std::string reason = command.isTalk ? "--talk" : photonReason(command.job);
  if (command.job.gatherFrom == GatherSource::cells && !reason.empty())
    throw UsageError("--gather-from cells contradicts " + reason + ", for which gather rays read photons",
                     "command line", "leave one of them out");
}

void checkFiles(const RenderJob& job) {
  using Named = std::pair<const char*, const std::filesystem::path*>;
  const std::array<Named, 7> files{Named{"SCENE", &job.scene},
                                   Named{"--output", &job.output},
                                   Named{"--png", &job.png},
                                   Named{"--stats", &job.stats},
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
}

/// Throws UsageError where a name tells of no kind of pictures that there is.
void checkKind(const char* option, const std::filesystem::path& file, PictureKind plain, bool isForScreensAlone) {
  if (file.empty()) return;
  const std::optional<PictureKind> kind = pictureKind(file, plain);
  if (kind && (!isForScreensAlone || isForScreens(*kind))) return;
  throw UsageError(fmt::format("{} names no kind of pictures that it can be", option), file.string(),
                   isForScreensAlone ? "give .png or .jpg" : "give .exr, .hdr, .png or .jpg");
}

void checkNeeds(const RenderCommand& command) {
  for (const OptionRow& row : optionTable())
    if (row.need.isMet != nullptr && std::ranges::count(command.given, row.name()) > 0 && !row.need.isMet(command.job))
      throw UsageError(fmt::format("{} needs {}", row.name(), row.need.what), "command line", row.need.advice);
}

/// The settings of the talk, where the command line does not give others.
void applyTalk(const CLI::App& app, RenderJob& job) {
  for (const TalkSetting& setting : talkSettings())
    if (app.count(setting.option) == 0) rowOf(setting.option).set(job, setting.value);
}

bool isEveryday(const CLI::Option& option) {
  constexpr std::array kOwn{"SCENE", "--list", "--help", "--help-all", "--quiet", "--verbose"};
  const std::string name = option.get_name(),
                    bare = option.get_lnames().empty() ? name : "--" + option.get_lnames().front();
  if (std::ranges::find(kOwn, bare) != kOwn.end()) return true;
  return std::ranges::any_of(optionTable(), [&](const OptionRow& row) { return row.name() == bare && row.isEveryday; });
}

}  // namespace

void checkPictureKinds(const RenderJob& job) {
  checkKind("--output", job.output, PictureKind::exr, false);
  checkKind("--png", job.png, PictureKind::png, true);
}

void addSceneOptions(CLI::App& app, RenderJob& job) {
  for (const char* name :
       {"--scene", "--variant", "--at", "--animation", "--light", "--environment", "--strict", "--allow-outside-files"})
    addRow(app, rowOf(name), job, "Options");
}

void addLookOptions(CLI::App& app, RenderJob& job) {
  for (const char* name : {"--exposure", "--tone-map", "--png-depth"}) addRow(app, rowOf(name), job, "Options");
}

void addRenderOptions(CLI::App& app, RenderCommand& command) {
  app.add_option("SCENE", command.scenes, "the scene, .gltf or .glb; several: -o and --png name folders")
      ->required()
      ->check(notEmpty())
      ->type_name("");
  app.add_option("--list", command.list, "text file that names a further scene, with its options, in each line")
      ->check(notEmpty())
      ->type_name("FILE")
      ->group(headingAsText(OptionGroup::output));
  for (const OptionRow& row : optionTable()) addRow(app, row, command.job, headingAsText(row.group));
  app.add_flag("--talk", command.isTalk, "all settings of the talk and its author's program, where no\nother is given")
      ->group(headingAsText(OptionGroup::talk));
  addMessageOptions(app, command);
}

void finishRenderCommand(const CLI::App& app, RenderCommand& command) {
  if (command.scenes.size() == 1) command.job.scene = command.scenes.front();
  if (app.count("--talk") > 0) applyTalk(app, command.job);
  for (const std::string& name : givenPhotonOptions(app)) command.photonOptions.push_back(name);
  for (const OptionRow& row : optionTable())
    if (isGiven(app, row)) command.given.push_back(row.name());
  if (!isBatch(command)) {  // the files of a batch: checkJobFiles
    checkFiles(command.job);
    checkPictureKinds(command.job);
  }
  checkGatherSource(command);
  checkNeeds(command);
}

void parseListLine(std::vector<std::string> words, RenderCommand& command, const ListFolders& folders) {
  CLI::App app;
  app.set_help_flag();
  addRenderOptions(app, command);
  app.get_option("--output")->required(false);
  for (const char* name : {"--list", "--quiet", "--verbose"}) app.remove_option(app.get_option(name));
  for (const OptionRow& row : sequenceOptions()) app.remove_option(app.get_option(row.name()));
  std::ranges::reverse(words);  // CLI11 takes them from the end
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what(), "", "");
  }
  if (command.scenes.size() > 1) throw UsageError("a line has one scene", "", "");
  using Place = std::pair<const char*, std::filesystem::path RenderJob::*>;
  using J = RenderJob;
  const auto place = [&](const std::filesystem::path& folder, std::initializer_list<Place> names) {
    for (const auto& [name, member] : names)
      if (app.count(name) > 0) command.job.*member = folder / command.job.*member;
  };
  place(folders.inputs, {{"--environment", &J::environment}, {"--reference", &J::reference}, {"--resume", &J::resume}});
  place(folders.outputs,
        {{"--output", &J::output}, {"--png", &J::png}, {"--stats", &J::stats}, {"--checkpoint", &J::checkpoint}});
  command.scenes.front() = folders.inputs / command.scenes.front();
  finishRenderCommand(app, command);
}

void hideRareOptions(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (!isEveryday(*option)) option->group("");
  app.footer("All options, the settings of the talk and of research among them: importon render --help-all");
}

}  // namespace importon
