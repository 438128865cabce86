#include "app/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace importon {
namespace {

// A signal handler reaches nothing but globals.
std::atomic<bool> hasSignal{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void onSignal(int) {
  hasSignal = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  constexpr std::string_view kMessage = "\nimporton: stopping after this pass; once more to stop at once\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
}

}  // namespace

const std::atomic<bool>& watchForInterrupt() {
  struct sigaction action {};
  action.sa_handler = onSignal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return hasSignal;
}

}  // namespace importon
