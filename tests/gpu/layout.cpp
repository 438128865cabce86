#include "gpu/layout.h"

#include <algorithm>

namespace importon::test {

std::string difference(const gpu::ReflectedStruct& device, std::span<const HostLayout> host) {
  const auto found =
      std::find_if(host.begin(), host.end(), [&](const HostLayout& layout) { return layout.name == device.name; });
  if (found == host.end()) return device.name + ": not listed in tests/gpu/layouts.cpp";
  const auto counts = [&](const char* what, std::size_t onDevice, std::size_t onHost) {
    return device.name + ": " + what + " " + std::to_string(onDevice) + " in the kernel, " + std::to_string(onHost) +
           " on the host";
  };
  if (device.members.size() != found->members.size()) {
    return counts("number of members", device.members.size(), found->members.size());
  }
  for (std::size_t i = 0; i < device.members.size(); ++i) {
    const gpu::ReflectedMember& ours = device.members[i];
    const HostMember& theirs = found->members[i];
    if (ours.name != theirs.name) return device.name + ": member " + ours.name + " is " + theirs.name + " on the host";
    if (ours.offset != theirs.offset) return counts(("offset of " + ours.name).c_str(), ours.offset, theirs.offset);
    if (ours.bytes != theirs.bytes) return counts(("size of " + ours.name).c_str(), ours.bytes, theirs.bytes);
  }
  if (device.bytes != found->bytes) return counts("size", device.bytes, found->bytes);
  if (device.arrayStride != 0 && device.arrayStride != found->bytes) {
    return counts("array stride", device.arrayStride, found->bytes);
  }
  return "";
}

}  // namespace importon::test
