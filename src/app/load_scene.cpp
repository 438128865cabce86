#include "app/load_scene.h"

#include "app/environment_file.h"
#include "scene/gltf_loader.h"

namespace importon {
namespace {

void tellOfStudio(const RenderJob& job, const Scene& scene, Log& log) {
  if (!scene.isInStudio || job.light == LightChoice::studio) return;
  const bool hasEmitters = !scene.lightOfTriangle.empty();
  log.note(hasEmitters
               ? "nothing but what glows on it lights the scene: a studio lights it too (--light scene: as it is)"
               : "the scene has no light: it is lit by a studio (--environment F lights it otherwise)");
}

}  // namespace

LoadOptions loadOptions(const RenderJob& job) {
  LoadOptions options;
  options.light = job.light;
  options.environment = readEnvironmentFile(job.environment);
  options.environmentRotation = job.environmentRotation;
  if (job.width && job.height) options.frameAspect = static_cast<double>(*job.width) / *job.height;
  options.file = {job.isStrict ? Strictness::strict : Strictness::forgiving, job.sceneName, job.variant, job.at,
                  job.animation};
  options.outside = job.allowsOutsideFiles ? OutsideFiles::allowed : OutsideFiles::refused;
  return options;
}

Scene loadScene(const RenderJob& job, Log& log) {
  Scene scene = loadGltf(job.scene, log, loadOptions(job));
  tellOfStudio(job, scene, log);
  if (!scene.hasCameraInFile) log.note("the scene has no camera: it is seen from one that frames it");
  return scene;
}

}  // namespace importon
