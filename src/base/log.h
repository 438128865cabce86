/// Messages on stderr: notes, warnings counted by kind, and one progress line. No colours, so NO_COLOR holds.
#pragma once
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace importon {

struct Warning {
  std::string kind;
  std::size_t count = 0;
  std::string message;  // the first of its kind
};

/// Passed by reference to whatever may speak; thread-safe. The first warning of a kind is printed, the rest are
/// counted, and the destructor tells how many there were.
class Log {
 public:
  /// quiet: warnings only; normal: notes and progress too; verbose: details too.
  enum class Verbosity { quiet, normal, verbose };
  /// `subject`, where it is not empty, stands before each message: "SUBJECT: ".
  explicit Log(Verbosity verbosity = Verbosity::normal, const std::string& subject = "");
  ~Log();
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  void warn(std::string_view kind, std::string_view message);
  void note(std::string_view message);    // normal and verbose
  void detail(std::string_view message);  // verbose only
  void error(std::string_view message);   // always, without the subject; no exception is thrown
  /// Keeps all messages back until release(): what is done ahead speaks when its turn comes.
  void hold();
  void release();
  /// Messages that are in `told` are not printed, now or later; others go in. It must last.
  void release(std::set<std::string>& told);
  /// Rewrites the progress line; shows nothing unless stderr is a terminal.
  void progress(std::string_view line);
  void endProgress();
  [[nodiscard]] std::vector<Warning> warnings() const;  // sorted by kind

 private:
  void print(std::string_view prefix, std::string_view message);
  bool isNew(const std::string& line);
  mutable std::mutex mutex_;
  Verbosity verbosity_;
  std::string subject_;  // with ": " behind it
  bool isHeld_ = false;
  std::vector<std::string> held_;          // lines
  std::set<std::string>* told_ = nullptr;  // null: all is printed
  bool isTerminal_ = false;
  bool hasProgressLine_ = false;
  std::string progressLine_;
  std::map<std::string, Warning, std::less<>> warnings_;
};

}  // namespace importon
