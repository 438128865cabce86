/// The pictures of a study: light as a screen shows it, densities in false colours on one logarithmic scale.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "io/png.h"
#include "report/study.h"

namespace importon {

struct StudyPicture {
  std::string name;
  PngPixels pixels;
};

/// Pictures that belong together and can be wiped over each other.
struct StudyFigure {
  std::string title, text;
  std::string unit;          // of the scale; empty: light, without a scale
  double low = 0, high = 0;  // black and pale yellow stand for at most `low` and at least `high`
  std::vector<StudyPicture> pictures;
};

/// Logarithmic false colours of `values` between `low` and `high`, both above 0.
[[nodiscard]] PngPixels logColors(int width, int height, std::span<const float> values, double low, double high);

/// All figures that the report has layers for. Maps that are empty in every configuration are left out.
[[nodiscard]] std::vector<StudyFigure> studyFigures(const StudyReport& report);

}  // namespace importon
