#include "method/paired_render.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace importon::test {
namespace {

/// Mean over pixels and channels of what `term` says of a value of the two halves and of the image.
template <class Term>
double meanOverValues(const ReferenceHalves& halves, const RenderResult& image, const Term& term) {
  const double mean = 0.5 * (meanOf(halves.a) + meanOf(halves.b));
  double sum = 0;
  std::size_t count = 0;
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float>&a = channel(halves.a, name), &b = channel(halves.b, name), &v = channel(image, name);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double ai = a[i], bi = b[i], t = 0.5 * (ai + bi);
      sum += term(ai, bi, static_cast<double>(v[i])) / (t * t + 0.01 * mean * mean);
    }
    count += v.size();
  }
  return sum / static_cast<double>(count);
}

}  // namespace

double ReferenceHalves::ownError() const {
  return meanOverValues(*this, a, [](double x, double y, double) { return 0.25 * (x - y) * (x - y); });
}

double ReferenceHalves::errorOf(const RenderResult& image) const {
  return meanOverValues(*this, image, [](double x, double y, double v) { return (v - x) * (v - y); });
}

ReferenceHalves renderHalves(const Scene& scene, RenderJob job) {
  ReferenceHalves halves{renderScene(scene, job), {}};
  ++job.seed;
  halves.b = renderScene(scene, job);
  return halves;
}

namespace {

double photonsIn(const RenderResult& result, MapKind kind) {
  return static_cast<double>((kind == MapKind::caustic ? result.stats.caustic : result.stats.global).stored);
}

void addPair(PairedFigures& figures, const RenderResult& found, const RenderResult& classical, MapKind kind,
             const ReferenceHalves* reference) {
  EXPECT_NE(channel(found, "G"), channel(classical, "G")) << "both sides are the same image";
  figures.meanRatio.add(meanOf(found) / meanOf(classical));
  figures.stored.add(photonsIn(found, kind));
  figures.hits.add(photonsIn(classical, kind));
  figures.timesFewer.add(photonsIn(classical, kind) / photonsIn(found, kind));
  figures.bytesRatio.add(static_cast<double>(found.stats.photonMapBytes) /
                         static_cast<double>(classical.stats.photonMapBytes));
  if (reference == nullptr) return;
  const double error = reference->errorOf(classical), errorFound = reference->errorOf(found);
  figures.error.add(error);
  figures.errorRatio.add(std::log(errorFound / error));
  EXPECT_LT(reference->ownError(), 0.1 * std::min(error, errorFound));
}

}  // namespace

std::string describe(const PairedFigures& f) {
  return fmt::format(
      "{:.0f} of {:.0f} stored (1/{:.2f}), bytes {:.3f} times, mean {:.5f} +- {:.5f} times, "
      "error {:.3g}, by the rule {:.4f} times, logarithm +- {:.4f}",
      f.stored.mean(), f.hits.mean(), f.timesFewer.mean(), f.bytesRatio.mean(), f.meanRatio.mean(),
      f.meanRatio.standardError(), f.error.mean(), std::exp(f.errorRatio.mean()), f.errorRatio.standardError());
}

std::vector<PairedFigures> judgeAgainstClassicalMap(const Scene& scene, std::vector<RenderJob> jobs, int seeds,
                                                    MapKind kind, const ReferenceHalves* reference) {
  std::vector<PairedFigures> figures(jobs.size());
  RenderJob classicalJob = jobs.front();
  classicalJob.control = DensityControl::off;
  classicalJob.gatherFrom = GatherSource::photons;
  classicalJob.redistribute.reset();
  for (int i = 0; i < seeds; ++i, ++classicalJob.seed) {
    const RenderResult classical = renderScene(scene, classicalJob);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      jobs[k].seed = classicalJob.seed;
      addPair(figures[k], renderScene(scene, jobs[k]), classical, kind, reference);
    }
  }
  return figures;
}

}  // namespace importon::test
