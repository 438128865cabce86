#include "report/study.h"

#include <chrono>

#include "render/render.h"

namespace importon {

std::vector<std::string> studyLayers() {
  std::vector<std::string> layers;
  for (const char* name : {"importons", "importance", "required", "photons", "density", "radiance"}) {
    for (const char* map : {".caustic", ".global"}) layers.push_back(std::string(name) + map);
  }
  return layers;
}

StudyReport study(const std::vector<StudyConfig>& configs, const Scene& scene, Log& log,
                  const std::atomic<bool>& isInterrupted, const std::function<void(const std::string&)>& tell) {
  StudyReport report;
  for (const StudyConfig& config : configs) {
    if (isInterrupted) break;
    tell(config.name);
    StudyResult result{config, {}, {}, {}};
    result.config.job.aovs = studyLayers();
    const auto start = std::chrono::steady_clock::now();
    RenderResult rendered = render(
        result.config.job, scene, log, isInterrupted, [](const RenderProgress&) {}, start);
    if (rendered.stats.passes == 0) break;
    result.image = std::move(rendered.image);
    result.stats = std::move(rendered.stats);
    result.stats.seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Image& first = report.results.empty() ? result.image : report.results.front().image;
    result.againstFirst = compareImages(result.image, config.name, first, configs.front().name);
    report.results.push_back(std::move(result));
  }
  return report;
}

}  // namespace importon
