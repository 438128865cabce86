/// Embree as a yardstick: its default build (medium quality) and single-ray queries.
#pragma once
#include <span>

#include "bench/bench_scene.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace importon::bench {

class EmbreeScene {
 public:
  /// Builds on `threads` threads.
  EmbreeScene(const BenchScene& scene, int threads);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  [[nodiscard]] double buildSeconds() const { return buildSeconds_; }
  /// Processor time of all threads.
  [[nodiscard]] double buildProcessorSeconds() const { return buildProcessorSeconds_; }
  /// Traces every ray with rtcIntersect1 or rtcOccluded1, on as many threads; returns the seconds that it took.
  [[nodiscard]] double trace(std::span<const Ray> rays, bool isAnyHit) const;

 private:
  void traceRange(std::span<const Ray> rays, bool isAnyHit) const;

  int threads_;
  RTCDeviceTy* device_;
  RTCSceneTy* scene_;
  double buildSeconds_ = 0;
  double buildProcessorSeconds_ = 0;
};

}  // namespace importon::bench
