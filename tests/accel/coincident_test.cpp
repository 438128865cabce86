#include "accel/coincident.h"

#include <gtest/gtest.h>

#include <cmath>

namespace importon::test {

TEST(DistinctTriangles, KeepsTheFirstOfEqualOnesWhateverTheOrderOfTheirVertices) {
  const std::vector<vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-0.0f, 0, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2, 0}, {0, 1, 3, 0}, {2, 0, 1, 1}, {1, 0, 2, 2},
                                        {0, 4, 2, 3}, {5, 1, 2, 4}, {1, 2, 3, 0}};
  EXPECT_EQ(distinctTriangles(positions, triangles), (std::vector<std::uint32_t>{0, 1, 6}));
}

TEST(DistinctTriangles, TellsApartWhatDiffersInOneBit) {
  const float next = std::nextafter(1.0f, 2.0f);
  const std::vector<vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {next, 0, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2, 0}, {0, 3, 2, 0}};
  EXPECT_EQ(distinctTriangles(positions, triangles).size(), 2u);
}

}  // namespace importon::test
