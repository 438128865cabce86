// Keller and Wald's door slit in small: at a step of importance no power is handed over to the other side, by any rule
// that stores photons. Two lamps light one side each, one red and one blue, so that every photon shows whose power it
// has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "method/map_rig.h"
#include "support/gpu_test.h"
#include "support/scene_builder.h"

namespace importon {
namespace {

using test::SceneBuilder;

/// Required density of the two sides, photons/m².
struct Densities {
  float left, right;
};
constexpr Densities kSteep{6, 6e4f};    // quota radii of 25 cm, as far as the grid reaches, and of 6.5 mm
constexpr Densities kGentle{200, 800};  // 11 cm and 5.6 cm: photons of the one are among those that the other looks at
constexpr Densities kEven{6, 6};        // no step
constexpr double kFloor = 0.49;         // half its side, m
constexpr float kStep = 0.01f;          // x of the step: where importons' cells end, at all sizes
constexpr double kGap = 0.03;           // from the step to the lit discs, m: out of reach for the right side's radii
constexpr double kDisc = 0.09;          // radius of a lit disc, m

/// A floor lit red left of the step and blue right of it. Columns: into which the floor is cut.
Scene floorWithStep(int columns) {
  SceneBuilder builder;
  const uint grey = builder.material(test::diffuse(vec3(0.5f)));
  const int left = std::max(columns * 50 / 98, 1);
  builder.quad(grey, {-kFloor, 0, kFloor}, {kFloor + kStep, 0, 0}, {0, 0, -2 * kFloor}, left, columns);
  const int right = std::max(columns - left, 1);
  builder.quad(grey, {kStep, 0, kFloor}, {kFloor - kStep, 0, 0}, {0, 0, -2 * kFloor}, right, columns);
  // What asks for a caustic map, so that importons of the camera's first hits are kept; nothing sees it.
  builder.square(builder.material(test::mirror()), {0, -0.1, 0}, {0, -1, 0}, 0.01);
  for (const bool isRight : {false, true}) {
    const double x = kStep + (isRight ? 1 : -1) * (kGap + kDisc), angle = std::atan(kDisc / 0.5);
    builder.spotLight({x, 0.5, 0}, {0, -1, 0}, isRight ? vec3(0, 0, 1) : vec3(1, 0, 0), 0.9 * angle, angle);
  }
  builder.camera({0, 1, 0}, {0, 0, 0}, 0.9, 32, 32, {0, 0, -1});
  return builder.finish();
}

RenderJob stepJob(GatherSource source) {
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 16;  // for both maps
  job.importons = 1u << 13;
  job.maxDepth = 3;  // nothing faces the floor, so all light is the lamps' own
  job.gatherFrom = source;
  return job;
}

/// What became of the power of both lamps on a side of the step.
struct Side {
  double own = 0, other = 0;  // W
  int records = 0;
};
using Sides = std::array<Side, 2>;

void add(Sides& sides, bool isRight, double red, double blue) {
  Side& side = sides[isRight];
  side.own += isRight ? blue : red;
  side.other += isRight ? red : blue;
  ++side.records;
}

/// What a rule stores of the two lamps' photons, which come in four batches.
Sides storedBy(const StorageRule& rule, test::MapRig& rig, const Densities& required) {
  rig.setImportance([&](const vec3& p) { return p.x < kStep ? required.left : required.right; });
  const PhotonMap map = rig.shoot(MapKind::global, rule);
  const PhotonMapCounts counts = rig.counts(map);
  EXPECT_TRUE(counts.isEnergyExact);
  EXPECT_GT(counts.redistributed, counts.hits / 2) << "little was handed over";
  const std::vector<MapPoint> photons = rig.photons(map);
  const std::vector<vec3> flux = rig.flux(map);
  Sides sides;
  for (std::size_t i = 0; i < photons.size(); ++i)
    add(sides, photons[i].position.x > kStep, static_cast<double>(flux[i].x), static_cast<double>(flux[i].z));
  return sides;
}

class ImportanceStep : public test::GpuTest {
 protected:
  Sides shootIntoCells(int columns, const Densities& required) {
    const Scene scene = floorWithStep(columns);
    test::MapRig rig(context(), scene, stepJob(GatherSource::cells));
    const auto density = [&](const vec3& p) { return p.x < kStep ? required.left : required.right; };
    const SurfaceCells cells = cutSurfaces(scene, density, 1u << 20, 1);
    const test::CellFlux flux = rig.shootIntoCells(cells);
    EXPECT_TRUE(flux.isEnergyExact);
    // A cell's side of the step: that of its triangles, of which none crosses it.
    std::vector<char> isRight(cells.areas.size());
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
      const Triangle& t = scene.triangles[i];
      const float x = (scene.positions[t.v0].x + scene.positions[t.v1].x + scene.positions[t.v2].x) / 3;
      const uint first = cells.triangles[i].x, parts = cells.triangles[i].y;
      for (uint k = 0; k < parts * parts; ++k) isRight[first + k] = x > kStep;
    }
    Sides sides;
    for (std::size_t side = 0; side < flux.sides.size(); ++side) {
      const auto& f = flux.sides[side];
      if (f[0] + f[1] + f[2] == 0) continue;
      add(sides, isRight[side / 2] != 0, static_cast<double>(f[0]), static_cast<double>(f[2]));
    }
    return sides;
  }
};

/// All red power stays left and all blue power right. What a map holds of each colour is that of its hits, to the last
/// bit, so with none on the other side each side holds exactly what fell there.
void expectNoneAcross(const Sides& sides) {
  for (const Side& side : sides) {
    EXPECT_GT(side.own, 0);
    EXPECT_EQ(side.other, 0);
  }
}

const StorageRule kByCells{};
const StorageRule kToOne{DensityControl::density, 1};
const StorageRule kToTwenty{DensityControl::density, 20};
const StorageRule kByDistance{DensityControl::density, 20, nullptr, 0, kAcceptCosine, kShareByDistance, 0};

/// Without the step power does cross, so there is something to see.
void expectSomeAcross(const Sides& sides) { EXPECT_GT(sides[0].other + sides[1].other, 0); }

TEST_F(ImportanceStep, NoRuleHandsPowerToPhotonsAcross) {
  const Scene scene = floorWithStep(1);
  RenderJob job = stepJob(GatherSource::photons);
  job.photonBatch = job.photons.value() / 8;
  test::MapRig rig(context(), scene, job);
  rig.parameters.globalMap.photonsPerPixel = 1;
  rig.parameters.globalMap.densityFloor = 0;
  rig.findImportance();
  rig.seeGlobalMapDirectly();
  for (const StorageRule& rule : {kByCells, kToOne, kToTwenty, kByDistance}) {
    SCOPED_TRACE(rule.receivers);
    const Sides steep = storedBy(rule, rig, kSteep);
    expectNoneAcross(steep);
    EXPECT_GT(steep[1].records, 100 * steep[0].records) << "the step shows in what is stored";
    expectNoneAcross(storedBy(rule, rig, kGentle));
    expectSomeAcross(storedBy(rule, rig, kEven));
  }
}

TEST_F(ImportanceStep, SurfaceCellsTakeNothingFromAcross) {
  expectNoneAcross(shootIntoCells(1, kSteep));
  expectNoneAcross(shootIntoCells(98, kSteep));  // small triangles, which share cells
  expectSomeAcross(shootIntoCells(98, kEven));
}

/// A floor with a step down and a wall, both near a green beam; even red light falls on all three.
constexpr double kLedge = 0.02, kFromWall = 0.006, kFromLedge = 0.005, kBeam = 0.001;

Scene corner() {
  SceneBuilder builder;
  const uint grey = builder.material(test::diffuse(vec3(0.5f)));
  builder.quad(grey, {-0.49, 0, kFromLedge}, {0.49 + kFromWall, 0, 0}, {0, 0, -0.49}, 1, 1);
  builder.quad(grey, {-0.49, -kLedge, 0.49}, {0.49 + kFromWall, 0, 0}, {0, 0, kFromLedge - 0.49}, 1, 1);
  builder.quad(grey, {kFromWall, -kLedge, -0.49}, {0, 0, 0.98}, {0, 0.3, 0}, 1, 1);
  builder.directionalLight(glm::normalize(glm::dvec3(1, -1, -0.3)), vec3(1, 0, 0));
  builder.spotLight({0, 0.5, 0}, {0, -1, 0}, vec3(0, 10000, 0), 0.9 * kBeam / 0.5, kBeam / 0.5);
  builder.camera({-0.2, 1, 0}, {-0.2, 0, 0}, 0.9, 32, 32, {0, 0, -1});
  return builder.finish();
}

struct GreenPhotons {
  double reach = 0;  // the farthest from the beam, m
  int photons = 0;
  int onWall = 0, onLedge = 0;
  bool areOthersNear = false;  // photons of the wall and of the ledge within reach
};

GreenPhotons greenOf(test::MapRig& rig, const StorageRule& rule, double radius) {
  const PhotonMap map = rig.shoot(MapKind::global, rule);
  EXPECT_TRUE(rig.counts(map).isEnergyExact);
  const std::vector<MapPoint> photons = rig.photons(map);
  const std::vector<vec3> flux = rig.flux(map);
  GreenPhotons green;
  bool isWallNear = false, isLedgeNear = false;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const glm::dvec3 p(photons[i].position);
    const bool isOnWall = p.x > kFromWall - 1e-5, isOnLedge = !isOnWall && p.y < -1e-5;
    const bool isNear = glm::length(p) < radius;
    isWallNear = isWallNear || (isOnWall && isNear);
    isLedgeNear = isLedgeNear || (isOnLedge && isNear);
    if (flux[i].y == 0) continue;
    ++green.photons;
    green.reach = std::max(green.reach, glm::length(p));
    green.onWall += isOnWall;
    green.onLedge += isOnLedge;
  }
  green.areOthersNear = isWallNear && isLedgeNear;
  return green;
}

