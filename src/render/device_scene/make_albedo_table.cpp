// Writes the tables of directional albedo as C++ initialisers to stdout; runs during the build. Each entry is
// the mean weight of a direction sampled by visible normals, over a grid of sample points, for the same
// microfacets as shaders/lib/ggx.glsl. [Heitz 2018; Kulla and Conty 2017]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/device_scene/sheen_albedo.h"
#include "shared/albedo_table.h"

namespace importon {
namespace {

constexpr double kPi = 3.14159265358979323846;
using Pair = std::array<double, 2>;
using dvec3 = glm::dvec3;

/// Roughness along x and along y; a number alone stands for both.
struct Alpha {
  Alpha(double both) : x(both), y(both) {}
  Alpha(double along, double across) : x(along), y(across) {}
  double x, y;
};

double lambda(const dvec3& w, const Alpha& alpha) {
  const double slope2 = alpha.x * alpha.x * w.x * w.x + alpha.y * alpha.y * w.y * w.y;
  return 0.5 * (std::sqrt(1 + slope2 / std::max(w.z * w.z, 1e-30)) - 1);
}

double fifthPower(double x) { return x * x * x * x * x; }

/// The centres of side x side cells of equal area of the unit disc.
std::vector<glm::dvec2> discPoints(int side) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double r = std::sqrt((i + 0.5) / side), phi = 2 * kPi * (j + 0.5) / side;
      points.emplace_back(r * std::cos(phi), r * std::sin(phi));
    }
  }
  return points;
}

/// Microfacet normals as a direction sees them, stretched.
class VisibleNormals {
 public:
  VisibleNormals(const dvec3& wo, const Alpha& alpha)
      : alpha_(alpha), view_(glm::normalize(dvec3(alpha.x * wo.x, alpha.y * wo.y, wo.z))) {
    const double sine = std::sqrt(view_.x * view_.x + view_.y * view_.y);
    if (sine > 0) t1_ = dvec3(-view_.y, view_.x, 0) / sine;
    t2_ = glm::cross(view_, t1_);
  }
  dvec3 at(const glm::dvec2& disc) const {
    const double x = disc.x, s = 0.5 * (1 + view_.z);
    const double y = (1 - s) * std::sqrt(std::max(0.0, 1 - x * x)) + s * disc.y;
    const dvec3 n = x * t1_ + y * t2_ + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * view_;
    return glm::normalize(dvec3(alpha_.x * n.x, alpha_.y * n.y, std::max(1e-9, n.z)));
  }

 private:
  Alpha alpha_;
  dvec3 view_, t1_{1, 0, 0}, t2_{};
};

dvec3 directionAt(double cosine) { return {std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine}; }

/// Mean of `weight(h)` over normals visible from wo, Side x Side of them.
template <int Side, class Weight>
auto meanOverNormals(const dvec3& wo, const Alpha& alpha, const Weight& weight) {
  static const std::vector<glm::dvec2> kPoints = discPoints(Side);
  const VisibleNormals normals(wo, alpha);
  Pair sum{};
  for (const glm::dvec2& point : kPoints) {
    const Pair w = weight(normals.at(point));
    sum[0] += w[0];
    sum[1] += w[1];
  }
  return Pair{sum[0] / (Side * Side), sum[1] / (Side * Side)};
}

template <int Side>
Pair reflectionAlbedo(const dvec3& wo, const Alpha& alpha) {
  const double out = 1 + lambda(wo, alpha);
  return meanOverNormals<Side>(wo, alpha, [&](const dvec3& h) {
    const double c = glm::dot(wo, h);
    const dvec3 wi = 2 * c * h - wo;
    const double weight = wi.z > 0 ? out / (out + lambda(wi, alpha)) : 0;
    return Pair{weight, weight * fifthPower(std::clamp(1 - c, 0.0, 1.0))};
  });
}

/// Roughness in the table of anisotropic albedo, of entries along each axis.
Alpha stretchedAlpha(unsigned b, unsigned s) {
  const double across = std::max(std::pow(b / (kStretchAlphas - 1.0), 2), 1e-4);
  return {across + (1 - across) * std::pow(s / (kStretches - 1.0), 2), across};
}

/// Squared cosine of the azimuth at which roughness is the share `t`, squared, of the way from across to along.
double azimuthAt(double t, const Alpha& alpha) {
  const double rough = alpha.y + t * t * (alpha.x - alpha.y), range = alpha.x * alpha.x - alpha.y * alpha.y;
  return range > 0 ? std::clamp((rough * rough - alpha.y * alpha.y) / range, 0.0, 1.0) : 0.0;
}

