// Surface cells of placed meshes: they cover every instance once, with the area that they say, as densely as asked.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "render/surface_cache/cell_tree.h"
#include "render/surface_cache/surface_cells.h"
#include "support/placed_scene.h"
#include "support/scene_builder.h"

namespace importon {
namespace {

Scene balls(const std::vector<glm::dmat4>& places, int subdivisions = 4) {
  test::SceneBuilder world, object;
  world.square(world.material(test::diffuse(vec3(0.5f))), {0, -1.5, 0}, {0, 1, 0}, 20);
  world.pointLight({0, 9, 0}, vec3(1));
  object.icosphere(object.material(test::diffuse(vec3(0.5f))), {0, 0, 0}, 1, subdivisions, test::Facing::outside,
                   test::Shading::flat);
  return test::withInstances(world.finish(), object.finish(), places, test::Held::once);
}

/// Cells of a placed triangle, as shaders/bindings/irradiance.glsl finds them.
uvec2 cellsOf(const SurfaceCells& cells, uint page, uint inPage) {
  const uvec2 entry = cells.placed[page], own = cells.placed[entry.y + inPage];
  return {entry.x + own.x, own.y};
}

/// The area that triangles really have in each cell.
std::vector<double> covered(const Scene& scene, const SurfaceCells& cells) {
  std::vector<double> areas(cells.areas.size());
  const auto add = [&](const uvec2& of, double area) {
    for (uint k = 0; k < of.y * of.y; ++k) areas[of.x + k] += area / (of.y * of.y);
  };
  const auto areaOf = [&](const Triangle& t, const Placement& place) {
    const glm::dvec3 a = place(scene.positions[t.v0]);
    return 0.5 * glm::length(glm::cross(place(scene.positions[t.v1]) - a, place(scene.positions[t.v2]) - a));
  };
  for (std::size_t i = 0; i < scene.worldTriangleCount(); ++i)
    add(cells.triangles[i], areaOf(scene.triangles[i], Placement{}));
  for (const PlacedInstance& instance : scene.placed.instances) {
    const PlacedMesh& mesh = scene.placed.meshes[instance.mesh];
    for (uint i = 0; i < mesh.triangleCount; ++i)
      add(cellsOf(cells, instance.firstPage + i / kPageTriangles, i % kPageTriangles),
          areaOf(scene.triangles[mesh.firstTriangle + i], instance.placement()));
  }
  return areas;
}

void expectCovered(const Scene& scene, const SurfaceCells& cells, double tolerance) {
  const std::vector<double> areas = covered(scene, cells);
  for (std::size_t i = 0; i < areas.size(); ++i)
    ASSERT_NEAR(areas[i] / static_cast<double>(cells.areas[i]), 1, tolerance) << i;
}

TEST(PlacedCells, CoverEveryInstanceOnce) {
  const Scene scene = balls(test::scattered(7, 3, false));
  for (const double density : {0.01, 0.3, 3.0, 40.0, 3e3})
    expectCovered(scene,
                  cutSurfaces(
                      scene, [&](vec3) { return density; }, 1u << 22, 0),
                  1e-4);
}

TEST(PlacedCells, OfStretchedInstancesHaveNearlyTheAreaThatTheySay) {
  const Scene scene = balls(test::scattered(7, 3, true));
  expectCovered(scene,
                cutSurfaces(
                    scene, [](vec3) { return 3e3; }, 1u << 22, 0),
                0.01);
  expectCovered(scene,
                cutSurfaces(
                    scene, [](vec3) { return 40.0; }, 1u << 22, 0),
                0.05);
}

TEST(PlacedCells, AreAsDenseAsAskedWhateverTheScale) {
  std::vector<glm::dmat4> places;
  for (const double size : {0.1, 1.0, 4.0})
    places.push_back(glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(10 * size, 0, 0)), glm::dvec3(size)));
  const Scene scene = balls(places, 5);
  for (const double density : {100.0, 1e4}) {
    const SurfaceCells cells = cutSurfaces(
        scene, [&](vec3) { return density; }, 1u << 22, 0);
    double floor = 0;
    for (const uvec2& triangle : cells.triangles) floor += triangle.y * triangle.y;
    double area = 0;
    for (const double size : {0.1, 1.0, 4.0}) area += 4 * M_PI * size * size;
    const double perCell = (static_cast<double>(cells.areas.size()) - floor) / (area * density);
    EXPECT_GT(perCell, 0.5);
    EXPECT_LT(perCell, 5);  // where a triangle asks for a little more than one cell, it has four
  }
}

TEST(PlacedCells, AreFinerWhereMoreIsAsked) {
  const Scene scene = balls(test::scattered(4, 6, false), 5);
  const SurfaceCells cells = cutSurfaces(
      scene, [](vec3 p) { return p.x < 0 ? 1e4 : 10.0; }, 1u << 22, 0);
  for (const PlacedInstance& instance : scene.placed.instances) {
    const auto [first, n] = std::pair(cellsOf(cells, instance.firstPage, 0).x, cellsOf(cells, instance.firstPage, 0).y);
    const double area = static_cast<double>(cells.areas[first]);
    if (instance.placement().translation.x < 0)
      EXPECT_LT(area, 3e-4) << n;
    else
      EXPECT_GT(area, 0.02) << n;
  }
}

TEST(PlacedCells, AreNoMoreThanThereIsRoomForHoweverManyInstances) {
  const Scene scene = balls(test::scattered(3000, 2.5, false), 1);
  const SurfaceCells cells = cutSurfaces(
      scene, [](vec3) { return 1e3; }, 1000, 0);
  EXPECT_LE(cells.areas.size(), 1000u);
  EXPECT_GT(cells.areas.size(), 50u);
  expectCovered(scene, cells, 1e-4);
}

TEST(PlacedCells, OfDividedTrianglesAreGrouped) {
  const Scene scene = balls(test::scattered(2, 3, false), 2);
  const SurfaceCells cells = cutSurfaces(
      scene, [](vec3) { return 1e4; }, 1u << 22, 0);
  const CellTree tree = growCellTree(cells);
  const PlacedInstance& instance = scene.placed.instances.back();
  const uvec2 own = cellsOf(cells, instance.firstPage, 5);
  ASSERT_GT(own.y, 1u);
  for (uint k = 0; k < own.y * own.y; ++k) EXPECT_NE(tree.cells[own.x + k].x, kNone);
}

}  // namespace
}  // namespace importon
