/// Folders that commands write several files to.
#pragma once
#include <filesystem>
#include <span>

namespace importon {

/// Makes the folder if it is missing and sees that `files` can be written there. Throws OutputError.
void makeFolder(const std::filesystem::path& folder, std::span<const char* const> files);

}  // namespace importon
