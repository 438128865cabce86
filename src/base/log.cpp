#include "base/log.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "fmt/format.h"

namespace importon {
namespace {

// Returns to the start of the line and erases it.
constexpr std::string_view kEraseLine = "\r\033[K";

void writeToStderr(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

Log::Log(Verbosity verbosity, const std::string& subject)
    : verbosity_(verbosity), subject_(subject.empty() ? "" : subject + ": "), isTerminal_(isatty(STDERR_FILENO) == 1) {}

Log::~Log() {
  endProgress();
  for (const auto& [kind, warning] : warnings_) {
    if (warning.count > 1) {
      print("importon: warning: ", fmt::format("{} more like \"{}\"", warning.count - 1, warning.message));
    }
  }
}

void Log::warn(std::string_view kind, std::string_view message) {
  const std::lock_guard lock(mutex_);
  const auto found = warnings_.find(kind);
  if (found != warnings_.end()) {
    ++found->second.count;
    return;
  }
  warnings_.emplace(std::string(kind), Warning{std::string(kind), 1, std::string(message)});
  print("importon: warning: ", message);
}

void Log::note(std::string_view message) {
  const std::lock_guard lock(mutex_);
  if (verbosity_ != Verbosity::quiet) print("importon: ", message);
}

void Log::detail(std::string_view message) {
  const std::lock_guard lock(mutex_);
  if (verbosity_ == Verbosity::verbose) print("importon: ", message);
}

void Log::error(std::string_view message) {
  const std::lock_guard lock(mutex_);
  const std::string subject = std::exchange(subject_, "");
  print("importon: error: ", message);
  subject_ = subject;
}

void Log::hold() {
  const std::lock_guard lock(mutex_);
  isHeld_ = true;
}

void Log::release() {
  const std::lock_guard lock(mutex_);
  isHeld_ = false;
  for (const std::string& line : std::exchange(held_, {}))
    if (isNew(line)) writeToStderr(line);
}

void Log::release(std::set<std::string>& told) {
  {
    const std::lock_guard lock(mutex_);
    told_ = &told;
  }
  release();
}

bool Log::isNew(const std::string& line) { return told_ == nullptr || told_->insert(line).second; }

void Log::progress(std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (!isTerminal_ || verbosity_ == Verbosity::quiet) return;
  hasProgressLine_ = true;
  progressLine_ = line;
  writeToStderr(std::string(kEraseLine) + progressLine_);
}

void Log::endProgress() {
  const std::lock_guard lock(mutex_);
  if (hasProgressLine_) writeToStderr("\n");
  hasProgressLine_ = false;
}

std::vector<Warning> Log::warnings() const {
  const std::lock_guard lock(mutex_);
  std::vector<Warning> all;
  all.reserve(warnings_.size());
  for (const auto& [kind, warning] : warnings_) all.push_back(warning);
  return all;
}

/// One write per line, so that lines of several threads or processes don't mix; the progress line is drawn anew
/// below it. Callers hold the mutex.
void Log::print(std::string_view prefix, std::string_view message) {
  std::string line;
  line.append(prefix).append(subject_).append(message).append("\n");
  if (isHeld_)
    held_.push_back(line);
  else if (!isNew(line))
    return;
  else if (hasProgressLine_)
    writeToStderr(std::string(kEraseLine) + line + progressLine_);
  else
    writeToStderr(line);
}

}  // namespace importon
