/// What a scene needs to have modelled, and why.
#pragma once
#include <string>
#include <vector>

#include "render/render_job.h"
#include "scene/scene.h"

namespace importon {

struct FeatureRow {
  std::string name;
  bool isModelled = false;
  std::string why;
};

/// Every feature of the renderer, modelled or left out, in a fixed order.
[[nodiscard]] std::vector<FeatureRow> describeFeatures(const Scene& scene, const RenderJob& job);

}  // namespace importon