/// The table for one pair of roughnesses.
std::vector<Pair> stretchedRows(const Alpha& alpha) {
  constexpr int kSide = 48;
  std::vector<Pair> rows;
  for (unsigned t = 0; t < kStretchAzimuths; ++t) {
    const double azimuth = azimuthAt(t / (kStretchAzimuths - 1.0), alpha);
    for (unsigned i = 0; i < kStretchCosines; ++i) {
      const double cosine = std::pow(std::max(i / (kStretchCosines - 1.0), 0.03), 2),
                   sine = std::sqrt(1 - cosine * cosine);
      rows.push_back(
          reflectionAlbedo<kSide>(dvec3(sine * std::sqrt(azimuth), sine * std::sqrt(1 - azimuth), cosine), alpha));
    }
  }
  return rows;
}

double fresnel(double cosine, double eta) {
  const double sin2 = (1 - cosine * cosine) / (eta * eta);
  if (sin2 >= 1) return 1;
  const double inner = std::sqrt(1 - sin2);
  const double p = (eta * cosine - inner) / (eta * cosine + inner), s = (cosine - eta * inner) / (cosine + eta * inner);
  return 0.5 * (p * p + s * s);
}

double glassAlbedo(double cosine, double alpha, double eta) {
  constexpr int kSide = 40;
  const dvec3 wo = directionAt(cosine);
  const double out = 1 + lambda(wo, alpha);
  return meanOverNormals<kSide>(wo, alpha, [&](const dvec3& h) {
    const double c = std::max(glm::dot(wo, h), 0.0), f = fresnel(c, eta);
    const dvec3 mirrored = 2 * c * h - wo;
    double sum = mirrored.z > 0 ? f * out / (out + lambda(mirrored, alpha)) : 0;
    if (f < 1) {
      const dvec3 refracted = -wo / eta + (c / eta - std::sqrt(1 - (1 - c * c) / (eta * eta))) * h;
      if (refracted.z < 0) sum += (1 - f) * out / (out + lambda(refracted, alpha));
    }
    return Pair{sum, 0};
  })[0];
}

double quantised(double share) { return std::round(std::clamp(share, 0.0, 1.0) * 65535) / 65535; }

/// Mean over a row, weighted by the cosine, of what is linear in its square root between entries: exact.
double meanOfRow(const std::vector<double>& row) {
  const double step = 1.0 / static_cast<double>(row.size() - 1);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    const double a = static_cast<double>(i) * step, b = a + step;
    const double slope = (row[i + 1] - row[i]) / step, start = row[i] - slope * a;
    sum += start * (std::pow(b, 4) - std::pow(a, 4)) + slope * 0.8 * (std::pow(b, 5) - std::pow(a, 5));
  }
  return sum;
}

/// Reflectance of a clear coat, as coatReflectance of lib/coat.glsl, with the rows and means of the first table.
class CoatReflectance {
 public:
  CoatReflectance(const std::vector<Pair>& rows, const std::vector<Pair>& means, double alpha) {
    const double place = std::sqrt(alpha) * (kAlbedoSide - 1.0);
    const auto row = std::min(static_cast<std::size_t>(place), std::size_t{kAlbedoSide - 2});
    const double share = place - static_cast<double>(row);
    for (std::size_t i = 0; i < kAlbedoSide; ++i)
      row_.push_back(between(rows[row * kAlbedoSide + i], rows[(row + 1) * kAlbedoSide + i], share));
    const double mean = between(means[row], means[row + 1], share)[0], fresnel = kF0 + (1 - kF0) / 21;
    missed_ = fresnel * fresnel * mean / (1 - fresnel * (1 - mean));
  }
  double operator()(double cosine) const {
    const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kAlbedoSide - 1.0);
    const auto i = std::min(static_cast<std::size_t>(place), std::size_t{kAlbedoSide - 2});
    const Pair albedo = between(row_[i], row_[i + 1], place - static_cast<double>(i));
    return kF0 * (albedo[0] - albedo[1]) + albedo[1] + missed_ * (1 - albedo[0]);
  }

 private:
  static constexpr double kF0 = 0.04;
  static Pair between(const Pair& a, const Pair& b, double share) {
    return {a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share};
  }
  std::vector<Pair> row_;
  double missed_ = 0;
};

/// What a coat takes too much of: see coatTaken in lib/albedo.glsl. Light that the base's microfacets scatter more than
/// once is diffuse.
Pair coatTaken(double cosine, double alpha, const CoatReflectance& reflectance) {
  constexpr int kSide = 40, kSteps = 200;
  const dvec3 wo = directionAt(cosine);
  const double out = 1 + lambda(wo, alpha), turnedOut = reflectance(cosine);
  const Pair metal = meanOverNormals<kSide>(wo, alpha, [&](const dvec3& h) {
    const dvec3 wi = 2 * glm::dot(wo, h) * h - wo;
    const double weight = wi.z > 0 ? out / (out + lambda(wi, alpha)) : 0;
    return Pair{weight, weight * std::max(reflectance(wi.z) - turnedOut, 0.0)};
  });
  double diffuse = 0;
  for (int k = 0; k < kSteps; ++k)
    diffuse += std::max(reflectance(std::sqrt((k + 0.5) / kSteps)) - turnedOut, 0.0) / kSteps;
  return {metal[1] + (1 - metal[0]) * diffuse, diffuse};
}

