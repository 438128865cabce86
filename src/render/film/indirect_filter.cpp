#include "render/film/indirect_filter.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "base/parallel.h"

namespace importon {
namespace {

constexpr std::array kRadii{0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 15};  // pixels
constexpr int kEdgeRadius = 4;                                    // the largest for pixels that see an edge
constexpr int kGuessRadius = 4;                                   // of the disc that tells how bright a pixel is about
constexpr int kRadiusWindow = 5;  // half the side of the window that chooses the radius, pixels
constexpr float kLikeNormal = 0.9f;
constexpr float kPurity = 0.98f;       // length of the mean normal below which a pixel sees several surfaces
constexpr float kLikeMixture = 0.15f;  // distance of mean normals below which two such pixels see them alike

// Loops over pixels in a row are compiled for wider vectors too, of which the device that runs them takes its widest.
// Products are not fused with sums, so that the bits are the same.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define IMPORTON_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define IMPORTON_VECTORS
#endif

using Plane = std::vector<float>;  // a number for each pixel, row by row

/// With what others a pixel shares its gathers: those on one smooth surface, or on an edge. 0: it has none to share.
constexpr float kSharesSurface = 1, kSharesMixture = 2;

/// What tells pixels apart: position, and normal, which is of unit length on one surface, else the mean; sharing.
using Guides = std::array<Plane, 7>;
constexpr std::size_t kPosition = 0, kNormal = 3, kSharing = 6;

/// Of the even half and of the odd one: indirect light, and modulation.
using LightPlanes = std::array<Plane, 12>;
constexpr std::size_t kEven = 0, kOdd = 6, kModulation = 3;

template <std::size_t N>
std::array<Plane, N> planesOf(std::size_t pixels) {
  std::array<Plane, N> planes;
  planes.fill(Plane(pixels));
  return planes;
}

template <std::size_t N>
vec3 read(const std::array<Plane, N>& planes, std::size_t first, std::size_t pixel) {
  return {planes[first][pixel], planes[first + 1][pixel], planes[first + 2][pixel]};
}

template <std::size_t N>
void write(std::array<Plane, N>& planes, std::size_t first, std::size_t pixel, vec3 v) {
  for (int c = 0; c < 3; ++c) planes[first + static_cast<std::size_t>(c)][pixel] = v[c];
}

/// Rows of planes from a pixel on.
template <std::size_t N, class Planes>
auto rowsAt(Planes& planes, std::size_t pixel) {
  std::array<decltype(planes[0].data()), N> rows;
  for (std::size_t k = 0; k < N; ++k) rows[k] = planes[k].data() + pixel;
  return rows;
}

using GuideRows = std::array<const float*, 7>;

/// 1 where the gathers of q may stand for those of p, else 0: like normals, and each in the other's plane up to a tenth
/// of the distance. Pixels on an edge go with others that see both sides in like shares.
inline float likeness(const GuideRows& p, const GuideRows& q, int x) {
  const float px = p[3][x], py = p[4][x], pz = p[5][x], qx = q[3][x], qy = q[4][x], qz = q[5][x];
  const float dx = q[0][x] - p[0][x], dy = q[1][x] - p[1][x], dz = q[2][x] - p[2][x];
  const float offP = dx * px + dy * py + dz * pz, offQ = dx * qx + dy * qy + dz * qz;
  const float off = std::max(offP * offP, offQ * offQ), square = dx * dx + dy * dy + dz * dz;
  const float cosine = px * qx + py * qy + pz * qz;
  const float apart = (px - qx) * (px - qx) + (py - qy) * (py - qy) + (pz - qz) * (pz - qz);
  const float sharing = p[kSharing][x];
  const bool onSurface = (sharing == kSharesSurface) & (cosine >= kLikeNormal) & (off <= 0.01f * square);
  const bool onEdge = (sharing == kSharesMixture) & (apart < kLikeMixture * kLikeMixture);
  return (sharing == q[kSharing][x]) & (onSurface | onEdge) ? 1.0f : 0.0f;
}

/// Adds to the sums of the `count` pixels from p on the light of those from q on, where they are alike.
IMPORTON_VECTORS void addRow(const GuideRows& p, const GuideRows& q, const std::array<const float*, 12>& light,
                             int count, const std::array<float*, 12>& sums) {
  constexpr int kChunk = 256;
  std::array<float, kChunk> weights;
  for (int begin = 0; begin < count; begin += kChunk) {
    const int end = std::min(begin + kChunk, count);
    float* w = weights.data();
    for (int x = begin; x < end; ++x) w[x - begin] = likeness(p, q, x);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      float* __restrict to = sums[k] + begin;
      const float* __restrict from = light[k] + begin;
      for (int x = 0; x < end - begin; ++x) to[x] += w[x] * from[x];
    }
  }
}

struct Offset {
  int dx, dy;
};

/// Of the pixels that a disc of `radius` has more than one of `inner`, row by row.
std::vector<Offset> ringOf(int inner, int radius) {
  std::vector<Offset> ring;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const int square = dx * dx + dy * dy;
      if (square <= radius * radius && (inner < 0 || square > inner * inner)) ring.push_back({dx, dy});
    }
  return ring;
}

