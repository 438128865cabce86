/// From a parsed command line to an exit status.
#pragma once
#include <chrono>

#include "app/command_line.h"
#include "base/error.h"

namespace importon {

/// Runs the command; `start` is when the process started. Results go to stdout: OutputError when that fails.
/// Throws Error.
[[nodiscard]] ExitStatus runCommand(const Command& command, std::chrono::steady_clock::time_point start);

}  // namespace importon
