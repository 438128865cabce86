/// Runs the importon binary and keeps what it says.
#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace importon::test {

/// The scene that tests of the command line render when any will do.
inline const std::string kCornellBox = std::string(IMPORTON_SCENES) + "/cornell_box/cornell_box.gltf";

struct Outcome {
  int status = -1;  // exit status; -1 if a signal ended it
  int signal = 0;   // that signal
  std::string out, err;
};

struct RunOptions {
  std::map<std::string, std::string> environment = {};  // added to that of the test
  std::string outFile = {};                             // stdout goes here instead of into Outcome::out
  bool hasTerminal = false;                             // stderr is a terminal
  /// Called with stderr so far, whenever it grows; returns a signal to send, 0: none.
  std::function<int(const std::string& err)> onErr = {};
  /// Called every millisecond or so; returns a signal to send, 0: none.
  std::function<int()> onTick = {};
  /// Sent so long after the start; 0: none.
  struct {
    int number = 0;
    std::chrono::milliseconds delay{};
  } delayedSignal = {};
};

/// Runs `importon ARGUMENTS` and waits.
[[nodiscard]] Outcome runImporton(const std::vector<std::string>& arguments, const RunOptions& options = {});

}  // namespace importon::test
