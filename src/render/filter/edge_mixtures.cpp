#include "render/filter/edge_mixtures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "render/filter/half_statistics.h"

namespace importon {
namespace {

constexpr int kReach = 3;             // pixels to the surfaces beside an edge
constexpr std::size_t kMostNear = 5;  // that are looked at
constexpr float kUnexplained = 0.5f;  // of the mean normal, at most
constexpr float kDisplaced = 0.05f;  // of the mean position of a pixel that seems to see one surface, in units of Trait
constexpr int kWindow = 12;          // half the side of the window along an edge that tells what is significant, pixels

vec3 at(const Planes& planes, std::size_t i) { return {planes[0][i], planes[1][i], planes[2][i]}; }

/// Up to three surfaces that a pixel sees.
struct Mixture {
  std::size_t count = 0;
  std::array<std::size_t, 3> surface{};                        // among those near it
  std::array<float, 3> share{};                                // of the pixel; come to 1
  float unexplained = std::numeric_limits<float>::infinity();  // of the mean normal
  float displaced = 0;                                         // of the mean position
};

/// Offsets of pixels within kReach, the nearest first.
const std::vector<std::array<int, 2>>& offsetsNearby() {
  static const std::vector<std::array<int, 2>> kOffsets = [] {
    std::vector<std::array<int, 2>> list;
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx)
        if (dx != 0 || dy != 0) list.push_back({dx, dy});
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
      return a[0] * a[0] + a[1] * a[1] < b[0] * b[0] + b[1] * b[1];
    });
    return list;
  }();
  return kOffsets;
}

/// The nearest pixel of each surface beside (x, y).
std::vector<std::size_t> surfacesNear(const SurfaceSmoother& smoother, int x, int y) {
  const SurfaceGuides& guides = smoother.guides();
  std::vector<std::size_t> near;
  for (const auto& [dx, dy] : offsetsNearby()) {
    const int qx = x + dx, qy = y + dy;
    if (qx < 0 || qy < 0 || qx >= guides.width || qy >= guides.height) continue;
    const std::size_t q = guides.at(qx, qy);
    if (guides.kind[q] != PixelKind::surface || smoother.isAlone(q)) continue;
    if (std::any_of(near.begin(), near.end(), [&](std::size_t known) { return guides.areAlike(known, q); })) continue;
    near.push_back(q);
    if (near.size() == kMostNear) break;
  }
  return near;
}

/// Normal, and position in units of `scale`: what is mean over a mixture.
struct Trait {
  vec3 normal, position;

  Trait operator-(const Trait& t) const { return {normal - t.normal, position - t.position}; }
  [[nodiscard]] float dot(const Trait& t) const { return glm::dot(normal, t.normal) + glm::dot(position, t.position); }
};

/// The shares of two or three surfaces in a pixel of mean `here`, by least squares.
Mixture mixtureOf(std::span<const std::size_t> surfaces, const std::vector<Trait>& of, const Trait& here) {
  Mixture m;
  m.count = surfaces.size();
  std::copy(surfaces.begin(), surfaces.end(), m.surface.begin());
  const Trait last = of[surfaces.back()], a = of[surfaces[0]] - last, t = here - last;
  if (m.count == 2) {
    m.share[0] = std::clamp(t.dot(a) / std::max(a.dot(a), 1e-20f), 0.0f, 1.0f);
    m.share[1] = 1 - m.share[0];
  } else {
    const Trait b = of[surfaces[1]] - last;
    const float aa = a.dot(a), ab = a.dot(b), bb = b.dot(b), at = a.dot(t), bt = b.dot(t);
    const float determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-4f * aa * bb)) return m;
    m.share[0] = std::max((at * bb - bt * ab) / determinant, 0.0f);
    m.share[1] = std::max((bt * aa - at * ab) / determinant, 0.0f);
    m.share[2] = std::max(1 - m.share[0] - m.share[1], 0.0f);
    const float sum = m.share[0] + m.share[1] + m.share[2];
    for (float& share : m.share) share /= sum;
  }
  Trait mean{vec3(0), vec3(0)};
  for (std::size_t k = 0; k < m.count; ++k) {
    mean.normal += m.share[k] * of[surfaces[k]].normal;
    mean.position += m.share[k] * of[surfaces[k]].position;
  }
  m.unexplained = glm::length(mean.normal - here.normal);
  m.displaced = glm::length(mean.position - here.position);
  return m;
}

