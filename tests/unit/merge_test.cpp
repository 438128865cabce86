#include "report/merge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "base/error.h"

namespace importon::merge_test {
namespace {

/// Two pixels of one value in R, twice that in the variance.
Image run(const std::string& seed, const std::string& passes, float value, const std::string& job = "a1") {
  Image image{2, 1, {{"R", {value, value}}, {"variance.R", {2 * value, 2 * value}}, {"error.R", {value, value}}}, {}};
  image.attributes = {
      {"importon:job", job}, {"importon:seed", seed}, {"importon:passes", passes}, {"importon:scene", "room.gltf"}};
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

TEST(Merge, KeepsWhereCropsBelong) {
  ImageMerger merger;
  for (const char* seed : {"0", "1"}) {
    Image image = run(seed, "1", 1);
    image.whole = {8, 6, 3, 4};
    merger.add(image, seed);
  }
  EXPECT_EQ(merger.result().whole.width, 8);
  EXPECT_EQ(merger.result().whole.y, 4);
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

// Runs of 1 and 3 passes, values 2 and 4 around 3.5: the variance of the mean is (1·1.5² + 3·0.5²)/4 = 0.75, its relMSE
// 0.75/(3.5² + 0.01·3.5²).
TEST(Merge, SaysHowFarNoiseKeepsTheMeanFromItsLimit) {
  ImageMerger merger;
  for (const auto& [seed, passes, value] : {std::tuple{"0", "1", 2.0F}, std::tuple{"1", "3", 4.0F}}) {
    Image image = run(seed, passes, value);
    for (const char* name : {"G", "B"}) image.channels.push_back({name, {value, value}});
    image.attributes[kOwnError] = "7";
    merger.add(image, seed);
    EXPECT_EQ(merger.result().attributes.contains(kOwnError), seed == std::string("1")) << "of one image";
  }
  EXPECT_NEAR(std::stod(merger.result().attributes.at(kOwnError)), 0.75 / (1.01 * 3.5 * 3.5), 1e-4);
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
}  // namespace importon::merge_test
