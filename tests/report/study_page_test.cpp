// The page of study in a browser, and the figures behind it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/browser.h"
#include "report/false_color.h"
#include "report/sample_report.h"
#include "report/study_files.h"
#include "report/study_pictures.h"

namespace importon {
namespace {

using test::PageVisit;

/// Two configurations of 2 x 1 pixels with a global map and no caustic one.
StudyReport sampleStudy() {
  StudyReport report;
  for (const char* name : {"standard", "a<b"}) {
    StudyResult result;
    result.config = {name, "--control off", {}};
    result.image = test::greyRow({0.5F, 0.25F});
    for (const std::string& layer : studyLayers()) {
      const bool isStored = layer.starts_with("photons") || layer.starts_with("density");
      const float factor = isStored && std::string(name) != "standard" ? 0.5F : 1.F;
      const float value = layer.ends_with("global") ? factor * 100.F : 0.F;
      if (layer.starts_with("radiance")) {
        for (const char* c : {".R", ".G", ".B"}) result.image.channels.push_back({layer + c, {value, value}});
      } else {
        result.image.channels.push_back({layer + ".Y", {value, 0.F}});
      }
    }
    result.stats.photonsEmitted = 1000;
    result.stats.global = {4000, 2000, 500, 1500, {1, 2, 3}, {1, 2, 3}};
    result.stats.width = 2;
    result.stats.height = 1;
    report.results.push_back(std::move(result));
  }
  return report;
}

TEST(StudyFigures, LeaveOutEmptyMapsAndShareAScale) {
  const std::vector<StudyFigure> figures = studyFigures(sampleStudy());
  ASSERT_EQ(figures.size(), 8u);  // six of the global map, the image and the difference
  for (const StudyFigure& figure : figures) EXPECT_EQ(figure.title.find("caustic"), std::string::npos);
  const StudyFigure& density = figures[4];
  EXPECT_EQ(density.unit, "photons/m²");
  EXPECT_NEAR(density.high, 100, 1e-4);
  EXPECT_NEAR(density.low, 0.01, 1e-8);
  EXPECT_EQ(density.pictures.size(), 2u);
  EXPECT_EQ(figures[0].pictures.size(), 1u);  // importons are the same for both
}

TEST(StudyFigures, ColoursAreLogarithmic) {
  const PngPixels pixels = logColors(4, 1, std::vector<float>{0, 1, 10, 100}, 1, 100);
  const auto at = [&](std::size_t i) {
    return std::array{pixels.rgb[3 * i], pixels.rgb[3 * i + 1], pixels.rgb[3 * i + 2]};
  };
  EXPECT_EQ(at(0), falseColor(0));
  EXPECT_EQ(at(1), falseColor(0));
  EXPECT_EQ(at(2), falseColor(0.5F));
  EXPECT_EQ(at(3), falseColor(1));
}

TEST(StudyFiles, JsonHasTheCounts) {
  const auto json = nlohmann::json::parse(studyJson({"1.2.3", "room.gltf"}, sampleStudy()));
  ASSERT_EQ(json["configs"].size(), 2u);
  EXPECT_EQ(json["configs"][1]["name"], "a<b");
  EXPECT_EQ(json["configs"][0]["photons"]["global"]["stored"], 500);
  EXPECT_EQ(json["configs"][0]["mean_where_seen"]["global"]["required"], 100);
}

class StudyPage : public ::testing::Test {
 protected:
  void SetUp() override {
    browser_ = test::findBrowser();
    if (!browser_) GTEST_SKIP() << "no Chromium: apt-get install chromium";
  }
  PageVisit visit(const std::string& script) {
    return test::visitPage(*browser_, studyPage({"1.2.3", "room.gltf"}, sampleStudy()), script);
  }

 private:
  std::optional<std::string> browser_;
};

TEST_F(StudyPage, ShowsFiguresTablesAndScalesWithoutANetwork) {
  const PageVisit page = visit(
      "tell(document.querySelectorAll('section').length + ' ' + document.querySelectorAll('section.pair').length + ' ' "
      "+"
      "[...document.images].every(i => i.complete && i.naturalWidth === 2) + ' ' +"
      "document.querySelector('#figure4 .scale').textContent + ' ' +"
      "[...document.querySelectorAll('#counts tr:nth-child(3) td')].map(c => c.textContent).join(','));");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "8 4 true 0.010.1110100 photons/m² a<b,global,0,1000,2000,500,25 %,6,6");
}

TEST_F(StudyPage, WipesBetweenPicturesOfAPair) {
  const PageVisit page = visit(
      "const box = document.querySelector('#figure4 .wipe').getBoundingClientRect();"
      "document.querySelector('#figure4 .wipe').dispatchEvent(new PointerEvent('pointermove',"
      "{ buttons: 1, clientX: box.left + 0.25 * box.width, clientY: box.top + 1 }));"
      "tell(document.querySelector('#figure4 .over').style.clipPath + ' ' +"
      "document.querySelector('#figure5 .over').style.clipPath + ' ' +"
      "getComputedStyle(document.querySelector('#figure0 .over')).display);");
  EXPECT_EQ(page.errors, "");
  EXPECT_EQ(page.result, "inset(0px 75% 0px 0px) inset(0px 50% 0px 0px) none");
}

}  // namespace
}  // namespace importon
