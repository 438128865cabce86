#include "io/layers.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace importon {
namespace {

/// Channels of one pixel with the values 1, 2, ...
Image withChannels(const std::vector<std::string>& names) {
  Image image{1, 1, {}, {}};
  for (const std::string& name : names) {
    image.channels.push_back({name, {static_cast<float>(image.channels.size() + 1)}});
  }
  return image;
}

std::vector<float> colorOf(const Image& image, const std::string& layer = "") {
  const Image color = takeColor(image, layer, "a.exr");
  std::vector<float> values;
  for (const char* name : {"R", "G", "B"}) values.push_back(color.find(name)->values[0]);
  EXPECT_EQ(color.channels.size(), 3u);
  return values;
}

TEST(Layers, TakesThePlainColorBeforeAnyLayer) {
  EXPECT_EQ(colorOf(withChannels({"R", "G", "B", "albedo.R", "albedo.G", "albedo.B"})), (std::vector<float>{1, 2, 3}));
}

TEST(Layers, TakesTheOnlyLayerWithAColor) {
  EXPECT_EQ(colorOf(withChannels({"depth.Z", "View.Combined.B", "View.Combined.G", "View.Combined.R"})),
            (std::vector<float>{4, 3, 2}));
}

TEST(Layers, TakesTheNamedLayer) {
  const Image image = withChannels({"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "depth.Y"});
  EXPECT_EQ(colorOf(image, "albedo"), (std::vector<float>{4, 5, 6}));
  EXPECT_EQ(colorOf(image, "depth"), (std::vector<float>{7, 7, 7}));
  EXPECT_THROW((void)takeColor(image, "none", "a.exr"), SceneError);
}

TEST(Layers, ShowsLuminanceAsGrey) { EXPECT_EQ(colorOf(withChannels({"A", "Y"})), (std::vector<float>{2, 2, 2})); }

TEST(Layers, RefusesToGuessAmongSeveral) {
  const Image image = withChannels({"a.R", "a.G", "a.B", "b.R", "b.G", "b.B", "b.X"});
  EXPECT_EQ(colorLayers(image), (std::vector<std::string>{"a", "b"}));
  try {
    (void)takeColor(image, "", "a.exr");
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("choose a layer among a, b"), std::string::npos) << error.what();
  }
}

TEST(Layers, RefusesWhatHasNoColor) { EXPECT_THROW((void)takeColor(withChannels({"Z"}), "", "a.exr"), SceneError); }

}  // namespace
}  // namespace importon
