/// The options of `importon render` on the command line.
#pragma once
#include "CLI/CLI.hpp"
#include "app/command_line.h"

namespace importon {

/// Where relative names of a list's line begin.
struct ListFolders {
  std::filesystem::path inputs, outputs;
};

/// Declares the options on `app`; parsing writes to `command`, which must outlive `app`.
void addRenderOptions(CLI::App& app, RenderCommand& command);

/// Declares what loading a scene depends on.
void addSceneOptions(CLI::App& app, RenderJob& job);

/// Declares how a PNG looks.
void addLookOptions(CLI::App& app, RenderJob& job);

/// Options of a line of a list, over those of `command` that all jobs have. Throws UsageError.
void parseListLine(std::vector<std::string> words, RenderCommand& command, const ListFolders& folders);

/// After parsing: applies --talk, and checks what no single option can: outputs that name the same file or the scene,
/// options that contradict each other. Throws UsageError.
void finishRenderCommand(const CLI::App& app, RenderCommand& command);

/// Throws UsageError where the name of the picture or its preview tells of no kind that there is.
void checkPictureKinds(const RenderJob& job);

/// Leaves in the help what one needs every day.
void hideRareOptions(CLI::App& app);

}  // namespace importon
