#include <cstdio>

#include "app/commands.h"
#include "app/environment_file.h"
#include "app/scene_summary.h"
#include "render/features/feature_set.h"
#include "scene/gltf_loader.h"

namespace importon {

ExitStatus runInfo(const InfoCommand& command) {
  Log log;
  const Scene scene =
      loadGltf(command.job.scene, log, readEnvironmentFile(command.job.environment), outsideFiles(command.job));
  const std::vector<FeatureRow> features = describeFeatures(scene, command.job);
  std::fputs((command.isJson ? summaryJson(scene, features) : summaryText(scene, features)).c_str(), stdout);
  return ExitStatus::ok;
}

}  // namespace importon
