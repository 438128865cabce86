#include "report/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "io/tone_map.h"

namespace importon {
namespace {

// Equation and section numbers are those of [Andersson et al. 2020].
constexpr double kPixelsPerDegree = 0.7 * 3840 / 0.7 * std::numbers::pi / 180;  // eq. in sec. 5
constexpr float kColorExponent = 0.7F;                                          // q_c, sec. 4.1.3
constexpr float kColorKnee = 0.4F, kColorKneeValue = 0.95F;                     // p_c, p_t
constexpr float kFeatureExponent = 0.5F;                                        // q_f, sec. 4.2
constexpr double kFeatureWidth = 0.082;                                         // w, degrees

using Triple = std::array<float, 3>;
using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // odd length, centre in the middle

struct Planes {
  int width = 0, height = 0;
  std::array<Plane, 3> channels;
};

// Linear sRGB to CIE XYZ, white point D65.
constexpr std::array<Triple, 3> kXyzFromRgb{Triple{0.41238656F, 0.35759149F, 0.18045049F},
                                            Triple{0.21263682F, 0.71518298F, 0.07218020F},
                                            Triple{0.01933062F, 0.11919716F, 0.95037259F}};
constexpr std::array<Triple, 3> kRgbFromXyz{Triple{3.24100326F, -1.53739899F, -0.49861587F},
                                            Triple{-0.96922426F, 1.87592998F, 0.04155422F},
                                            Triple{0.05563942F, -0.20401120F, 1.05714897F}};

Triple multiply(const std::array<Triple, 3>& matrix, const Triple& v) {
  Triple result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
  return result;
}

/// XYZ relative to the white point, so that white is (1, 1, 1).
Triple relativeXyz(const Triple& rgb) {
  static const Triple kWhite = multiply(kXyzFromRgb, {1, 1, 1});
  const Triple xyz = multiply(kXyzFromRgb, rgb);
  return {xyz[0] / kWhite[0], xyz[1] / kWhite[1], xyz[2] / kWhite[2]};
}

Triple rgbFromRelativeXyz(const Triple& relative) {
  static const Triple kWhite = multiply(kXyzFromRgb, {1, 1, 1});
  return multiply(kRgbFromXyz, {relative[0] * kWhite[0], relative[1] * kWhite[1], relative[2] * kWhite[2]});
}

/// Linearised L*a*b* without the cube root: luminance, red-green and blue-yellow.
Triple opponentFromRgb(const Triple& rgb) {
  const Triple xyz = relativeXyz(rgb);
  return {116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])};
}

Triple rgbFromOpponent(const Triple& opponent) {
  const float y = (opponent[0] + 16) / 116;
  return rgbFromRelativeXyz({y + opponent[1] / 500, y, y - opponent[2] / 200});
}

/// L*a*b* with the Hunt effect: chroma fades where it is dark (eq. 4).
Triple huntLabFromRgb(const Triple& rgb) {
  constexpr float kDelta = 6.F / 29;
  const auto curve = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.F / 29;
  };
  const Triple xyz = relativeXyz(rgb);
  const float x = curve(xyz[0]), y = curve(xyz[1]), z = curve(xyz[2]);
  const float lightness = 116 * y - 16;
  return {lightness, 0.01F * lightness * 500 * (x - y), 0.01F * lightness * 200 * (y - z)};
}

/// The HyAB distance (eq. 5).
float hyab(const Triple& a, const Triple& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

/// Along x, then along y; beyond the border the border's values repeat.
Plane convolve(const Plane& input, int width, int height, const Kernel& alongX, const Kernel& alongY) {
  const auto pass = [&](const Plane& from, const Kernel& kernel, bool isAlongX) {
    const int radius = static_cast<int>(kernel.size() / 2);
    Plane to(from.size());
    parallelFor(static_cast<std::size_t>(height), 16, 0, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
        for (int x = 0; x < width; ++x) {
          float sum = 0;
          for (int k = -radius; k <= radius; ++k) {
            const int readX = isAlongX ? std::clamp(x + k, 0, width - 1) : x;
            const int readY = isAlongX ? y : std::clamp(y + k, 0, height - 1);
            sum += kernel[static_cast<std::size_t>(k + radius)] *
                   from[static_cast<std::size_t>(readY) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(readX)];
          }
          to[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = sum;
        }
      }
    });
    return to;
  };
  return pass(pass(input, alongX, true), alongY, false);
}

