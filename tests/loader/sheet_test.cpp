/// Surfaces with a volume: which bound a solid, and which are sheets.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "loader/load.h"

namespace importon::test::sheet_test {
namespace {

using Corners = std::vector<glm::vec3>;

/// Two triangles, counter-clockwise as the corners are.
Corners quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
  return {a, b, c, a, c, d};
}

Corners& operator+=(Corners& all, const Corners& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Corners moved(Corners corners, const std::function<glm::vec3(const glm::vec3&)>& move) {
  for (glm::vec3& corner : corners) corner = move(corner);
  return corners;
}

/// The faces of a unit cube; the last is its lid. No two share a vertex, as those of different normals do not.
std::vector<Corners> cube() {
  std::vector<Corners> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool isFar : {false, true}) {
      const auto at = [&](float u, float v) {
        glm::vec3 p(0.0f);
        p[axis] = isFar ? 1.0f : 0.0f;
        p[(axis + 1) % 3] = isFar ? u : v;
        p[(axis + 2) % 3] = isFar ? v : u;
        return p;
      };
      faces.push_back(quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1)));
    }
  }
  return faces;
}

Corners all(const std::vector<Corners>& faces) {
  Corners corners;
  for (const Corners& face : faces) corners += face;
  return corners;
}

Corners withoutLid() {
  std::vector<Corners> faces = cube();
  faces.pop_back();
  return all(faces);
}

Corners pane() { return quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}); }

/// Material 0 is opaque, material 1 is glass of thickness 0.5 that absorbs. Each primitive has a material.
struct Model {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Model() {
    builder.json["meshes"] = Json::array();
    builder.json["nodes"] = Json::array();
    builder.json["scenes"][0]["nodes"] = Json::array();
    builder.add(
        "materials",
        {{"name", "glass"},
         {"extensions",
          {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 0.5}, {"attenuationColor", {0.2, 0.8, 0.2}}, {"attenuationDistance", 0.1}}}}}});
  }
  Json& glass() { return builder.json["materials"][1]; }
  int mesh(const std::vector<std::pair<int, Corners>>& primitives) {
    Json list = Json::array();
    for (const auto& [material, corners] : primitives) {
      list.push_back({{"attributes", {{"POSITION", builder.addPositions(corners)}}}});
      if (material >= 0) list.back()["material"] = material;
    }
    return builder.add("meshes", {{"primitives", list}});
  }
  Model& show(const std::vector<std::pair<int, Corners>>& primitives) {
    builder.addRoot({{"mesh", mesh(primitives)}});
    return *this;
  }
  [[nodiscard]] Scene scene() const {
    LoadOptions options;
    options.light = LightChoice::studio;
    Log log(Log::Verbosity::quiet);
    return loadGltfFromMemory(asBytes(builder.glb()), "test.glb", {}, log, options);
  }
};

bool isSolid(const Material& material) { return (material.flags & kMaterialSolid) != 0; }

/// How many triangles with a volume there are of solids, and of sheets.
std::pair<int, int> solidsAndSheets(const Model& model) {
  const Scene scene = model.scene();
  std::pair<int, int> counts{0, 0};
  for (const Triangle& t : scene.triangles) {
    const Material& material = scene.materials[t.material];
    if (material.thickness > 0) ++(isSolid(material) ? counts.first : counts.second);
  }
  return counts;
}

using Counts = std::pair<int, int>;

TEST(Sheet, IsAPaneAndNotABox) {
  EXPECT_EQ(solidsAndSheets(Model().show({{1, pane()}})), Counts(0, 2));
  EXPECT_EQ(solidsAndSheets(Model().show({{1, all(cube())}})), Counts(12, 0));
}

TEST(Sheet, HasTheThicknessAndAbsorptionOfTheFile) {
  const Scene scene = Model().show({{1, pane()}}).scene();
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].thickness, 0.5f);
  EXPECT_NEAR(scene.materials[0].absorption.x, -std::log(0.2) / 0.1, 1e-5);
  EXPECT_EQ(scene.materialNames[0], "glass");
}

