#include "bench/embree_scene.h"

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>

namespace importon::bench {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

RTCGeometry makeGeometry(RTCDevice device, const BenchScene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3),
                                            scene.positions.size());
  std::memcpy(positions, scene.positions.data(), scene.positions.size() * sizeof(vec3));
  auto* indices = static_cast<uint*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                             3 * sizeof(uint), scene.triangles.size()));
  for (const Triangle& t : scene.triangles)
    for (const uint vertex : {t.v0, t.v1, t.v2}) *indices++ = vertex;
  rtcCommitGeometry(geometry);
  return geometry;
}

RTCRay makeRay(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          0.0f,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0.0f,
          ray.tMax,
          ~0u,
          0,
          0};
}

}  // namespace

EmbreeScene::EmbreeScene(const BenchScene& scene, int threads)
    : threads_(threads),
      device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
      scene_(rtcNewScene(device_)) {
  RTCGeometry geometry = makeGeometry(device_, scene);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  const auto start = std::chrono::steady_clock::now();
  const double processorStart = processorSeconds();
  rtcCommitScene(scene_);
  buildProcessorSeconds_ = processorSeconds() - processorStart;
  buildSeconds_ = secondsSince(start);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

void EmbreeScene::traceRange(std::span<const Ray> rays, bool isAnyHit) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (const Ray& ray : rays) {
    if (isAnyHit) {
      RTCRay query = makeRay(ray);
      rtcOccluded1(scene_, &context, &query);
      benchmark::DoNotOptimize(query.tfar);
    } else {
      RTCRayHit query{};
      query.ray = makeRay(ray);
      query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &query);
      benchmark::DoNotOptimize(query.hit.primID);
    }
  }
}

double EmbreeScene::trace(std::span<const Ray> rays, bool isAnyHit) const {
  constexpr std::size_t kChunk = 4096;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t begin = next.fetch_add(kChunk); begin < rays.size(); begin = next.fetch_add(kChunk))
      traceRange(rays.subspan(begin, std::min(kChunk, rays.size() - begin)), isAnyHit);
  };
  const auto start = std::chrono::steady_clock::now();
  {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads_; ++i) others.emplace_back(work);
    work();
  }
  return secondsSince(start);
}

}  // namespace importon::bench
