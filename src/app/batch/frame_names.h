/// Names of the files of a sequence.
#pragma once
#include <cstdint>
#include <filesystem>

namespace importon {

/// The file's name has a place for a number.
[[nodiscard]] bool hasFrameNumber(const std::filesystem::path& pattern);

/// Throws UsageError, naming `option`, unless the file's name has exactly one place for a number, %d or %04d with any
/// width, and its folder has none. %% stands for %.
void checkFramePattern(const char* option, const std::filesystem::path& pattern);

/// The file of a frame; the pattern has passed the check.
[[nodiscard]] std::filesystem::path frameName(const std::filesystem::path& pattern, std::int64_t frame);

}  // namespace importon
