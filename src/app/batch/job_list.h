/// The file of --list.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace importon {

/// A line that names a job: its number in the file, from 1, and its words.
struct ListLine {
  int number = 0;
  std::vector<std::string> words;
};

/// The lines with words. "-" stands for the standard input. Throws UsageError on a file that cannot be read, is larger
/// than 4 MiB or has more than 10,000 jobs or none, and on a line that cannot be cut into words.
[[nodiscard]] std::vector<ListLine> readJobList(const std::filesystem::path& file);

/// Cuts `line` at blanks; within '...' and "..." they belong to the word. A word that begins with # ends the line.
/// Throws UsageError, at `where`, on a quote that has no end, and on control characters.
[[nodiscard]] std::vector<std::string> splitListLine(const std::string& line, const std::string& where);

}  // namespace importon
