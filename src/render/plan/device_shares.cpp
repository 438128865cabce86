#include "render/plan/device_shares.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace importon {
namespace {

constexpr std::uint32_t kSeedStep = 2654435769u;  // 2^32 over the golden ratio

/// `count` in equal parts; the first ones have one more.
int partOf(int count, int parts, int index) { return count / parts + (index < count % parts ? 1 : 0); }

/// Those who have made no more than an even share of what they are to make together.
std::vector<std::size_t> behind(int total, std::span<const int> done) {
  std::vector<std::size_t> devices(done.size());
  std::iota(devices.begin(), devices.end(), 0u);
  for (;;) {
    const int share = total / static_cast<int>(devices.size());
    const auto ahead = std::ranges::find_if(devices, [&](std::size_t i) { return done[i] > share; });
    if (ahead == devices.end()) return devices;
    total -= done[*ahead];
    devices.erase(ahead);
  }
}

}  // namespace

std::uint32_t seedOfDevice(std::uint32_t seed, std::size_t position) {
  return seed + static_cast<std::uint32_t>(position) * kSeedStep;
}

std::vector<int> sharePasses(int total, std::span<const int> done, bool isRace) {
  std::vector<int> shares(done.begin(), done.end());
  int left = total - std::accumulate(done.begin(), done.end(), 0);
  if (left <= 0) return shares;
  std::vector<std::size_t> takers(done.size());
  std::iota(takers.begin(), takers.end(), 0u);
  if (!isRace) {
    takers = behind(total, done);
    for (const std::size_t i : takers) left += std::exchange(shares[i], 0);
  }
  for (std::size_t k = 0; k < takers.size(); ++k)
    shares[takers[k]] += partOf(left, static_cast<int>(takers.size()), static_cast<int>(k));
  return shares;
}

}  // namespace importon