void write(const Pair& texel) {
  const auto bits = [](double share) { return static_cast<unsigned>(std::lround(quantised(share) * 65535)); };
  std::printf("%uu,\n", bits(texel[0]) | bits(texel[1]) << 16);
}

/// Rows of `side` cosines for `side` alphas, and their means.
template <class Albedo>
void tabulate(unsigned side, const Albedo& albedo, std::vector<Pair>& texels, std::vector<Pair>& means) {
  for (unsigned j = 0; j < side; ++j) {
    std::array<std::vector<double>, 2> row;
    for (unsigned i = 0; i < side; ++i) {
      const double x = std::max(i / (side - 1.0), 1e-3), y = j / (side - 1.0);
      const Pair texel = albedo(x * x, std::max(y * y, 1e-8));
      for (std::size_t c : {0u, 1u}) row[c].push_back(quantised(texel[c]));
      texels.push_back(texel);
    }
    means.push_back({meanOfRow(row[0]), meanOfRow(row[1])});
  }
}

/// Mean of interpolated rows over all directions, weighted by the cosine.
Pair meanOfStretched(const std::vector<Pair>& rows, const Alpha& alpha) {
  constexpr int kSteps = 64;
  Pair sum{};
  for (int k = 0; k < kSteps; ++k) {
    const double turn = std::pow(std::cos((k + 0.5) / kSteps * kPi / 2), 2);
    const double rough = std::sqrt(alpha.y * alpha.y + turn * (alpha.x * alpha.x - alpha.y * alpha.y));
    const double t = alpha.x > alpha.y ? std::sqrt((rough - alpha.y) / (alpha.x - alpha.y)) : 0;
    const double place = t * (kStretchAzimuths - 1.0);
    const auto row = std::min(static_cast<std::size_t>(place), std::size_t{kStretchAzimuths - 2});
    for (std::size_t c : {0u, 1u}) {
      std::vector<double> between;
      for (std::size_t i = 0; i < kStretchCosines; ++i) {
        const double low = rows[row * kStretchCosines + i][c], high = rows[(row + 1) * kStretchCosines + i][c];
        between.push_back(low + (place - static_cast<double>(row)) * (high - low));
      }
      sum[c] += meanOfRow(between) / kSteps;
    }
  }
  return sum;
}

void writeStretched() {
  std::vector<Pair> means;
  for (unsigned b = 0; b < kStretchAlphas; ++b) {
    for (unsigned s = 0; s < kStretches; ++s) {
      const Alpha alpha = stretchedAlpha(b, s);
      const std::vector<Pair> rows = stretchedRows(alpha);
      std::for_each(rows.begin(), rows.end(), write);
      means.push_back(meanOfStretched(rows, alpha));
    }
  }
  std::for_each(means.begin(), means.end(), write);
}

void writeAll() {
  std::vector<Pair> texels, means;
  tabulate(
      kAlbedoSide, [](double cosine, double alpha) { return reflectionAlbedo<96>(directionAt(cosine), alpha); }, texels,
      means);
  for (const auto* list : {&texels, &means}) std::for_each(list->begin(), list->end(), write);
  const std::vector<Pair> reflection = texels, reflectionMeans = means;
  texels.clear();
  means.clear();
  for (unsigned k = 0; k < kGlassAlbedoIndices; ++k) {
    const double s = static_cast<double>(kGlassAlbedoLargest) * k / (kGlassAlbedoIndices - 1.0);
    const double n = (1 + s) / (1 - s);
    tabulate(
        kGlassAlbedoSide,
        [n](double cosine, double alpha) {
          return Pair{glassAlbedo(cosine, alpha, n), glassAlbedo(cosine, alpha, 1 / n)};
        },
        texels, means);
  }
  for (const auto* list : {&texels, &means}) std::for_each(list->begin(), list->end(), write);
  texels.clear();
  means.clear();
  for (unsigned k = 0; k < kCoatAlphas; ++k) {
    const CoatReflectance coat(reflection, reflectionMeans, std::pow(k / (kCoatAlphas - 1.0), 2));
    tabulate(
        kCoatSide, [&](double cosine, double alpha) { return coatTaken(cosine, alpha, coat); }, texels, means);
  }
  for (const auto* list : {&texels, &means}) std::for_each(list->begin(), list->end(), write);
  texels = sheenTable();
  std::for_each(texels.begin(), texels.end(), write);
  writeStretched();
}

}  // namespace
}  // namespace importon

int main() {
  importon::writeAll();
  return 0;
}
