#include "base/parallel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>

namespace importon {

void parallelFor(std::size_t count, std::size_t grain, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body) {
  assert(grain > 0);
  const std::size_t chunks = count / grain + (count % grain != 0 ? 1 : 0);
  const auto runChunk = [&](std::size_t chunk) {
    const std::size_t begin = chunk * grain;
    body(begin, begin + std::min(grain, count - begin));
  };
  if (threads == 1 || chunks <= 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) runChunk(chunk);
    return;
  }
  tbb::task_arena arena(threadCount(threads));
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, chunks, runChunk); });
}

int threadCount(int threads) {
  const int available = tbb::this_task_arena::max_concurrency();
  return threads > 0 ? std::min(threads, available) : available;
}

}  // namespace importon
