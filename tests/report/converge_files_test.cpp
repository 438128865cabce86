#include "report/converge_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/page.h"
#include "report/sample_report.h"

namespace importon {
namespace {

using test::greyRow;
using test::sampleReport;
using test::sampleTitle;

// The first curve falls from 0.16 to 0.01: a quarter, half and three quarters of the way in logarithms.
TEST(Converge, SetsLevelsByTheFirstConfiguration) {
  const ConvergeReport report = sampleReport();
  ASSERT_EQ(report.levels.size(), 3u);
  EXPECT_NEAR(report.levels[0], 0.08, 1e-12);
  EXPECT_NEAR(report.levels[1], 0.04, 1e-12);
  EXPECT_NEAR(report.levels[2], 0.02, 1e-12);
}

// The second curve, four times as high, needs twice the time, and does not get to the last level.
TEST(Converge, FindsTheTimeToEqualError) {
  const ConvergeReport report = sampleReport();
  const auto& slow = report.results[1].timeToError;
  EXPECT_NEAR(report.results[0].timeToError[0]->mean, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(report.results[0].timeToError[2]->mean, 2 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(slow[0]->mean, 2 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(slow[1]->mean, 4, 1e-9);
  EXPECT_FALSE(slow[2]);
}

TEST(Converge, WritesAllAsJson) {
  const auto json = nlohmann::json::parse(convergeJson(sampleTitle(), sampleReport()));
  EXPECT_EQ(json["scene"], "room.gltf");
  EXPECT_EQ(json["device"]["name"], "test device");
  EXPECT_EQ(json["reference_error"], 0.003);
  ASSERT_EQ(json["configs"].size(), 2u);
  const auto& config = json["configs"][1];
  EXPECT_EQ(config["name"], "a<b");
  EXPECT_EQ(config["options"], "--control off");
  EXPECT_EQ(config["runs"][1]["seed"], 2);
  EXPECT_EQ(config["runs"][1]["points"][2]["passes"], 40);
  EXPECT_NEAR(config["runs"][0]["points"][0]["relmse_trimmed"].get<double>(), 0.64, 1e-12);
  EXPECT_EQ(config["summary"][0]["squared_bias"], 0.01);
  EXPECT_TRUE(config["time_to_error"][2]["seconds"].is_null());
}

TEST(Converge, WritesARowForEachPoint) {
  const std::string csv = convergeCsv(sampleReport());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2 * 3);
  EXPECT_NE(csv.find("\ndefault,2,4,4,40,1000,500,2000000,1000000,0.01,0.01,0.025,0.025,0,0.5,1.5\n"),
            std::string::npos)
      << csv;
}

TEST(Page, CodesInBase64) {
  const std::string uri = dataUri({1, 1, {255, 0, 0}});
  ASSERT_EQ(uri.substr(0, 22), "data:image/png;base64,");
  EXPECT_EQ(uri.substr(22, 11), "iVBORw0KGgo");  // every PNG begins so
  EXPECT_EQ((uri.size() - 22) % 4, 0u);
}

TEST(Page, LetsNoDataEndTheScript) {
  EXPECT_EQ(fillPage("<script>@DATA@</script>", "\"</script>\""), "<script>\"\\u003c/script>\"</script>");
  EXPECT_THROW((void)fillPage("no mark", "{}"), std::logic_error);
}

TEST(Page, HoldsAllThatItShows) {
  const std::string page = convergePage(sampleTitle(), sampleReport(), greyRow({0.5F, 0.5F}));
  for (const char* outside : {"src=\"http", "href=\"http", "url(http", "@import", "fetch(", "XMLHttpRequest"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
}

}  // namespace
}  // namespace importon