float mean(vec3 v) { return (v.x + v.y + v.z) / 3; }

struct Estimate {
  vec3 even, odd;  // irradiance of each half: indirect light over its modulation
};

vec3 ratio(vec3 a, vec3 b) {
  return {b.x > 0 ? a.x / b.x : 0.0f, b.y > 0 ? a.y / b.y : 0.0f, b.z > 0 ? a.z / b.z : 0.0f};
}

Estimate estimateOf(const LightPlanes& light, std::size_t i) {
  return {ratio(read(light, kEven, i), read(light, kEven + kModulation, i)),
          ratio(read(light, kOdd, i), read(light, kOdd + kModulation, i))};
}

/// How badly each half's estimate predicts the other half's own irradiance. Bounded, so that one very bright sample
/// does not choose the radius for a whole window.
float residual(const Estimate& estimate, const Estimate& own) {
  const vec3 a = estimate.even - own.odd, b = estimate.odd - own.even;
  const float size = glm::dot(estimate.even, estimate.even) + glm::dot(estimate.odd, estimate.odd);
  return std::min(glm::dot(a, a) + glm::dot(b, b), 8 * size);
}

/// Means of `values` over windows of (2 kRadiusWindow + 1)² pixels, row sums first.
Plane blur(const Plane& values, int width, int height, int threads) {
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  Plane rows(values.size()), out(values.size());
  parallelFor(static_cast<std::size_t>(height), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x)
        for (int q = std::max(x - kRadiusWindow, 0); q <= std::min(x + kRadiusWindow, width - 1); ++q)
          rows[at(x, y)] += values[at(q, y)];
  });
  parallelFor(static_cast<std::size_t>(height), 16, threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int q = std::max(y - kRadiusWindow, 0); q <= std::min(y + kRadiusWindow, height - 1); ++q)
        for (int x = 0; x < width; ++x) out[at(x, y)] += rows[at(x, q)];
  });
  return out;
}

/// A film to filter.
struct Halves {
  int width, height, threads;
  Guides guides;
  LightPlanes light;  // means over a pixel's paths
  Plane found;        // emitted, direct and caustic light: mean over halves and channels

  [[nodiscard]] std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// Whether a pixel shares its light over discs of a radius.
  [[nodiscard]] bool isShared(std::size_t i, int radius) const {
    const float sharing = guides[kSharing][i];
    return sharing == kSharesSurface || (sharing == kSharesMixture && radius <= kEdgeRadius);
  }
};

void readGuide(Guides& guides, std::size_t i, const FilmPixel& a, const FilmPixel& b) {
  if (a.gathers < 1 || b.gathers < 1) return;
  const float gathers = a.gathers + b.gathers;
  const vec3 normal = (a.normal + b.normal) / gathers;
  const float length = glm::length(normal);
  const bool isPure = length > kPurity;
  write(guides, kPosition, i, (a.position + b.position) / gathers);
  write(guides, kNormal, i, isPure ? normal / length : normal);
  guides[kSharing][i] = isPure ? kSharesSurface : kSharesMixture;
}

Halves readHalves(std::span<const FilmPixel> film, int width, const SampleCounts& counts, int threads) {
  const std::size_t pixels = film.size() / 2;
  Halves h{width, static_cast<int>(pixels) / width, threads, planesOf<7>(pixels), planesOf<12>(pixels), Plane(pixels)};
  parallelFor(pixels, 1u << 12, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const FilmPixel &even = film[i], &odd = film[pixels + i];
      readGuide(h.guides, i, even, odd);
      write(h.light, kEven, i, even.indirect / counts.even(i));
      write(h.light, kEven + kModulation, i, even.modulation / counts.even(i));
      write(h.light, kOdd, i, odd.indirect / counts.odd(i));
      write(h.light, kOdd + kModulation, i, odd.modulation / counts.odd(i));
      h.found[i] =
          0.5f * (mean(even.direct + even.caustic) / counts.even(i) + mean(odd.direct + odd.caustic) / counts.odd(i));
    }
  });
  return h;
}

