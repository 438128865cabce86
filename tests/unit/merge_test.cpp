#include "report/merge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace importon {
namespace {

/// Two pixels of one value in R, twice that in the variance.
Image run(const std::string& seed, const std::string& passes, float value, const std::string& job = "a1") {
  Image image{2, 1, {{"R", {value, value}}, {"variance.R", {2 * value, 2 * value}}, {"error.R", {value, value}}}, {}};
  image.attributes = {{"importon:job", job}, {"importon:seed", seed}, {"importon:passes", passes},
                      {"importon:scene", "room.gltf"}};
  return image;
}

/// The message of the SceneError that merging leads to.
std::string refusal(const Image& a, const Image& b) {
  ImageMerger merger;
  merger.add(a, "a.exr");
  try {
    merger.add(b, "b.exr");
  } catch (const SceneError& error) {
    return error.what();
  }
  ADD_FAILURE() << "merged";
  return "";
}

// (3·1 + 1·5)/4 = 2; the variance of the mean is (9·2 + 1·10)/16 = 1.75.
TEST(Merge, AveragesByPasses) {
  ImageMerger merger;
  merger.add(run("0", "3", 1), "a.exr");
  merger.add(run("1", "1", 5), "b.exr");
  const Image image = merger.result();
  EXPECT_EQ(image.find("R")->values, (std::vector<float>{2, 2}));
  EXPECT_EQ(image.find("variance.R")->values, (std::vector<float>{1.75F, 1.75F}));
  EXPECT_NEAR(image.find("error.R")->values[0], std::sqrt(9 * 1 + 25) / 4, 1e-6);
  EXPECT_EQ(image.attributes.at("importon:seed"), "0 1");
  EXPECT_EQ(image.attributes.at("importon:passes"), "4");
  EXPECT_EQ(image.attributes.at("importon:scene"), "room.gltf");
}

TEST(Merge, MergesMergedImagesAsIfAllAtOnce) {
  ImageMerger all, two, rest;
  for (ImageMerger* merger : {&all, &two}) {
    merger->add(run("7", "2", 1), "a.exr");
    merger->add(run("3", "4", 4), "b.exr");
  }
  all.add(run("5", "2", 9), "c.exr");
  rest.add(two.result(), "ab.exr");
  rest.add(run("5", "2", 9), "c.exr");
  EXPECT_EQ(rest.result().find("R")->values, all.result().find("R")->values);
  EXPECT_EQ(rest.result().find("variance.R")->values, all.result().find("variance.R")->values);
  EXPECT_EQ(rest.result().attributes, all.result().attributes);
}

TEST(Merge, RefusesWhatIsNotOneImage) {
  EXPECT_NE(refusal(run("0", "1", 1), run("0", "1", 1)).find("seed 0 is there twice"), std::string::npos);
  EXPECT_NE(refusal(run("0", "1", 1), run("1", "1", 1, "b2")).find("settings"), std::string::npos);
  Image wide = run("1", "1", 1);
  wide.width = 3;
  EXPECT_NE(refusal(run("0", "1", 1), wide).find("sizes"), std::string::npos);
  Image bare = run("1", "1", 1);
  bare.channels.pop_back();
  EXPECT_NE(refusal(run("0", "1", 1), bare).find("layers"), std::string::npos);
}

TEST(Merge, RefusesWhatWasNotRenderedByImporton) {
  ImageMerger merger;
  for (const char* missing : {"importon:job", "importon:seed", "importon:passes"}) {
    Image image = run("0", "1", 1);
    image.attributes.erase(missing);
    EXPECT_THROW(merger.add(image, "a.exr"), SceneError) << missing;
  }
  EXPECT_THROW(merger.add(run("0", "many", 1), "a.exr"), SceneError);
  EXPECT_THROW(merger.add(run("0", "0", 1), "a.exr"), SceneError);
}

}  // namespace
}  // namespace importon
