#include "method/render_scene.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace importon::test {

RenderResult renderScene(const Scene& scene, const RenderJob& job) {
  Log log(Log::Verbosity::quiet);
  const std::atomic<bool> isInterrupted = false;
  return render(
      job, scene, log, isInterrupted, [](const RenderProgress&) {}, std::chrono::steady_clock::now());
}

const std::vector<float>& channel(const RenderResult& result, const std::string& name) {
  const Channel* found = result.image.find(name);
  if (found == nullptr) throw std::runtime_error("the image has no channel " + name);
  return found->values;
}

double meanOf(const RenderResult& result, const std::string& layer) {
  double sum = 0, count = 0;
  for (const char* suffix : {"R", "G", "B"}) {
    const std::vector<float>& values = channel(result, layer.empty() ? suffix : layer + "." + suffix);
    sum += std::accumulate(values.begin(), values.end(), 0.0);
    count += static_cast<double>(values.size());
  }
  return sum / count;
}

double relativeError(const RenderResult& result, const RenderResult& reference) {
  const double mean = meanOf(reference);
  std::vector<double> errors;
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float>& values = channel(result, name);
    const std::vector<float>& truth = channel(reference, name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double v = values[i], t = truth[i];
      errors.push_back((v - t) * (v - t) / (t * t + 0.01 * mean * mean));
    }
  }
  std::sort(errors.begin(), errors.end());
  errors.resize(errors.size() - errors.size() / 1000);
  return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

}  // namespace importon::test
