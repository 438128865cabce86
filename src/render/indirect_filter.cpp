#include "render/indirect_filter.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/parallel.h"

namespace importon {
namespace {

constexpr std::array kRadii{0, 1, 2, 4, 8, 14};  // pixels
constexpr int kEdgeRadius = 4;                   // the largest for pixels that see an edge
constexpr int kWindow = 8;                       // half the side of the window that chooses the radius, pixels
constexpr float kLikeNormal = 0.9f;
constexpr float kPurity = 0.98f;   // length of the mean normal below which a pixel sees several surfaces
constexpr float kLikeMixture = 0.15f;  // distance of mean normals below which two such pixels see them alike

/// What the filter knows of a pixel.
struct Guide {
  vec3 position{0};
  vec3 normal{0};       // of unit length if pure, else the mean
  bool hasGathers = false;
  bool isPure = false;  // all its gathers lie on one smooth surface
};

/// Means over a pixel's paths.
struct Gathered {
  vec3 indirect, modulation;
};

struct Halves {
  std::vector<Gathered> even, odd;
  int width, height;
  std::vector<Guide> guides;
};

Gathered meanOf(const FilmPixel& sums, float samples) { return {sums.indirect / samples, sums.modulation / samples}; }

Guide makeGuide(const FilmPixel& a, const FilmPixel& b) {
  Guide g;
  const float gathers = a.gathers + b.gathers;
  if (a.gathers < 1 || b.gathers < 1) return g;
  g.position = (a.position + b.position) / gathers;
  const vec3 normal = (a.normal + b.normal) / gathers;
  const float length = glm::length(normal);
  g.hasGathers = true;
  g.isPure = length > kPurity;
  g.normal = g.isPure ? normal / length : normal;
  return g;
}

/// True if q's gathers may stand for p's: like normals, and each in the other's plane up to a tenth of the distance.
/// Pixels on an edge go with others that see both sides in like shares.
bool isLike(const Guide& p, const Guide& q) {
  if (!q.hasGathers || p.isPure != q.isPure) return false;
  if (!p.isPure) return glm::distance(p.normal, q.normal) < kLikeMixture;
  if (glm::dot(p.normal, q.normal) < kLikeNormal) return false;
  const vec3 offset = q.position - p.position;
  const float off = std::max(std::abs(glm::dot(offset, p.normal)), std::abs(glm::dot(offset, q.normal)));
  return off * off <= 0.01f * glm::dot(offset, offset);
}

struct Estimate {
  vec3 even{0}, odd{0};  // irradiance of each half: indirect light over its modulation
};

vec3 ratio(vec3 a, vec3 b) {
  return {b.x > 0 ? a.x / b.x : 0.0f, b.y > 0 ? a.y / b.y : 0.0f, b.z > 0 ? a.z / b.z : 0.0f};
}

/// Irradiance of both halves over the disc of `radius` pixels around pixel (x, y).
Estimate average(const Halves& h, int x, int y, int radius) {
  const std::size_t centre = static_cast<std::size_t>(y) * static_cast<std::size_t>(h.width) + static_cast<std::size_t>(x);
  Estimate sum;
  vec3 evenModulation(0), oddModulation(0);
  const auto add = [&](std::size_t i) {
    sum.even += h.even[i].indirect;
    sum.odd += h.odd[i].indirect;
    evenModulation += h.even[i].modulation;
    oddModulation += h.odd[i].modulation;
  };
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const int qx = x + dx, qy = y + dy;
      if (dx * dx + dy * dy > radius * radius || qx < 0 || qy < 0 || qx >= h.width || qy >= h.height) continue;
      const std::size_t i = static_cast<std::size_t>(qy) * static_cast<std::size_t>(h.width) + static_cast<std::size_t>(qx);
      if (i == centre || isLike(h.guides[centre], h.guides[i])) add(i);
    }
  }
  return {ratio(sum.even, evenModulation), ratio(sum.odd, oddModulation)};
}

/// How badly each half's estimate predicts the other half's own irradiance. Bounded, so that one very bright sample
/// does not choose the radius for a whole window.
float residual(const Estimate& estimate, const Estimate& own) {
  const vec3 a = estimate.even - own.odd, b = estimate.odd - own.even;
  const float size = glm::dot(estimate.even, estimate.even) + glm::dot(estimate.odd, estimate.odd);
  return std::min(glm::dot(a, a) + glm::dot(b, b), 8 * size);
}

/// Means of `values` over windows of (2 kWindow + 1)² pixels, row sums first.
std::vector<float> blur(const std::vector<float>& values, int width, int height, int threads) {
  const auto at = [width](int x, int y) { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x); };
  std::vector<float> rows(values.size()), out(values.size());
  parallelFor(static_cast<std::size_t>(height), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x)
        for (int q = std::max(x - kWindow, 0); q <= std::min(x + kWindow, width - 1); ++q) rows[at(x, y)] += values[at(q, y)];
  });
  parallelFor(static_cast<std::size_t>(height), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int q = std::max(y - kWindow, 0); q <= std::min(y + kWindow, height - 1); ++q)
        for (int x = 0; x < width; ++x) out[at(x, y)] += rows[at(x, q)];
  });
  return out;
}

Halves makeHalves(std::span<const FilmPixel> film, int width, const SampleCounts& counts) {
  const std::size_t pixels = film.size() / 2;
  Halves h{{}, {}, width, static_cast<int>(pixels) / width, {}};
  for (std::size_t i = 0; i < pixels; ++i) {
    h.even.push_back(meanOf(film[i], counts.even(i)));
    h.odd.push_back(meanOf(film[pixels + i], counts.odd(i)));
    h.guides.push_back(makeGuide(film[i], film[pixels + i]));
  }
  return h;
}

}  // namespace

FilteredIndirect filterIndirect(std::span<const FilmPixel> film, int width, const SampleCounts& counts, int threads) {
  const std::size_t pixels = film.size() / 2;
  const Halves h = makeHalves(film, width, counts);
  const float evenShare = counts.evenShare();
  std::vector<float> best(pixels);
  FilteredIndirect result{std::vector<vec3>(pixels), std::vector<vec3>(pixels)};
  for (const int radius : kRadii) {
    std::vector<Estimate> estimates(pixels);
    std::vector<float> residuals(pixels);
    parallelFor(static_cast<std::size_t>(h.height), 4, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y)
        for (int x = 0; x < width; ++x) {
          const std::size_t i = y * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
          if (!h.guides[i].hasGathers || (radius > kEdgeRadius && !h.guides[i].isPure)) continue;
          const Estimate own = average(h, x, static_cast<int>(y), 0);
          estimates[i] = average(h, x, static_cast<int>(y), radius);
          residuals[i] = residual(estimates[i], own);
        }
    });
    const std::vector<float> around = blur(residuals, width, h.height, threads);
    for (std::size_t i = 0; i < pixels; ++i) {
      if (radius == 0) {
        best[i] = around[i];
        result.even[i] = h.even[i].indirect;
        result.odd[i] = h.odd[i].indirect;
      } else if (h.guides[i].hasGathers && (radius <= kEdgeRadius || h.guides[i].isPure) && around[i] < best[i]) {
        best[i] = around[i];
        const vec3 modulation = h.even[i].modulation * evenShare + h.odd[i].modulation * (1 - evenShare);
        result.even[i] = modulation * estimates[i].even;
        result.odd[i] = modulation * estimates[i].odd;
      }
    }
  }
  return result;
}

}  // namespace importon
