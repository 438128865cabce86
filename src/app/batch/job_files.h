/// The files that the jobs of a batch write.
#pragma once
#include <filesystem>
#include <span>
#include <string>

#include "app/command_line.h"
#include "scene/scene.h"

namespace importon {

/// Names the picture, if it has no name, `folder`/SCENE.exr, or `folder`/SCENE.CAMERA.exr if `camera` is not empty; and
/// the preview as the picture, in `pngFolder` if that is not empty.
void nameOutputs(RenderJob& job, const std::filesystem::path& folder, const std::filesystem::path& pngFolder,
                 const std::string& camera);

/// Puts `camera` into the names of all files that the job writes: NAME.CAMERA.EXTENSION.
void addCamera(RenderJob& job, const std::string& camera);

/// The name of a camera in a file's name: its own, if that is fit for it and no other camera has it, else its index.
[[nodiscard]] std::string cameraLabel(std::span<const Camera> cameras, std::size_t index);

/// `name` with an underscore for each byte that is a control character or a slash.
[[nodiscard]] std::string fileNameOf(const std::string& name);

/// Throws UsageError if two jobs would write the same file, or one what another reads.
void checkJobFiles(const BatchCommand& command);

}  // namespace importon
