/// Ctrl-C and SIGTERM: the first asks for an orderly end, the second ends the process.
#pragma once
#include <atomic>

namespace importon {

/// Installs the handlers and returns the flag that the first signal sets. Poll it between pieces of work.
[[nodiscard]] const std::atomic<bool>& watchForInterrupt();

}  // namespace importon
