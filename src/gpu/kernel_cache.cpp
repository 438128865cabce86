#include "gpu/kernel_cache.h"

#include <algorithm>

#include "gpu/spirv_words.h"

namespace importon::gpu {

std::vector<std::uint32_t> declaredConstants(std::span<const std::uint32_t> spirv) {
  std::vector<std::uint32_t> ids;
  forEachInstruction(spirv, [&ids](SpirvInstruction i) {
    if (operationOf(i) == SpvOpDecorate && i.size() == 4 && i[2] == SpvDecorationSpecId) ids.push_back(i[3]);
  });
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

std::map<std::string, double> KernelCache::compileTimes() const {
  const std::scoped_lock lock(mutex_);
  std::map<std::string, double> times;
  for (const auto& [key, kernel] : kernels_) times[key.label] += kernel.compileMilliseconds();
  return times;
}

void KernelCache::clear() {
  const std::scoped_lock lock(mutex_);
  kernels_.clear();
}

}  // namespace importon::gpu
