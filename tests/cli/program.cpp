#include "cli/program.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace importon::test {
namespace {

/// What to read and what to write of a pipe or a terminal.
struct Ends {
  int read = -1, write = -1;
};

Ends makePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2");
  return {ends[0], ends[1]};
}

Ends makeTerminal() {
  Ends ends;
  if (openpty(&ends.read, &ends.write, nullptr, nullptr, nullptr) != 0) throw std::runtime_error("openpty");
  return ends;
}

[[noreturn]] void becomeImporton(const std::vector<std::string>& arguments, const RunOptions& options, int out,
                                 int err) {
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  if (!options.outFile.empty()) out = open(options.outFile.c_str(), O_WRONLY | O_CLOEXEC);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  std::vector<std::string> words{IMPORTON_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers[0], pointers.data());
  constexpr int kCannotRun = 127;
  _exit(kCannotRun);
}

/// Appends what can be read now; false at the end. A terminal whose other end is closed gives an error instead.
bool readSome(int descriptor, std::string& text) {
  std::array<char, 4096> buffer{};
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  if (count <= 0) return false;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

void collect(pid_t child, int out, int err, const RunOptions& options, Outcome& outcome) {
  bool isOutOpen = true, isErrOpen = true;
  while (isOutOpen || isErrOpen) {
    std::array<pollfd, 2> sources{pollfd{isOutOpen ? out : -1, POLLIN, 0}, pollfd{isErrOpen ? err : -1, POLLIN, 0}};
    poll(sources.data(), sources.size(), options.onTick ? 1 : -1);
    if (options.onTick) {
      if (const int number = options.onTick(); number != 0) kill(child, number);
    }
    if (sources[0].revents != 0) isOutOpen = readSome(out, outcome.out);
    if (sources[1].revents == 0) continue;
    isErrOpen = readSome(err, outcome.err);
    if (isErrOpen && options.onErr) {
      if (const int number = options.onErr(outcome.err); number != 0) kill(child, number);
    }
  }
}

}  // namespace

Outcome runImporton(const std::vector<std::string>& arguments, const RunOptions& options) {
  const Ends out = makePipe(), err = options.hasTerminal ? makeTerminal() : makePipe();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) becomeImporton(arguments, options, out.write, err.write);
  close(out.write);
  close(err.write);
  Outcome outcome;
  std::thread sender;
  if (options.delayedSignal.number != 0) {
    sender = std::thread([&] {
      std::this_thread::sleep_for(options.delayedSignal.delay);
      kill(child, options.delayedSignal.number);
    });
  }
  collect(child, out.read, err.read, options, outcome);
  close(out.read);
  close(err.read);
  if (sender.joinable()) sender.join();  // before the child's number is free again
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  return outcome;
}

}  // namespace importon::test