TEST(Sheet, IsWhateverHasABorder) {
  EXPECT_EQ(solidsAndSheets(Model().show({{1, withoutLid()}})), Counts(0, 10));
  // Bent, and tilted: the open box as a bowl.
  const Corners bowl = moved(
      withoutLid(), [](const glm::vec3& p) { return glm::normalize(p - 0.5f) + 0.3f * glm::vec3(p.y, p.z, p.x); });
  EXPECT_EQ(solidsAndSheets(Model().show({{1, bowl}})), Counts(0, 10));
}

/// In an indexed mesh as in one whose faces have vertices of their own, at places that rounding has moved.
TEST(Sheet, CornersAtOnePlaceAreOne) {
  Corners rough = all(cube());
  for (std::size_t i = 0; i < rough.size(); ++i) rough[i] *= 1.0f + 1e-7f * static_cast<float>(i % 3);
  EXPECT_EQ(solidsAndSheets(Model().show({{1, rough}})), Counts(12, 0));
  const Corners far = moved(all(cube()), [](const glm::vec3& p) { return p + glm::vec3(1e4f, -1e4f, 0); });
  EXPECT_EQ(solidsAndSheets(Model().show({{1, far}})), Counts(12, 0));
  const Corners small = moved(all(cube()), [](const glm::vec3& p) { return p * 1e-6f; });
  EXPECT_EQ(solidsAndSheets(Model().show({{1, small}})), Counts(12, 0));
  Corners ajar = withoutLid();
  ajar += moved(cube().back(), [](const glm::vec3& p) { return p + glm::vec3(0, 0, 1e-3f); });
  EXPECT_EQ(solidsAndSheets(Model().show({{1, ajar}})), Counts(0, 12));
}

