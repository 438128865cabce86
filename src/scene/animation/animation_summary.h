/// What `importon info` tells of an animation.
#pragma once
#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace importon {

struct AnimationSummary {
  std::string name;                             // empty: none
  std::optional<double> duration;               // s, up to the last key; none: it cannot be read
  std::map<std::string, std::size_t> channels;  // by what they move: "rotation", "pointer", as their path says
};

}  // namespace importon
