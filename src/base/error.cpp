#include "base/error.h"

#include <algorithm>
#include <new>

namespace importon {
namespace {

/// "WHAT (WHERE): WHAT TO DO" on one line: control characters (a file name may hold a newline) become spaces.
std::string oneLine(const std::string& what, const std::string& where, const std::string& remedy) {
  std::string line = what;
  if (!where.empty()) line += " (" + where + ")";
  if (!remedy.empty()) line += ": " + remedy;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, ' ');
  return line;
}

}  // namespace

Error::Error(ExitStatus status, const std::string& what, const std::string& where, const std::string& remedy)
    : std::runtime_error(oneLine(what, where, remedy)), status_(status), problem_(what) {}

Failure failureOf(const std::exception& exception) {
  if (const auto* const error = dynamic_cast<const Error*>(&exception)) return {error->status(), error->what()};
  if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr)
    return {ExitStatus::device, "out of memory: choose a smaller image or scene"};
  return {ExitStatus::device, std::string("this is a bug (") + exception.what() + "): please report it"};
}

}  // namespace importon
