#include "render/resume/job_fingerprint.h"

#include <fmt/format.h>

#include "base/hash.h"
#include "render/options/option_table.h"
#include "render/plan/camera_setup.h"

namespace importon {
namespace {

template <class T>
void addArray(ContentHash& hash, const std::vector<T>& values) {
  hash.add(std::as_bytes(std::span(values)));
}

std::string settingsOf(const RenderJob& job) {
  std::string settings;
  for (const OptionRow& row : optionTable())
    if (row.changesImage) settings += row.name() + " " + row.value(job) + "\n";
  return settings;
}

}  // namespace

std::uint64_t imageFingerprint(const RenderJob& job, const Scene& scene) {
  ContentHash hash;
  addArray(hash, scene.positions);
  addArray(hash, scene.vertices);
  addArray(hash, scene.triangles);
  addArray(hash, scene.placed.instances);
  addArray(hash, scene.materials);
  addArray(hash, scene.textures);
  addArray(hash, scene.texels);
  addArray(hash, scene.lights);
  const Camera& camera = chooseCamera(scene, job);
  const glm::ivec2 size = chooseSize(camera, job);
  hash.add(std::as_bytes(std::span(&camera.worldFromCamera, 1)));
  hash.add(fmt::format("{} {} {} {} {} {} {}", size.x, size.y, camera.isOrthographic, camera.yfov, camera.aspectRatio,
                       camera.xmag, camera.ymag));
  const Lens lens = chooseLens(camera, job);
  hash.add(fmt::format("{} {}", lens.radius, lens.focusDistance));
  const EnvironmentMap environment = scene.environment.value_or(EnvironmentMap{});
  hash.add(fmt::format("{} {}", environment.width, environment.height));
  addArray(hash, environment.texels);
  hash.add(settingsOf(job));
  return hash.value();
}

}  // namespace importon
