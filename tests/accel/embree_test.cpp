// kernels/traversal/trace.comp against Embree in robust mode: on the project's own scenes, and on others where a folder
// of them is named.
#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "accel/exact_oracle.h"
#include "accel/ray_tracer.h"
#include "base/log.h"
#include "scene/gltf_loader.h"
#include "support/gpu_test.h"

namespace importon::test {
namespace {

constexpr std::size_t kRays = 100000;  // of each kind
constexpr std::size_t kMaxDisagreements = kRays / 10;
constexpr std::size_t kMaxJudged = 200;  // since a judgement is slow

/// Embree's answers. Faces are hit from both sides.
class Embree {
 public:
  explicit Embree(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                              mesh.positions.size());
    std::memcpy(positions, mesh.positions.data(), mesh.positions.size() * sizeof(vec3));
    auto* indices = static_cast<uint*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(uint), mesh.triangles.size()));
    for (const Triangle& t : mesh.triangles)
      for (const uint vertex : {t.v0, t.v1, t.v2}) *indices++ = vertex;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~Embree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  /// The nearest t, infinity: none.
  [[nodiscard]] float closest(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = {ray.origin.x,
                 ray.origin.y,
                 ray.origin.z,
                 0,
                 ray.direction.x,
                 ray.direction.y,
                 ray.direction.z,
                 0,
                 ray.tMax,
                 ~0u,
                 0,
                 0};
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : query.ray.tfar;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

class EmbreeTest : public GpuTest, public ::testing::WithParamInterface<std::filesystem::path> {
 protected:
  /// Rays on which the two don't agree within rounding of the coordinates are judged in double precision: ours
  /// is right if no surely hit point lies nearer, and if there may be a hit where it found one.
  static void compare(const Mesh& mesh, const Embree& embree, const std::vector<Ray>& rays,
                      const std::vector<Hit>& hits, const char* kind) {
    float largest = 0;
    for (const vec3& p : mesh.positions) largest = std::max(largest, glm::length(p));
    std::size_t disagreements = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double ours = hits[i].triangle == kNone ? std::numeric_limits<double>::infinity() : hits[i].t;
      const double theirs = embree.closest(rays[i]);
      if (ours == theirs || std::abs(ours - theirs) <= 1e-5 * theirs + 1e-6 * largest) continue;
      if (++disagreements > kMaxJudged) continue;
      const NearestHit nearest = nearestHit(mesh, rays[i], 16 * 0x1p-24);
      if (ours >= nearest.possible && ours <= nearest.certain) continue;
      if (++wrong <= 5)
        ADD_FAILURE() << kind << " ray " << i << ": " << ours << ", Embree " << theirs << ", nearest possible "
                      << nearest.possible << ", certain " << nearest.certain;
    }
    EXPECT_LE(disagreements, kMaxDisagreements) << kind;
    EXPECT_EQ(wrong, 0u) << kind;
  }
};

Mesh loadMesh(const std::filesystem::path& file) {
  Log log(Log::Verbosity::quiet);
  const Scene scene = loadGltf(file, log);
  return {scene.positions, scene.triangles};
}

/// The scenes NAME/NAME`extension` of a folder, none if it is not there.
std::vector<std::filesystem::path> scenesIn(const std::filesystem::path& folder, const char* extension) {
  std::vector<std::filesystem::path> scenes;
  if (!std::filesystem::is_directory(folder)) return scenes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path scene = entry.path() / (entry.path().filename().string() + extension);
    if (std::filesystem::exists(scene)) scenes.push_back(scene);
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::string nameOf(const ::testing::TestParamInfo<std::filesystem::path>& scene) {
  std::string name = scene.param.stem();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace

TEST_P(EmbreeTest, AgreesOnSurfaceAxisParallelAndGrazingRays) {
  const Mesh mesh = loadMesh(GetParam());
  const Embree embree(mesh);
  RayTracer tracer(context(), buildBvh(mesh.positions, mesh.triangles));
  for (const auto& [kind, rays] :
       {std::pair("surface", surfaceRays(mesh, kRays, 41)), std::pair("axis-parallel", axisRays(mesh, kRays, 42)),
        std::pair("grazing", grazingRays(mesh, kRays, 43))})
    compare(mesh, embree, rays, tracer.closestHits(rays), kind);
  EXPECT_EQ(tracer.unfinished(), 0u);
}

INSTANTIATE_TEST_SUITE_P(OwnScenes, EmbreeTest, ::testing::ValuesIn(scenesIn(IMPORTON_SCENES, ".gltf")), nameOf);
INSTANTIATE_TEST_SUITE_P(OtherScenes, EmbreeTest, ::testing::ValuesIn(scenesIn(IMPORTON_OTHER_SCENES, ".glb")), nameOf);

TEST(EmbreeOracle, IsThereForAllOwnScenes) { EXPECT_EQ(scenesIn(IMPORTON_SCENES, ".gltf").size(), 9u); }

}  // namespace importon::test
