// The path tracer against stored references of the project's scenes.
#include <filesystem>

#include "render/render_helper.h"
#include "scene/gltf_loader.h"

namespace importon::test {
namespace {

class References : public RenderTest {};

/// Student's test of the differences from the reference in 4 x 4 parts of the image and three channels, and that the
/// means of the channels are those of the reference.
TEST_F(References, OfCornellBoxIsWhatThePathTracerConvergesTo) {
  const std::filesystem::path folder = std::filesystem::path(IMPORTON_SCENES_FOLDER) / "cornell_box";
  const Image reference = readExr(folder / "reference.exr");
  Log log(Log::Verbosity::quiet);
  RenderJob job = makeJob(Integrator::path, 1, 7);
  job.gather = 32;
  job.maxDepth = 32;
  job.width = reference.width;
  job.height = reference.height;
  const Image image = renderScene(job, loadGltf(folder / "cornell_box.gltf", log)).image;
  constexpr int kParts = 4;
  for (const char* channel : {"R", "G", "B"}) {
    for (int j = 0; j < kParts; ++j) {
      for (int i = 0; i < kParts; ++i) {
        const Region region{i * image.width / kParts, j * image.height / kParts, (i + 1) * image.width / kParts,
                            (j + 1) * image.height / kParts};
        const std::vector<float> now = valuesOf(image, region, channel), stored = valuesOf(reference, region, channel);
        Moments differences;
        for (std::size_t k = 0; k < now.size(); ++k) differences.add(static_cast<double>(now[k] - stored[k]));
        EXPECT_TRUE(hasMean(differences, 0, 3 * kParts * kParts)) << channel << ' ' << i << ' ' << j;
      }
    }
    Moments ratios;  // of both to the mean stored, less the latter
    const std::vector<float> now = valuesOf(image, channel), stored = valuesOf(reference, channel);
    for (std::size_t k = 0; k < now.size(); ++k)
      ratios.add(1 + static_cast<double>(now[k] - stored[k]) / meanOf(reference, channel));
    EXPECT_TRUE(isWithin(0.01, ratios, 1)) << channel;
  }
}

}  // namespace
}  // namespace importon::test
