#include "render/job_fingerprint.h"

#include <fmt/format.h>

#include "base/hash.h"
#include "render/camera_setup.h"
#include "render/gather_source.h"

namespace importon {
namespace {

template <class T>
void addArray(ContentHash& hash, const std::vector<T>& values) {
  hash.add(std::as_bytes(std::span(values)));
}

template <class T>
std::string shown(const std::optional<T>& value) {
  return value ? fmt::format("{}", *value) : "automatic";
}

std::string settingsOf(const RenderJob& job) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(job.filter),
                     static_cast<int>(job.integrator), shown(job.photons), shown(job.importons),
                     static_cast<int>(job.control), static_cast<int>(gatherSource(job)), job.probabilityFloor, static_cast<int>(job.importance),
                     static_cast<int>(job.differentialBound), static_cast<int>(job.emission), shown(job.photonBatch),
                     job.causticDensity,
                     job.globalDensity, shown(job.constantDensity), shown(job.redistribute), shown(job.gather),
                     job.filtersIndirect, job.maxDepth, shown(job.memoryMiB)) +
         fmt::format(" {} {} {} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(job.irradiance), static_cast<int>(job.acceptance), static_cast<int>(job.shares),
                     shown(job.quota), job.hasProgramLimits, static_cast<int>(job.lookup.value_or(MapLookup::radius)), shown(job.lookupPhotons),
                     shown(job.nearestImportons), static_cast<int>(job.guideWeight),
                     static_cast<int>(job.shooting), static_cast<int>(job.scatter), static_cast<int>(job.requiredBy), job.choosesLookups,
                     job.isAdaptive);
}

}  // namespace

std::uint64_t imageFingerprint(const RenderJob& job, const Scene& scene) {
  ContentHash hash;
  addArray(hash, scene.positions);
  addArray(hash, scene.vertices);
  addArray(hash, scene.triangles);
  addArray(hash, scene.materials);
  addArray(hash, scene.textures);
  addArray(hash, scene.texels);
  addArray(hash, scene.lights);
  const Camera& camera = chooseCamera(scene, job);
  const glm::ivec2 size = chooseSize(camera, job);
  hash.add(std::as_bytes(std::span(&camera.worldFromCamera, 1)));
  hash.add(fmt::format("{} {} {} {} {} {} {}", size.x, size.y, camera.isOrthographic, camera.yfov, camera.aspectRatio,
                       camera.xmag, camera.ymag));
  const EnvironmentMap environment = scene.environment.value_or(EnvironmentMap{});
  hash.add(fmt::format("{} {}", environment.width, environment.height));
  addArray(hash, environment.texels);
  hash.add(settingsOf(job));
  return hash.value();
}

}  // namespace importon