/// A ball of 20 · 4^n triangles, each of the icosahedron's cut into 2^n · 2^n.
Corners ball(int sides) {
  const float g = 1.6180340f;
  const Corners at{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  const std::vector<glm::ivec3> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  Corners corners;
  for (const glm::ivec3& f : faces) {
    const auto point = [&](int i, int j) {
      const float u = static_cast<float>(i) / static_cast<float>(sides),
                  v = static_cast<float>(j) / static_cast<float>(sides);
      return glm::normalize((1 - u - v) * at[std::size_t(f.x)] + u * at[std::size_t(f.y)] + v * at[std::size_t(f.z)]);
    };
    for (int i = 0; i < sides; ++i) {
      for (int j = 0; i + j < sides; ++j) {
        corners += {point(i, j), point(i + 1, j), point(i, j + 1)};
        if (i + j + 1 < sides) corners += {point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
      }
    }
  }
  return corners;
}

/// A scan may have missed a triangle; the mouth of a flask is no such hole.
TEST(Sheet, SmallHolesLeaveASolid) {
  Corners scanned = ball(8);
  scanned.resize(scanned.size() - 3);
  EXPECT_EQ(solidsAndSheets(Model().show({{1, scanned}})), Counts(1279, 0));
  Corners flask;
  const Corners whole = ball(8);
  for (std::size_t k = 0; k < whole.size(); k += 3)
    if (whole[k].y < 0.95f) flask += {whole[k], whole[k + 1], whole[k + 2]};
  EXPECT_EQ(solidsAndSheets(Model().show({{1, flask}})).first, 0);
}

/// Faces of one solid need not be cut where their neighbours are.
TEST(Sheet, ALongSideAlongShortOnesIsNoHole) {
  std::vector<Corners> faces = cube();
  Corners fine;
  for (int axis = 0; axis < 4; ++axis) {  // the lid, cut into 4 x 4
    for (int row = 0; row < 4; ++row) {
      const float x = 0.25f * static_cast<float>(axis), y = 0.25f * static_cast<float>(row);
      fine += quad({x, y, 1}, {x + 0.25f, y, 1}, {x + 0.25f, y + 0.25f, 1}, {x, y + 0.25f, 1});
    }
  }
  faces.back() = fine;
  EXPECT_EQ(solidsAndSheets(Model().show({{1, all(faces)}})), Counts(10 + 32, 0));
  Corners strip = pane();  // and a sheet is one whatever its cracks
  strip += quad({1, 0, 0}, {1.5f, 0, 0.2f}, {1.5f, 0.5f, 0.2f}, {1, 0.5f, 0});
  strip += quad({1, 0.5f, 0}, {1.5f, 0.5f, 0.2f}, {1.5f, 1, 0.2f}, {1, 1, 0});
  EXPECT_EQ(solidsAndSheets(Model().show({{1, strip}})), Counts(0, 6));
}

/// Solids whose surface is cut into primitives, also of other materials.
TEST(Sheet, PrimitivesOfAMeshCloseEachOther) {
  std::vector<Corners> faces = cube();
  const Corners lid = faces.back();
  EXPECT_EQ(solidsAndSheets(Model().show({{1, withoutLid()}, {1, lid}})), Counts(12, 0));
  EXPECT_EQ(solidsAndSheets(Model().show({{1, withoutLid()}, {0, lid}})), Counts(10, 0)) << "a block with a label";
  EXPECT_EQ(solidsAndSheets(Model().show({{0, withoutLid()}, {1, lid}})), Counts(0, 2)) << "a room with a window";
}

/// Open and closed parts of one primitive, apart and where they touch.
TEST(Sheet, EachPartOfAPrimitiveIsJudgedByItself) {
  for (const glm::vec3 place : {glm::vec3(3, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0.3f, 0, 0)}) {
    Corners both = all(cube());
    both += moved(pane(), [&](const glm::vec3& p) { return p + place; });
    EXPECT_EQ(solidsAndSheets(Model().show({{1, both}})), Counts(12, 2)) << place.x;
  }
}

/// A pane may have two sides at one place, whichever diagonals they are cut along.
TEST(Sheet, ASurfaceThatEnclosesNoSpaceIsOne) {
  Corners alike = pane(), unlike = pane();
  alike += {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  unlike += quad({0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0});
  EXPECT_EQ(solidsAndSheets(Model().show({{1, alike}})), Counts(0, 4));
  EXPECT_EQ(solidsAndSheets(Model().show({{1, unlike}})), Counts(0, 4));
  const Corners flat = moved(all(cube()), [](const glm::vec3& p) { return p * glm::vec3(1, 1, 1e-3f); });
  EXPECT_EQ(solidsAndSheets(Model().show({{1, flat}})), Counts(12, 0)) << "a pane of a millimetre";
}

/// thicknessFactor is a length in the mesh's space.
TEST(Sheet, IsScaledByItsNode) {
  Model model;
  const Corners apart = moved(pane(), [](const glm::vec3& p) { return p + glm::vec3(0, 0, 3); });
  const int mesh = model.mesh({{1, apart}, {-1, apart}, {1, all(cube())}});
  model.builder.addRoot({{"mesh", mesh}, {"scale", {2, 2, 2}}});
  model.builder.addRoot({{"mesh", mesh}, {"scale", {-1, 1, 1}}});
  model.builder.addRoot({{"mesh", mesh}, {"scale", {1, 8, 1}}});
  const Scene scene = model.scene();
  std::multiset<float> sheets;
  for (const Material& material : scene.materials)
    if (material.thickness > 0 && !isSolid(material)) sheets.insert(material.thickness);
  EXPECT_EQ(sheets, (std::multiset<float>{0.5f, 1.0f}));
  EXPECT_EQ(solidsAndSheets(model), Counts(36, 6));
  EXPECT_EQ(std::ranges::count_if(scene.triangles,
                                  [&](const Triangle& t) { return scene.materials[t.material].transmission == 0; }),
            6)
      << "those of the default material";
}

TEST(Sheet, IsOneOfDiffuseTransmissionToo) {
  Model model;
  model.glass()["extensions"].erase("KHR_materials_transmission");
  model.glass()["extensions"]["KHR_materials_diffuse_transmission"]["diffuseTransmissionFactor"] = 0.5;
  EXPECT_EQ(solidsAndSheets(model.show({{1, pane()}})), Counts(0, 2));
}

}  // namespace
}  // namespace importon::test::sheet_test