/// One of the two Gaussians of a contrast sensitivity function: a sqrt(pi/b) exp(-pi² x²/b), x in degrees (eq.
/// 2).
struct Gaussian {
  double a, b;
};

// Luminance, red-green, blue-yellow (table 1).
constexpr std::array<std::array<Gaussian, 2>, 3> kSensitivity{
    {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};

/// What the eye resolves: each opponent channel filtered by its contrast sensitivity, of unit sum (sec. 4.1.1).
Plane contrastFiltered(const Plane& input, int width, int height, const std::array<Gaussian, 2>& sensitivity) {
  constexpr double kWidest = 0.04, kPi = std::numbers::pi;
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * kPixelsPerDegree));
  std::array<Kernel, 2> kernels;
  std::array<double, 2> weights{};
  for (std::size_t g = 0; g < 2; ++g) {
    double sum = 0;
    for (int k = -radius; k <= radius; ++k) {
      const double degrees = k / kPixelsPerDegree;
      const double value = std::exp(-kPi * kPi * degrees * degrees / sensitivity[g].b);
      kernels[g].push_back(static_cast<float>(value));
      sum += value;
    }
    for (float& value : kernels[g]) value = static_cast<float>(static_cast<double>(value) / sum);
    weights[g] = sensitivity[g].a * std::sqrt(kPi / sensitivity[g].b) * sum * sum;
  }
  Plane result(input.size(), 0.F);
  for (std::size_t g = 0; g < 2; ++g) {
    if (weights[g] == 0) continue;
    const Plane part = convolve(input, width, height, kernels[g], kernels[g]);
    const auto share = static_cast<float>(weights[g] / (weights[0] + weights[1]));
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += share * part[i];
  }
  return result;
}

Planes opponentPlanes(const ShownImage& image) {
  Planes planes{image.width, image.height, image.rgb};
  for (std::size_t i = 0; i < image.rgb[0].size(); ++i) {
    const Triple opponent = opponentFromRgb({image.rgb[0][i], image.rgb[1][i], image.rgb[2][i]});
    for (std::size_t c = 0; c < 3; ++c) planes.channels[c][i] = opponent[c];
  }
  return planes;
}

/// Perceptually uniform colours of what the eye resolves (sec. 4.1.1 and 4.1.2).
Planes perceived(const Planes& opponent) {
  Planes planes{opponent.width, opponent.height, {}};
  for (std::size_t c = 0; c < 3; ++c) {
    planes.channels[c] = contrastFiltered(opponent.channels[c], opponent.width, opponent.height, kSensitivity[c]);
  }
  for (std::size_t i = 0; i < planes.channels[0].size(); ++i) {
    Triple rgb = rgbFromOpponent({planes.channels[0][i], planes.channels[1][i], planes.channels[2][i]});
    for (float& value : rgb) value = std::clamp(value, 0.F, 1.F);
    const Triple lab = huntLabFromRgb(rgb);
    for (std::size_t c = 0; c < 3; ++c) planes.channels[c][i] = lab[c];
  }
  return planes;
}

/// The colour difference, compressed to [0, 1] (sec. 4.1.3).
float colorError(const Triple& a, const Triple& b) {
  static const float kGreatest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColorExponent);
  const float error = std::pow(hyab(a, b), kColorExponent), knee = kColorKnee * kGreatest;
  if (error < knee) return kColorKneeValue / knee * error;
  return std::min(1.F, kColorKneeValue + (error - knee) / (kGreatest - knee) * (1 - kColorKneeValue));
}

/// A Gaussian and its first or second derivative, positive and negative parts each of sum 1 (sec. 4.2).
struct FeatureKernels {
  Kernel gaussian, first, second;
};

