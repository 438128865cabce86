#include "app/run.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "app/commands.h"
#include "app/interrupt.h"

namespace importon {
namespace {

/// One call operator for each command.
struct Runner {
  std::chrono::steady_clock::time_point start;
  ExitStatus operator()(const RenderCommand& command) const { return runRender(command, watchForInterrupt(), start); }
  ExitStatus operator()(const BatchCommand& command) const { return runBatch(command, watchForInterrupt(), start); }
  ExitStatus operator()(const InfoCommand& command) const { return runInfo(command); }
  ExitStatus operator()(const CompareCommand& command) const { return runCompare(command); }
  ExitStatus operator()(const ConvergeCommand& command) const { return runConverge(command, watchForInterrupt()); }
  ExitStatus operator()(const StudyCommand& command) const { return runStudy(command, watchForInterrupt()); }
  ExitStatus operator()(const MergeCommand& command) const { return runMerge(command); }
  ExitStatus operator()(const DevicesCommand&) const { return runDevices(); }
  ExitStatus operator()(const TextCommand& command) const {
    std::fputs(command.text.c_str(), stdout);
    return ExitStatus::ok;
  }
};

}  // namespace

ExitStatus runCommand(const Command& command, std::chrono::steady_clock::time_point start) {
  const ExitStatus status = std::visit(Runner{start}, command);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw OutputError(std::string("cannot write: ") + std::generic_category().message(errno), "standard output",
                      "free some space, or send it elsewhere");
  }
  return status;
}

}  // namespace importon
