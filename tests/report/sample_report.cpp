#include "report/sample_report.h"

namespace importon::test {

Image greyRow(const std::vector<float>& values) {
  Image image{static_cast<int>(values.size()), 1, {}, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, values});
  return image;
}

ConvergeReport sampleReport() {
  ConvergeReport report;
  report.deviceName = "test device";
  report.deviceDriver = "test driver";
  for (const double factor : {1.0, 4.0}) {
    ConvergeResult result;
    result.config.name = factor == 1 ? "default" : "a<b";
    result.config.options = factor == 1 ? "" : "--control off";
    for (const std::uint32_t seed : {1u, 2u}) {
      ConvergeRun run{seed, {}, 2000000, 1000000};
      for (const double budget : {1.0, 2.0, 4.0}) {
        ConvergePoint point{budget, budget, static_cast<int>(10 * budget), 1000, 500, {}, {}};
        point.errors.relmse = point.errors.relmseTrimmed = factor * 0.16 / (budget * budget);
        point.errors.smape = point.errors.rmse = 0.1 / budget;
        point.band = {0.02 / budget, 0.04 / budget, 0.06 / budget, 2};
        run.points.push_back(point);
      }
      result.runs.push_back(run);
    }
    for (const double budget : {1.0, 2.0, 4.0}) result.summaries.push_back({budget, {}, {}, ErrorParts{0.01, 0.02}});
    result.image = greyRow({0.5F, 0.25F});
    report.results.push_back(std::move(result));
  }
  summarize(report);
  return report;
}

ConvergeTitle sampleTitle() { return {"1.2.3", "room.gltf", "reference.exr", 2, {1, 2, 4}, 0.003}; }

}  // namespace importon::test
