#include "gpu/kernel_cache.h"

#include <algorithm>

namespace importon::gpu {

std::vector<std::uint32_t> declaredConstants(std::span<const std::uint32_t> spirv) {
  // SPIR-V specification 1.5: 2.3 physical layout, 3.20 decorations, 3.32.3 annotations.
  constexpr std::size_t kHeaderWords = 5, kCountShift = 16;
  constexpr std::uint32_t kOpDecorate = 71, kSpecId = 1, kOpcodeMask = 0xFFFF;
  std::vector<std::uint32_t> ids;
  for (std::size_t at = kHeaderWords; at < spirv.size();) {
    const std::size_t count = spirv[at] >> kCountShift;
    if (count == 0 || count > spirv.size() - at) break;
    if ((spirv[at] & kOpcodeMask) == kOpDecorate && count == 4 && spirv[at + 2] == kSpecId)
      ids.push_back(spirv[at + 3]);
    at += count;
  }
  std::ranges::sort(ids);
  return ids;
}

KernelCache::Key KernelCache::keyOf(std::string_view label, const KernelCode& code,
                                    std::span<const Specialization> constants) {
  auto known = declared_.find(&code);
  if (known == declared_.end()) known = declared_.emplace(&code, declaredConstants(code.spirv())).first;
  Key key{&code, std::string(label), {}};
  constexpr int kIdShift = 32;
  for (const Specialization& constant : constants)
    if (std::ranges::binary_search(known->second, constant.id))
      key.constants.push_back(std::uint64_t{constant.id} << kIdShift | constant.value);
  std::ranges::sort(key.constants);
  return key;
}

const Kernel& KernelCache::find(std::string_view label, const KernelCode& code,
                                std::span<const Specialization> constants) {
  const std::scoped_lock lock(mutex_);
  const Key key = keyOf(label, code, constants);
  const auto found = kernels_.find(key);
  if (found != kernels_.end()) return found->second;
  return kernels_.try_emplace(key, context_, std::string(label), code, constants).first->second;
}

std::size_t KernelCache::size() const {
  const std::scoped_lock lock(mutex_);
  return kernels_.size();
}

void KernelCache::clear() {
  const std::scoped_lock lock(mutex_);
  kernels_.clear();
}

}  // namespace importon::gpu
