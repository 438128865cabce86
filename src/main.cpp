/// importon: parse, run, exit code.
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/run.h"
#include "base/error.h"

namespace {

/// Prints the one line of an error and gives its exit status.
int report(const importon::Failure& failure) {
  std::fprintf(stderr, "importon: error: %s\n", failure.message.c_str());
  return static_cast<int>(failure.status);
}

}  // namespace

int main(int count, char** words) {
  const auto start = std::chrono::steady_clock::now();
  try {
    const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
    return static_cast<int>(importon::runCommand(importon::parseCommandLine(arguments), start));
  } catch (const std::exception& exception) {
    return report(importon::failureOf(exception));
  }
}
