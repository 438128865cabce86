// Light that pixels share, in whole images.
#include <algorithm>
#include <cmath>

#include "render_helper.h"

namespace importon::test::sharing_test {
namespace {

class Sharing : public RenderTest {};

/// Standard deviation of an image's red over its mean.
double unevenness(const Image& image) {
  const std::vector<float>& values = image.channels.front().values;
  const double mean = meanOf(image);
  double squares = 0;
  for (const float value : values) squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
  return std::sqrt(squares / static_cast<double>(values.size())) / mean;
}

/// A plate of rough metal, of which the camera sees no edge, before a sky that is bright above.
Scene metalPlate() {
  SceneBuilder builder;
  builder.square(builder.material(metal(vec3(0.9f, 0.7f, 0.4f), 1.0f)), {0, 0, 0}, {0, 0.3, 1}, 20);
  builder.square(builder.material(emitter(vec3(5.0f))), {0, 6, 4}, {0, -1, -0.7}, 3);
  builder.camera({0, 0.5, 3}, {0, 0, 0}, 0.2, 32, 32);
  return builder.finish();
}

/// A sampled direction of each pixel may lead into the metal: it tells nothing of what the others find.
TEST_F(Sharing, RoughMetalIsEvenAfterAPass) {
  RenderJob job = makeJob(Integrator::photon, 1);
  job.gather = 1;
  const double unshared = unevenness(renderScene(job, metalPlate()).image);
  job.sharesLight = true;
  const double shared = unevenness(renderScene(job, metalPlate()).image);
  EXPECT_GT(unshared, 0.1);
  EXPECT_LT(shared, 0.4 * unshared);
}

}  // namespace
}  // namespace importon::test::sharing_test
