#include "app/command_line.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "CLI/CLI.hpp"
#include "app/batch/batch_options.h"
#include "app/batch/sequence_command.h"
#include "app/converge_options.h"
#include "app/render_options.h"
#include "app/study_options.h"
#include "base/error.h"
#include "base/value_checks.h"
#include "render/options/sequence_options.h"

namespace importon {
namespace {

/// All commands with the targets of their options.
struct Parser {
  CLI::App app{
      "importon renders glTF 2.0 scenes by importance-driven photon mapping.\n"
      "`importon SCENE -o OUT.exr` is short for `importon render SCENE -o OUT.exr`.",
      "importon"};
  RenderCommand render;
  InfoCommand info;
  CompareCommand compare;
  ConvergeOptions converge;
  StudyOptions study;
  MergeCommand merge;
  CLI::App *renderApp = nullptr, *infoApp = nullptr, *compareApp = nullptr, *convergeApp = nullptr, *studyApp = nullptr,
           *mergeApp = nullptr, *devicesApp = nullptr;

  Parser();
  void addInfo();
  void addCompare();
  void addCompareOutputs();
  void addCompareLimits();
  void addMerge();
  [[nodiscard]] Command chosen();
};

Parser::Parser() {
  constexpr std::size_t kColumn = 30;
  app.get_formatter()->column_width(kColumn);
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string(IMPORTON_VERSION));
  app.set_help_all_flag("--help-all", "every option of every command");
  app.footer(
      "Exit status: 0 done; 1 usage; 2 scene; 3 device; 4 output; 5 a limit of compare exceeded;\n"
      "130 interrupted, after the image so far was written.");
  renderApp = app.add_subcommand("render", "render SCENE to an OpenEXR file");
  addRenderOptions(*renderApp, render);
  renderApp->set_help_all_flag("--help-all", "every option");
  addInfo();
  addCompare();
  convergeApp = app.add_subcommand(
      "converge", "render SCENE in several ways, and write error against time as JSON, CSV and a web page");
  addConvergeOptions(*convergeApp, converge);
  studyApp = app.add_subcommand(
      "study", "render SCENE with and without density control, and write the talk's figures as a web page");
  addStudyOptions(*studyApp, study);
  addMerge();
  devicesApp = app.add_subcommand("devices", "list the Vulkan devices, with the one that would be used");
}

void Parser::addInfo() {
  infoApp = app.add_subcommand("info", "print what SCENE holds, and which transport it needs and why");
  infoApp->add_option("SCENE", info.job.scene, "the scene, .gltf or .glb")
      ->required()
      ->check(notEmpty())
      ->type_name("");
  infoApp->add_flag("--json", info.isJson, "as JSON");
  addSceneOptions(*infoApp, info.job);
}

void Parser::addCompare() {
  compareApp = app.add_subcommand(
      "compare",
      "print relMSE, trimmed relMSE, SMAPE, RMSE, mean ratio, FLIP, blotches and grain of A.exr against REF.exr");
  compareApp->add_option("A.exr", compare.image, "the image")->required()->check(notEmpty())->type_name("");
  compareApp->add_option("REF.exr", compare.reference, "the reference")->required()->check(notEmpty())->type_name("");
  compareApp->add_flag("--json", compare.isJson, "as JSON");
  const auto addLayer = [&](const char* name, std::string& target, const char* of) {
    compareApp->add_option(name, target, std::string("layer of ") + of + " (default: R, G, B, or the only colour)")
        ->check(notEmpty())
        ->type_name("NAME");
  };
  addLayer("--layer", compare.layer, "A.exr");
  addLayer("--reference-layer", compare.referenceLayer, "REF.exr");
  addCompareOutputs();
  addCompareLimits();
}

void Parser::addCompareOutputs() {
  compareApp
      ->add_option("--diff", compare.diff,
                   "write A - REF as R, G, B, with the layers relative.Y,\nflip.Y and flip_hdr.Y (default: none)")
      ->check(notEmpty())
      ->type_name("F.exr");
  compareApp
      ->add_option("--diff-png", compare.diffPng,
                   "write FLIP in false colours, black (0) over violet,\nred and orange to pale yellow (1) "
                   "(default: none)")
      ->check(notEmpty())
      ->type_name("F.png");
}

void Parser::addCompareLimits() {
  const auto addLimit = [&](const char* name, std::optional<double>& target, const std::string& metric) {
    compareApp->add_option(name, target, "exit with 5 when " + metric + " is above (default: no limit)")
        ->check(notNegative(""))
        ->type_name("X");
  };
  addLimit("--max-relmse", compare.maxRelmse, "relMSE");
  addLimit("--max-flip", compare.maxFlip, "FLIP");
  addLimit("--max-flip-hdr", compare.maxFlipHdr, "HDR-FLIP");
  addLimit("--max-band", compare.maxBand, "the RMS of blotches, in percent,");
  compareApp
      ->add_option("--floor", compare.floor, "absolute floor in the denominator of relMSE\n(default: 0.01·mean(R)²)")
      ->check(notNegative(""))
      ->type_name("X");
}

void Parser::addMerge() {
  mergeApp = app.add_subcommand("merge", "average runs of the same image with different seeds, by their passes");
  mergeApp->add_option("A.exr", merge.images, "two images or more")
      ->required()
      ->expected(2, -1)
      ->check(notEmpty())
      ->type_name("");
  mergeApp->add_option("-o,--output", merge.output, "the average, with the layers of the images")
      ->required()
      ->check(notEmpty())
      ->type_name("F.exr");
  mergeApp->add_option("--png", merge.png, "tone-mapped preview beside it, F.jpg a JPEG (default: none)")
      ->check(notEmpty())
      ->type_name("F.png");
  addLookOptions(*mergeApp, merge.job);
}

Command Parser::chosen() {
  if (renderApp->parsed()) {
    finishRenderCommand(*renderApp, render);
    if (isSequence(render.job)) return makeSequenceCommand(render);
    if (isBatch(render)) return makeBatchCommand(render);
    return render;
  }
  if (infoApp->parsed()) return info;
  if (compareApp->parsed()) return compare;
  if (convergeApp->parsed()) return makeConvergeCommand(converge, convergeApp->remaining());
  if (studyApp->parsed()) return makeStudyCommand(study, studyApp->remaining());
  if (mergeApp->parsed()) {
    RenderJob outputs;
    outputs.png = merge.png;
    checkPictureKinds(outputs);
    return merge;
  }
  return DevicesCommand{};
}

/// Puts `render` before what is no command.
std::vector<std::string> withCommand(std::span<const std::string> arguments) {
  constexpr std::array<std::string_view, 11> kFirstWords{
      "render", "info", "compare", "converge", "study", "merge", "devices", "--help", "-h", "--help-all", "--version"};
  std::vector<std::string> words(arguments.begin(), arguments.end());
  if (std::find(kFirstWords.begin(), kFirstWords.end(), words.front()) == kFirstWords.end()) {
    words.insert(words.begin(), "render");
  }
  return words;
}

/// A list may name scenes and outputs alone.
void needLessForList(CLI::App& renderApp, std::span<const std::string> words) {
  const auto isList = [](const std::string& word) { return word == "--list" || word.starts_with("--list="); };
  if (std::ranges::none_of(words, isList)) return;
  for (const char* name : {"SCENE", "--output"}) renderApp.get_option(name)->required(false);
}

/// One blank line where CLI11 puts two.
std::string withoutDoubleBlanks(std::string text) {
  for (std::size_t at = 0; (at = text.find("\n\n\n", at)) != std::string::npos;) text.erase(at, 1);
  return text;
}

}  // namespace

Command parseCommandLine(std::span<const std::string> arguments) {
  if (arguments.empty()) throw UsageError("no arguments", "command line", "see importon --help");
  Parser parser;
  std::vector<std::string> words = withCommand(arguments);
  const std::string seeHelp = "see importon " + (words.front().starts_with('-') ? "" : words.front() + " ") + "--help";
  parser.render.job.commandLine.assign(arguments.begin(), arguments.end());
  needLessForList(*parser.renderApp, words);
  std::reverse(words.begin(), words.end());  // CLI11 takes them from the end
  try {
    parser.app.parse(words);
  } catch (const CLI::CallForVersion&) {
    return TextCommand{std::string("importon ") + IMPORTON_VERSION + "\n"};
  } catch (const CLI::CallForHelp&) {
    hideRareOptions(*parser.renderApp);
    return TextCommand{withoutDoubleBlanks(parser.app.help())};
  } catch (const CLI::CallForAllHelp&) {
    const bool isForOne = !parser.app.get_subcommands().empty();
    return TextCommand{parser.app.help("", isForOne ? CLI::AppFormatMode::Normal : CLI::AppFormatMode::All)};
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what(), "command line", seeHelp);
  }
  return parser.chosen();
}

}  // namespace importon
