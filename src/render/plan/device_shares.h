/// What each device does of a render on several.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace importon {

/// The seed of the device at `position` of the list, from that of the job, which the first has. Jobs with seeds that
/// lie near each other have none in common.
[[nodiscard]] std::uint32_t seedOfDevice(std::uint32_t seed, std::size_t position);

/// How many passes each device is to have made in the end, of `total` in all, where they have made `done`. Evenly: who
/// has made fewer makes the more of what is left, and the first ones one more where it does not come out.
/// With `isRace` what is left is shared evenly instead, whatever they have made: a fast device stays ahead.
[[nodiscard]] std::vector<int> sharePasses(int total, std::span<const int> done, bool isRace);

}  // namespace importon
