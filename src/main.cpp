/// importon: parse, run, exit code.
#include <chrono>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/run.h"
#include "base/error.h"

namespace {

/// Prints the one line of an error and gives its exit status.
int report(const char* message, importon::ExitStatus status) {
  std::fprintf(stderr, "importon: error: %s\n", message);
  return static_cast<int>(status);
}

}  // namespace

int main(int count, char** words) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
    return static_cast<int>(importon::runCommand(importon::parseCommandLine(arguments), start));
  } catch (const importon::Error& error) {
    return report(error.what(), error.status());
  } catch (const std::bad_alloc&) {
    return report("out of memory: choose a smaller image or scene", importon::ExitStatus::device);
  } catch (const std::exception& error) {
    return report((std::string("this is a bug (") + error.what() + "): please report it").c_str(),
                  importon::ExitStatus::device);
  }
}
