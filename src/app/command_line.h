/// The command line as data.
#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/log.h"
#include "render/render_job.h"

namespace importon {

struct RenderCommand {
  RenderJob job;
  std::vector<std::filesystem::path> scenes;  // as given; of one, the job's
  std::filesystem::path list;                 // of further jobs; empty: none
  std::vector<std::string> given;             // long names of the options of the table that were given
  bool isTalk = false;                        // --talk; its settings stand in the job
  std::vector<std::string> photonOptions;     // names of the given options that mean nothing to the path tracer
  Log::Verbosity verbosity = Log::Verbosity::normal;
};

/// A picture; or with --camera all one for each camera of the scene, whose name goes into those of the files; or of a
/// turntable one for each frame, whose number does.
struct BatchEntry {
  RenderCommand render;
  bool hasAllCameras = false;
  std::vector<std::int64_t> frames = {};
};

struct BatchCommand {
  std::vector<BatchEntry> entries;
  std::filesystem::path folder, pngFolder;  // are made; empty: none
  std::filesystem::path summary;            // empty: none
  std::vector<std::string> commandLine;
  Log::Verbosity verbosity = Log::Verbosity::normal;
  bool isSequence = false;  // its jobs are frames, which say once what they all say
};

struct InfoCommand {
  RenderJob job;  // only what the transport depends on is set
  bool isJson = false;
};

struct CompareCommand {
  std::filesystem::path image, reference;
  bool isJson = false;
  std::string layer, referenceLayer;    // empty: the colour that there is
  std::filesystem::path diff, diffPng;  // empty: none
  std::optional<double> maxRelmse, maxFlip, maxFlipHdr, maxBand;
  std::optional<double> floor;  // absolute, in the denominator of relMSE
};

/// A configuration of converge: a render with these options.
struct NamedJob {
  std::string name, options;
  RenderJob job;
};

struct ConvergeCommand {
  std::filesystem::path scene, reference, folder;
  std::vector<NamedJob> configs;
  std::vector<double> times;  // s, rising
  int seeds = 4;
  std::optional<double> referenceError;  // trimmed relMSE; else what the image itself says
  Log::Verbosity verbosity = Log::Verbosity::normal;
};

struct StudyCommand {
  std::filesystem::path scene, folder;
  std::vector<NamedJob> configs;  // the first is what the others are held against
  Log::Verbosity verbosity = Log::Verbosity::normal;
};

struct MergeCommand {
  std::vector<std::filesystem::path> images;  // two or more
  std::filesystem::path output, png;          // png may be empty: none
  RenderJob job;                              // only how the png looks is set
};

struct DevicesCommand {};

/// --help and --version: text for stdout.
struct TextCommand {
  std::string text;
};

using Command = std::variant<RenderCommand, BatchCommand, InfoCommand, CompareCommand, ConvergeCommand, StudyCommand,
                             MergeCommand, DevicesCommand, TextCommand>;

/// Reads the arguments after the program's name. `importon SCENE ...` is short for `importon render SCENE ...`.
/// Throws UsageError on anything unknown, out of range or contradictory.
[[nodiscard]] Command parseCommandLine(std::span<const std::string> arguments);

}  // namespace importon
