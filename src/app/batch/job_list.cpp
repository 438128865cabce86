#include "app/batch/job_list.h"

#include <fstream>
#include <iostream>
#include <sstream>

#include "base/error.h"
#include "fmt/format.h"

namespace importon {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20, kMostJobs = 10'000;

std::string readBounded(std::istream& stream, const std::string& name) {
  std::string text(kMostBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw UsageError("the list cannot be read to its end", name, "check the disk");
  if (text.size() > kMostBytes) throw UsageError("the list is larger than 4 MiB", name, "cut it into several");
  return text;
}

std::string readText(const std::filesystem::path& file) {
  if (file == "-") return readBounded(std::cin, "standard input");
  std::error_code ignored;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, ignored))
    throw UsageError("the list cannot be read", file.string(), "give a text file with a scene in each line");
  return readBounded(stream, file.string());
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool isControl(char c) { return (c >= 0 && c < ' ' && !isBlank(c)) || c == '\x7f'; }

}  // namespace

std::vector<std::string> splitListLine(const std::string& line, const std::string& where) {
  std::vector<std::string> words;
  bool isInWord = false;
  char quote = 0;
  for (const char c : line) {
    if (isControl(c)) throw UsageError("the line has control characters", where, "give a text file");
    if (quote == 0 && !isInWord && c == '#') break;
    if (quote == 0 && isBlank(c)) {
      isInWord = false;
      continue;
    }
    if (!isInWord) words.emplace_back();
    isInWord = true;
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = 0;
    else
      words.back() += c;
  }
  if (quote != 0) throw UsageError("a quote has no end", where, fmt::format("end it with {}", quote));
  return words;
}

std::vector<ListLine> readJobList(const std::filesystem::path& file) {
  std::istringstream text(readText(file));
  const std::string name = file == "-" ? "standard input" : file.string();
  std::vector<ListLine> lines;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (++number == 1 && line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    std::vector<std::string> words = splitListLine(line, fmt::format("{}:{}", name, number));
    if (words.empty()) continue;
    if (lines.size() == kMostJobs) throw UsageError("the list has more than 10,000 jobs", name, "cut it into several");
    lines.push_back({number, std::move(words)});
  }
  if (lines.empty()) throw UsageError("the list names no scene", name, "give a scene in each line");
  return lines;
}

}  // namespace importon