RenderJob cornerJob(double density) {
  RenderJob job = stepJob(GatherSource::photons);
  job.constantDensity = density;
  job.maxDepth = 0;  // light of the lamps alone
  return job;
}

TEST_F(ImportanceStep, NearestReceiversAreOfTheHitsOwnSurfaceWithinItsQuotaRadius) {
  const Scene scene = corner();
  test::MapRig rig(context(), scene, cornerJob(1000));
  const double radius = std::sqrt(8 / (M_PI * 1000));  // Q photons, 5 cm
  for (const StorageRule& rule : {kToOne, kToTwenty, kByDistance}) {
    const GreenPhotons green = greenOf(rig, rule, radius);
    EXPECT_GE(green.photons, 1);
    EXPECT_LT(green.reach, radius + kBeam);
    EXPECT_EQ(green.onWall + green.onLedge, 0);
    EXPECT_TRUE(green.areOthersNear);
  }
}

/// A cell tells surfaces by their normals alone: the ledge's photon in the same cube may stand for the floor.
TEST_F(ImportanceStep, ThePhotonOfACellIsOfTheHitsOwnCellAndSideOfIt) {
  const Scene scene = corner();
  constexpr double kDensity = 1000;
  test::MapRig rig(context(), scene, cornerJob(kDensity));
  const double edge = 1 / std::sqrt(kDensity);  // at most
  const GreenPhotons green = greenOf(rig, kByCells, std::sqrt(3.0) * edge);
  EXPECT_GE(green.photons, 1);
  EXPECT_LE(green.photons, 4) << "a beam on a corner of cells";
  EXPECT_LT(green.reach, std::sqrt(3.0) * (edge + kBeam));
  EXPECT_EQ(green.onWall, 0);
  EXPECT_TRUE(green.areOthersNear);
}

}  // namespace
}  // namespace importon
