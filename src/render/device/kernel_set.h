/// The kernels of a render, specialised by what scene and job need.
#pragma once
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "gpu/kernel_cache.h"
#include "render/features/feature_set.h"

namespace importon {

/// Each kernel is taken from the cache, which makes it when it is first asked for. From any thread.
class KernelSet {
 public:
  /// Specialised by `constants`. With `hasAlpha` rays pass the holes of materials.
  KernelSet(std::shared_ptr<gpu::KernelCache> cache, std::vector<gpu::Specialization> constants, bool hasAlpha)
      : cache_(std::move(cache)), constants_(std::move(constants)), hasAlpha_(hasAlpha) {}
  /// With a cache of its own.
  KernelSet(gpu::Context& context, std::vector<gpu::Specialization> constants, bool hasAlpha)
      : KernelSet(std::make_shared<gpu::KernelCache>(context), std::move(constants), hasAlpha) {}

  /// The kernel that `Call` calls: of <kernels/...>, or of kernel_variants.h. Throws DeviceError.
  template <class Call>
  [[nodiscard]] const gpu::Kernel& get() {
    if constexpr (requires { Call::kOwn; })
      return find(Call::kLabel, Call::kCode, Call::kOwn);
    else
      return find(Call::kLabel, Call::kCode, std::nullopt);
  }
  /// Of all kernels of the cache: gpu/kernel_cache.h.
  [[nodiscard]] std::map<std::string, double> compileTimes() const { return cache_->compileTimes(); }
  [[nodiscard]] bool hasAlpha() const { return hasAlpha_; }
  /// Shadow rays pass smooth thin surfaces. Where constants_ say nothing, there are none.
  [[nodiscard]] bool hasPanes() const;

 private:
  /// The code, and the constant of its own with its value: none has id kNone.
  using Key = std::tuple<const gpu::KernelCode*, std::uint32_t, std::uint32_t>;
  const gpu::Kernel& find(std::string_view label, const gpu::KernelCode& code, std::optional<gpu::Specialization> own);

  std::shared_ptr<gpu::KernelCache> cache_;
  std::vector<gpu::Specialization> constants_;
  bool hasAlpha_;
  std::mutex mutex_;  // of the next
  std::map<Key, const gpu::Kernel*> found_;
};

/// The constants of all kernels of a render; two renders with the same can share kernels.
[[nodiscard]] std::vector<gpu::Specialization> constantsOf(const FeatureSet& features, const RenderJob& job,
                                                           bool isCpu);

/// Compiles those that the job surely calls for, in the order of use, on as many threads as the job has. Meant to run
/// beside what uses them, which waits for no more than its own. A kernel that is not among them is compiled when it is
/// first used. Throws DeviceError.
void compileAhead(KernelSet& set, const FeatureSet& features, const RenderJob& job);

}  // namespace importon