void normalizeParts(Kernel& kernel) {
  float above = 0, below = 0;
  for (const float value : kernel) (value > 0 ? above : below) += std::abs(value);
  for (float& value : kernel) value /= value > 0 ? above : std::max(below, 1e-30F);
}

FeatureKernels featureKernels() {
  const double sigma = 0.5 * kFeatureWidth * kPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureKernels kernels;
  for (int k = -radius; k <= radius; ++k) {
    const double x2 = k * k / (sigma * sigma), gaussian = std::exp(-x2 / 2);
    kernels.gaussian.push_back(static_cast<float>(gaussian));
    kernels.first.push_back(static_cast<float>(-k * gaussian));
    kernels.second.push_back(static_cast<float>((x2 - 1) * gaussian));
  }
  normalizeParts(kernels.gaussian);
  normalizeParts(kernels.first);
  normalizeParts(kernels.second);
  return kernels;
}

/// Length of the gradient of `plane` along both axes by `derivative`.
Plane featureStrength(const Plane& plane, int width, int height, const Kernel& gaussian, const Kernel& derivative) {
  Plane strength = convolve(plane, width, height, derivative, gaussian);
  const Plane alongY = convolve(plane, width, height, gaussian, derivative);
  for (std::size_t i = 0; i < strength.size(); ++i) strength[i] = std::hypot(strength[i], alongY[i]);
  return strength;
}

/// Differences of edges and of points, whichever is larger, in [0, 1] (sec. 4.2, eq. 9).
Plane featureErrors(const Planes& test, const Planes& reference) {
  const FeatureKernels kernels = featureKernels();
  const auto strengths = [&](const Planes& opponent, const Kernel& derivative) {
    Plane achromatic = opponent.channels[0];
    for (float& value : achromatic) value = (value + 16) / 116;
    return featureStrength(achromatic, opponent.width, opponent.height, kernels.gaussian, derivative);
  };
  Plane errors(test.channels[0].size(), 0.F);
  for (const Kernel* derivative : {&kernels.first, &kernels.second}) {
    const Plane a = strengths(test, *derivative), b = strengths(reference, *derivative);
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::max(errors[i], std::abs(a[i] - b[i]));
  }
  for (float& error : errors) {
    error = std::pow(std::min(1.F, error / std::numbers::sqrt2_v<float>), kFeatureExponent);
  }
  return errors;
}

}  // namespace

ShownImage toneMapped(const Image& image, float exposure, const std::string& where) {
  const auto rgb = rgbOf(image, where);
  ShownImage shown{image.width, image.height, {}, std::vector<bool>(rgb[0].size())};
  for (std::size_t c = 0; c < 3; ++c) {
    for (const float value : rgb[c]) {
      shown.rgb[c].push_back(std::isfinite(value) ? filmicShoulder(value * exposure) : 0);
    }
    for (std::size_t i = 0; i < rgb[c].size(); ++i) shown.isBroken[i] = shown.isBroken[i] || !std::isfinite(rgb[c][i]);
  }
  return shown;
}

std::vector<float> ldrFlipMap(const ShownImage& test, const ShownImage& reference) {
  assert(test.width == reference.width && test.height == reference.height);
  const Planes testOpponent = opponentPlanes(test), referenceOpponent = opponentPlanes(reference);
  const Plane features = featureErrors(testOpponent, referenceOpponent);
  const Planes a = perceived(testOpponent), b = perceived(referenceOpponent);
  std::vector<float> map(features.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const float color = colorError({a.channels[0][i], a.channels[1][i], a.channels[2][i]},
                                   {b.channels[0][i], b.channels[1][i], b.channels[2][i]});
    map[i] = test.isBroken[i] || reference.isBroken[i] ? 1 : std::pow(color, 1 - features[i]);  // eq. 10
  }
  return map;
}

double ldrFlip(const ShownImage& test, const ShownImage& reference) {
  const std::vector<float> map = ldrFlipMap(test, reference);
  double sum = 0;
  for (const float value : map) sum += static_cast<double>(value);
  return sum / static_cast<double>(map.size());
}

}  // namespace importon
