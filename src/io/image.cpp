#include "io/image.h"

#include <algorithm>

namespace importon {

const Channel* Image::find(const std::string& name) const {
  const auto found =
      std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) { return channel.name == name; });
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace importon
