/// From where and which way photons leave the environment, learned from importance that leaves the scene: a sky is
/// wide, and the windows that it lights a room through are small.
#pragma once
#include "render/guiding/escape_tree.h"
#include "render/importance/importance.h"
#include "render/importance/site_hits.h"

namespace importon {

class EnvironmentGuide {
 public:
  /// Of the escapes of `paths` paths that importance takes from the places where the image reads the map.
  EnvironmentGuide(gpu::Context& context, std::uint32_t paths);

  /// Where the paths of a batch, `first` .. `first + count` of all, leave the scene, from the workspace's queues as
  /// they are traced event by event. `isCaustic`: only those count that were mirrored or refracted before.
  void note(const Stage& stage, uint counter, const gpu::Buffer& queue, std::uint32_t first, bool isCaustic) const;
  /// Of photons by it: too little escaped to tell, those by power are about as good, or they are far better.
  enum class Worth { unknown, little, much };
  /// Makes the guide, if it is worth much, of what the first `paths` left. The device is idle.
  [[nodiscard]] Worth update(std::uint32_t paths, double discArea);
  [[nodiscard]] const gpu::Buffer& texels() const { return texels_; }

 private:
  gpu::Context& context_;
  gpu::Buffer escapes_, texels_;
};

}  // namespace importon
