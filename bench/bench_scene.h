/// Scenes and rays to measure with.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "shared/ray_data.h"
#include "shared/scene_data.h"

namespace importon::bench {

struct BenchScene {
  std::vector<vec3> positions;
  std::vector<Triangle> triangles;
};

/// A variable of the environment; empty where it is not set.
[[nodiscard]] std::string setting(const char* name);
/// Processor time of all threads of this process, in seconds.
[[nodiscard]] double processorSeconds();
/// Of at least one value.
[[nodiscard]] double median(std::vector<double> values);

/// Names that loadBenchScene knows.
[[nodiscard]] std::span<const char* const> benchSceneNames();
/// One of the project's own scenes, else of the folder IMPORTON_BENCH_SCENES in the environment, else of the shared
/// folder, or "height_field", a made one of a million triangles. Throws SceneError where the file is missing.
[[nodiscard]] BenchScene loadBenchScene(const std::string& name);

/// Turned by 0.6 rad about a slanted axis, so that its walls lie along no axis.
[[nodiscard]] BenchScene turned(BenchScene scene);

/// Incoherent rays: from points spread evenly over the surfaces, in random directions about the normal of one
/// side, with the cosine as density.
[[nodiscard]] std::vector<Ray> makeBounceRays(const BenchScene& scene, std::size_t count);
/// Incoherent shadow rays: between two points spread evenly over the surfaces.
[[nodiscard]] std::vector<Ray> makeShadowRays(const BenchScene& scene, std::size_t count);

}  // namespace importon::bench
