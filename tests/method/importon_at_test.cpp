// lib/importance.glsl: which importon speaks for a point. In the hash table of these tests every cell shares
// the one slot.
#include <gtest/gtest.h>

#include "shared/scene_data.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon::importon_at_test {
namespace {

/// As in tests/kernels/importon_at.comp: a query, and an importon of the map.
struct Item {
  vec3 position, normal;
  vec3 importon, importonNormal;
  uint importonLevel;
};
struct Answer {
  uint nearest, first;
};

const vec3 kUp(0, 1, 0), kAside(1, 0, 0), kDown(0, -1, 0);

class ImportonAt : public test::GpuTest {
 protected:
  /// Three importons at levels whose cells are 1/8 and 1/32 wide, beside one another.
  std::vector<Answer> ask(const std::vector<std::pair<vec3, vec3>>& queries) {
    std::vector<Item> items{{{}, {}, vec3(0.30f, 0.30f, 0.30f), kUp, 3},
                            {{}, {}, vec3(0.31f, 0.30f, 0.30f), kUp, 3},
                            {{}, {}, vec3(0.32f, 0.30f, 0.30f), kAside, 5}};
    for (std::size_t i = 0; i < items.size(); ++i) {
      items[i].position = queries[i].first;
      items[i].normal = queries[i].second;
    }
    return test::runKernel<Answer>(context(), test_kernels::code("importon_at"), items);
  }
};

TEST_F(ImportonAt, IsTheNearestOfTheFinestCellWithALikeNormal) {
  const auto answers =
      ask({{vec3(0.312f, 0.30f, 0.30f), kUp}, {vec3(0.29f, 0.30f, 0.30f), kUp}, {vec3(0.30f, 0.30f, 0.30f), kAside}});
  EXPECT_EQ(answers[0].nearest, 1u);
  EXPECT_EQ(answers[0].first, 0u) << "the one that speaks for the whole cell";
  EXPECT_EQ(answers[1].nearest, 0u);
  EXPECT_EQ(answers[2].nearest, 2u);
}

TEST_F(ImportonAt, IsNoneOfAnotherWallOrOfACellFarAway) {
  const auto answers = ask({{vec3(0.30f, 0.30f, 0.30f), kDown},
                            {vec3(0.30f, 0.30f, 0.30f), vec3(0, 0, 1)},
                            {vec3(0.7f, 0.30f, 0.30f), kUp}});
  for (const Answer& answer : answers) {
    EXPECT_EQ(answer.nearest, kNone);
    EXPECT_EQ(answer.first, kNone);
  }
}

// The importon of level 5 is 0.08 away: beyond its cell's edge, though not beyond that of level 3.
TEST_F(ImportonAt, ReachesAsFarAsTheEdgeOfItsOwnLevel) {
  const auto answers =
      ask({{vec3(0.40f, 0.30f, 0.30f), kAside}, {vec3(0.34f, 0.30f, 0.30f), kAside}, {vec3(0.40f, 0.30f, 0.30f), kUp}});
  EXPECT_EQ(answers[0].nearest, kNone);
  EXPECT_EQ(answers[1].nearest, 2u);
  EXPECT_EQ(answers[2].nearest, 1u);
}

}  // namespace
}  // namespace importon::importon_at_test
