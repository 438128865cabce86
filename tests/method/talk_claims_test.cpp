// The door slit as a render, with gathers that read photons: density control changes no mean behind the door.
#include <gtest/gtest.h>

#include "method/paired_render.h"
#include "method/two_rooms.h"
#include "support/claims.h"
#include "support/gpu_test.h"

namespace importon {
namespace {

class TalkClaims : public test::GpuTest {};

TEST_F(TalkClaims, NoLightIsHandedThroughTheDoor) {
  RenderJob job = test::twoRoomsJob();
  job.gather = 16;
  const auto found = test::judgeAgainstClassicalMap(test::twoRooms(true), {job}, 10, MapKind::global).front();
  EXPECT_TRUE(test::isAbove(5, found.timesFewer));
  EXPECT_TRUE(test::isWithin(0.03, found.meanRatio, 1)) << test::describe(found);
}

}  // namespace
}  // namespace importon
