/// Loops over several host threads.
#pragma once
#include <cstddef>
#include <functional>

namespace importon {

/// Calls body(begin, end) for the chunks [0, grain), [grain, 2 grain), ... of [0, count), on up to `threads`
/// threads (0: all), and returns when all are done. Chunks are the same whatever the number of threads, so a
/// body that writes per chunk gives the same result always. An exception of a body is rethrown here, once.
/// `grain` is at least 1.
void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// The number of threads this process may use, or `threads` when that is less and not 0.
[[nodiscard]] int threadCount(int threads);

}  // namespace importon