/// Adds to the sums of row y the light of the pixels at an offset.
void addOffset(const Halves& h, int y, const Offset& o, LightPlanes& sums) {
  const int first = std::max(0, -o.dx), count = h.width - std::abs(o.dx);
  if (y + o.dy < 0 || y + o.dy >= h.height || count <= 0) return;
  const std::size_t to = h.at(first, y), from = h.at(first + o.dx, y + o.dy);
  addRow(rowsAt<7>(h.guides, to), rowsAt<7>(h.guides, from), rowsAt<12>(h.light, from), count, rowsAt<12>(sums, to));
}

/// Weights of squared errors of irradiance, as relMSE weighs those of radiance. For them each pixel's irradiance is
/// taken to be that of a small disc.
Plane weighErrors(const Halves& h) {
  const std::vector<Offset> disc = ringOf(-1, kGuessRadius);
  Plane weights(h.found.size()), image(h.found.size());
  LightPlanes sums = planesOf<12>(h.found.size());
  parallelFor(static_cast<std::size_t>(h.height), 4, h.threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (const Offset& o : disc) addOffset(h, y, o, sums);
      for (std::size_t i = h.at(0, y); i < h.at(0, y + 1); ++i) {
        const Estimate irradiance = estimateOf(sums, i);
        const float modulation =
            0.5f * mean(read(h.light, kEven + kModulation, i) + read(h.light, kOdd + kModulation, i));
        image[i] = h.found[i] + 0.5f * mean(irradiance.even + irradiance.odd) * modulation;
        weights[i] = modulation * modulation;
      }
    }
  });
  const double whole = std::accumulate(image.begin(), image.end(), 0.0) / static_cast<double>(image.size());
  const float least = std::max(static_cast<float>(0.01 * whole * whole), std::numeric_limits<float>::min());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] /= image[i] * image[i] + least;
  return weights;
}

/// Adds a ring to the sums over discs. Returns how badly those predict the other half around each pixel.
Plane growDiscs(const Halves& h, const std::vector<Offset>& ring, int radius, const Plane& weights, LightPlanes& sums) {
  Plane residuals(sums[0].size());
  parallelFor(static_cast<std::size_t>(h.height), 4, h.threads, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (const Offset& o : ring) addOffset(h, y, o, sums);
      for (std::size_t i = h.at(0, y); i < h.at(0, y + 1); ++i)
        if (h.isShared(i, radius)) residuals[i] = weights[i] * residual(estimateOf(sums, i), estimateOf(h.light, i));
    }
  });
  return blur(residuals, h.width, h.height, h.threads);
}

}  // namespace

FilteredIndirect filterIndirect(std::span<const FilmPixel> film, int width, const SampleCounts& counts, int threads) {
  const std::size_t pixels = film.size() / 2;
  const Halves h = readHalves(film, width, counts, threads);
  const Plane weights = weighErrors(h);
  const float evenShare = counts.evenShare();
  LightPlanes sums = planesOf<12>(pixels);
  Plane best(pixels);
  FilteredIndirect result{std::vector<vec3>(pixels), std::vector<vec3>(pixels)};
  int inner = -1;
  for (const int radius : kRadii) {
    const Plane around = growDiscs(h, ringOf(inner, radius), radius, weights, sums);
    inner = radius;
    parallelFor(pixels, 1u << 12, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (radius == 0) {
          result.even[i] = read(h.light, kEven, i);
          result.odd[i] = read(h.light, kOdd, i);
          best[i] = around[i];
        } else if (h.isShared(i, radius) && around[i] < best[i]) {
          best[i] = around[i];
          const vec3 modulation = read(h.light, kEven + kModulation, i) * evenShare +
                                  read(h.light, kOdd + kModulation, i) * (1 - evenShare);
          const Estimate estimate = estimateOf(sums, i);
          result.even[i] = modulation * estimate.even;
          result.odd[i] = modulation * estimate.odd;
        }
      }
    });
  }
  return result;
}

}  // namespace importon
