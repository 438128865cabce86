// The talk's claim in small, for a lit room: a seventh of the photons makes an image of the same mean. Where no filter
// hides the map's own error, the image's is 1.17 times that of all photons (1.13 to 1.22, 99 %): not the 1.15 times
// that is claimed. With surface cells it is less. Errors are against the path tracer.
#include <gtest/gtest.h>

#include <cmath>

#include "method/paired_render.h"
#include "method/two_rooms.h"
#include "support/claims.h"
#include "support/gpu_test.h"

namespace importon::talk_claims_slow_test {
namespace {

constexpr double kMostError = 1.25;  // with control, over that of all photons
constexpr double kMostErrorOfCells = 1.05;

RenderJob pathJob() {
  RenderJob job = test::twoRoomsJob();
  job.integrator = Integrator::path;
  job.passes = 4;
  job.gather = 64;
  job.seed = 1000;
  return job;
}

class TalkClaims : public test::GpuTest {};

TEST_F(TalkClaims, ASeventhOfThePhotonsKeepsTheMeanOfALitRoomAndCostsAQuarterOfTheErrorAtMost) {
  const Scene scene = test::twoRooms(false);
  const test::ReferenceHalves paths = test::renderHalves(scene, pathJob());
  RenderJob cells = test::twoRoomsJob();
  cells.gatherFrom = GatherSource::cells;
  const auto found = test::judgeAgainstClassicalMap(scene, {test::twoRoomsJob(), cells}, 8, MapKind::global, &paths);
  for (const test::PairedFigures& f : found) {
    std::printf("%s\n", test::describe(f).c_str());
    EXPECT_TRUE(test::isAbove(7, f.timesFewer));
    EXPECT_TRUE(test::isWithin(0.01, f.meanRatio, 1));
  }
  EXPECT_TRUE(test::isBelow(std::log(kMostError), found[0].errorRatio));
  EXPECT_TRUE(test::isBelow(std::log(kMostErrorOfCells), found[1].errorRatio));
  EXPECT_TRUE(test::isBelow(0.5, found[1].bytesRatio));
}

}  // namespace
}  // namespace importon::talk_claims_slow_test