/// That of the fewest surfaces among `near` that explains the pixel; else none. Names pixels instead of their numbers
/// among `near`.
std::optional<Mixture> mixtureAt(const SurfaceSmoother& smoother, int x, int y) {
  const SurfaceGuides& guides = smoother.guides();
  const std::vector<std::size_t> near = surfacesNear(smoother, x, y);
  const std::size_t pixel = guides.at(x, y);
  const vec3 position = at(guides.position, pixel);
  // Positions on a surface differ by the pixels between: they count where normals say nothing.
  float nearest = std::numeric_limits<float>::infinity();
  for (const std::size_t q : near) nearest = std::min(nearest, glm::distance(at(guides.position, q), position));
  const float scale = 1 / std::max(40 * nearest, std::numeric_limits<float>::min());
  std::vector<Trait> of;
  for (const std::size_t q : near) of.push_back({at(guides.normal, q), (at(guides.position, q) - position) * scale});
  const Trait here{at(guides.normal, pixel), vec3(0)};
  Mixture best;
  const auto consider = [&](std::initializer_list<std::size_t> surfaces) {
    const Mixture m = mixtureOf({surfaces.begin(), surfaces.size()}, of, here);
    const bool isPossible =
        m.unexplained <= kUnexplained && (guides.kind[pixel] == PixelKind::edge || m.displaced <= kDisplaced);
    if (isPossible && m.unexplained < best.unexplained) best = m;
  };
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t j = i + 1; j < near.size(); ++j) consider({i, j});
  for (std::size_t i = 0; best.count == 0 && i < near.size(); ++i)
    for (std::size_t j = i + 1; j < near.size(); ++j)
      for (std::size_t k = j + 1; k < near.size(); ++k) consider({i, j, k});
  if (best.count == 0) return {};
  for (std::size_t k = 0; k < best.count; ++k) best.surface[k] = near[best.surface[k]];
  return best;
}

/// Pixels on an edge; also those that seem to see one surface, but such that none beside them is like it: between
/// parallel ones.
bool seesSeveral(const SurfaceSmoother& smoother, std::size_t i) {
  const PixelKind kind = smoother.guides().kind[i];
  return kind == PixelKind::edge || (kind == PixelKind::surface && smoother.isAlone(i));
}

}  // namespace

void mixEdges(const SurfaceSmoother& smoother, const Planes& modulation, const Halves& raw, float evenShare,
              float leastSquare, Halves& shown) {
  const SurfaceGuides& guides = smoother.guides();
  const std::size_t pixels = guides.kind.size();
  Halves mixed(pixels);
  std::vector<std::uint8_t> isMixed(pixels);
  HalfStatistics each(pixels), around(pixels);
  const auto forEdges = [&](const auto& body) {
    parallelFor(static_cast<std::size_t>(guides.height), 4, smoother.threads(),
                [&](std::size_t begin, std::size_t end) {
                  for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                    for (int x = 0; x < guides.width; ++x)
                      if (seesSeveral(smoother, guides.at(x, y))) body(x, y, guides.at(x, y));
                });
  };
  forEdges([&](int x, int y, std::size_t i) {
    const std::optional<Mixture> m = mixtureAt(smoother, x, y);
    if (!m) return;
    float size = 0, both = 0, apart = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      float even = 0, odd = 0, weight = 0;
      for (std::size_t k = 0; k < m->count; ++k) {
        const std::size_t q = m->surface[k];
        const float w = m->share[k] * modulation[c][q];
        even += w * shown.planes[kEven + c][q];
        odd += w * shown.planes[kOdd + c][q];
        weight += w;
      }
      if (!(weight > 0)) continue;
      mixed.planes[kEven + c][i] = even / weight;
      mixed.planes[kOdd + c][i] = odd / weight;
      const float a = raw.planes[kEven + c][i] - even / weight, b = raw.planes[kOdd + c][i] - odd / weight;
      both += a * b;
      apart += (a - b) * (a - b);
      size += (even + odd) / weight;
    }
    isMixed[i] = 1;
    if (!(size > 0)) return;  // none of the surfaces reflects
    const float importance = importanceOf(size, leastSquare);
    each.set(i, importance * both, importance * apart);
  });
  forEdges([&](int x, int y, std::size_t i) {
    if (isMixed[i] == 0) return;
    std::array<float, 3> sums{};
    float count = 0;
    for (int qy = std::max(y - kWindow, 0); qy <= std::min(y + kWindow, guides.height - 1); ++qy)
      for (int qx = std::max(x - kWindow, 0); qx <= std::min(x + kWindow, guides.width - 1); ++qx) {
        const std::size_t q = guides.at(qx, qy);
        if (isMixed[q] == 0) continue;
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += (*each.planes()[k])[q];
        ++count;
      }
    for (std::size_t k = 0; k < sums.size(); ++k) (*around.planes()[k])[i] = sums[k] / count;
    const float gain = around.shareOfLight(i, count, evenShare);
    for (std::size_t c = 0; c < 6; ++c)
      shown.planes[c][i] = mixed.planes[c][i] + gain * (raw.planes[c][i] - mixed.planes[c][i]);
  });
}

}  // namespace importon
