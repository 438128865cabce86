#include <cstdio>

#include "app/commands.h"
#include "app/load_scene.h"
#include "app/scene_summary.h"
#include "render/features/feature_set.h"
#include "scene/gltf_loader.h"

namespace importon {

ExitStatus runInfo(const InfoCommand& command) {
  Log log;
  LoadOptions options = loadOptions(command.job);
  options.listsAnimations = true;
  const Scene scene = loadGltf(command.job.scene, log, options);
  const std::vector<FeatureRow> features = describeFeatures(scene, command.job);
  std::fputs((command.isJson ? summaryJson(scene, features) : summaryText(scene, features)).c_str(), stdout);
  return ExitStatus::ok;
}

}  // namespace importon
