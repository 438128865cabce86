// Nothing gets out of a closed surface: watertight edges, and origins that stay on their side.
#include <gtest/gtest.h>

#include <algorithm>

#include "accel/bvh.h"
#include "accel/meshes.h"
#include "accel_test_kernels/registry.h"
#include "support/gpu_test.h"

namespace importon::test {
namespace {

constexpr std::uint32_t kWalkers = 20000;
constexpr std::uint32_t kBounces = 50;

struct BouncePush {
  std::uint32_t count, most;
  vec3 start;
};

class BounceTest : public GpuTest {
 protected:
  /// Walkers that don't stay inside, having started at `start`.
  std::size_t escapes(const Mesh& mesh, vec3 start, std::uint32_t walkers = kWalkers) const {
    std::vector<vec3> corners;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int corner = 0; corner < 3; ++corner) corners.push_back(mesh.vertex(t, corner));
    const Bvh bvh = buildBvh(mesh.positions, mesh.triangles);
    const gpu::Kernel kernel(context(), "bounce", accel_test_kernels::code("bounce"));
    const gpu::Buffer triangles = gpu::makeBuffer<vec3>(context(), "triangles", corners);
    const gpu::Buffer bounces(context(), "bounces", walkers * sizeof(std::uint32_t));
    const gpu::Buffer nodes = gpu::makeBuffer<BvhRecord>(context(), "BVH", bvh.nodes, gpu::TexelFormat::uint4);
    const gpu::Buffer* const bindings[] = {&triangles, &bounces, &nodes};
    gpu::Recorder recorder(context());
    recorder.dispatch(kernel, bindings, walkers, BouncePush{walkers, kBounces, start});
    recorder.submitAndWait();
    const std::vector<std::uint32_t> counts = bounces.download<std::uint32_t>(walkers);
    return static_cast<std::size_t>(std::count_if(counts.begin(), counts.end(), [](auto n) { return n < kBounces; }));
  }

  static Mesh moved(Mesh mesh, vec3 by) {
    for (vec3& p : mesh.positions) p += by;
    return mesh;
  }
  /// A closed square tube of 4·perSide needles along it, and as many around each end's centre; vertices shared.
  static Mesh needleTube(uint perSide, float length) {
    Mesh mesh;
    const uint sides = 4 * perSide;
    mesh.positions = {vec3(0), vec3(0, 0, length)};
    for (uint i = 0; i < sides; ++i) {
      const float along = 2 * static_cast<float>(i % perSide) / static_cast<float>(perSide) - 1;
      const vec3 corner = i < perSide       ? vec3(along, -1, 0)
                          : i < 2 * perSide ? vec3(1, along, 0)
                          : i < 3 * perSide ? vec3(-along, 1, 0)
                                            : vec3(-1, -along, 0);
      mesh.positions.push_back(corner);
      mesh.positions.push_back(corner + vec3(0, 0, length));
    }
    for (uint i = 0; i < sides; ++i) {
      const uint a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
      for (const Triangle& t :
           {Triangle{a, b, a + 1, 0}, Triangle{b, b + 1, a + 1, 0}, Triangle{0, b, a, 0}, Triangle{1, a + 1, b + 1, 0}})
        mesh.triangles.push_back(t);
    }
    return mesh;
  }

  static Mesh turned(Mesh mesh) {
    const glm::mat3 rotation(glm::normalize(vec3(2, 1, -1)), glm::normalize(vec3(-1, 2, 0)),
                             glm::cross(glm::normalize(vec3(2, 1, -1)), glm::normalize(vec3(-1, 2, 0))));
    for (vec3& p : mesh.positions) p = rotation * p;
    return mesh;
  }
};

}  // namespace

TEST_F(BounceTest, NoWalkerLeavesABox) {
  const Mesh box = closedBox(vec3(-1, -2, -3), vec3(3, 2, 1));
  EXPECT_EQ(escapes(box, vec3(0)), 0u);
  EXPECT_EQ(escapes(turned(box), vec3(0)), 0u);
  EXPECT_EQ(escapes(closedBox(vec3(-1, -1e-3f, -100), vec3(1, 1e-3f, 100)), vec3(0)), 0u);
}

TEST_F(BounceTest, NoWalkerLeavesASphere) {
  EXPECT_EQ(escapes(closedSphere(vec3(0), 1.0f, 24), vec3(0)), 0u);
  EXPECT_EQ(escapes(closedSphere(vec3(0), 1e-6f, 24), vec3(0)), 0u);
  EXPECT_EQ(escapes(closedSphere(vec3(0), 1e8f, 24), vec3(0)), 0u);
}

TEST_F(BounceTest, NoWalkerLeavesWhatLiesFarFromTheOrigin) {
  const vec3 far(1e5f, -2e5f, 5e4f);
  EXPECT_EQ(escapes(moved(closedBox(vec3(-1), vec3(1)), far), far), 0u);
  EXPECT_EQ(escapes(moved(closedSphere(vec3(0), 1.0f, 12), far), far), 0u);
}

TEST_F(BounceTest, NoWalkerLeavesATubeOfNeedles) {
  const vec3 far(10, -20, 5);
  EXPECT_EQ(escapes(moved(needleTube(1000, 8.0f), far), far + vec3(0.1f, 0.2f, 4), 1000), 0u);
  const Mesh tube = turned(needleTube(100, 8.0f));
  EXPECT_EQ(escapes(tube, 0.5f * (tube.positions[0] + tube.positions[1]), 8000), 0u);
}

}  // namespace importon::test
