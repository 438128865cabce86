#include "render/filter/surface_smoother.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "render/filter/vectors.h"

namespace importon {
namespace {

constexpr float kLikeNormal = 0.9f;
constexpr float kAllGather = 0.999f;   // the share of paths that gather where all do
constexpr float kLikeGlass = 0.09f;    // squared share of the distance that glass may curve
constexpr float kPurity = 0.98f;       // length of the mean normal below which a pixel sees several surfaces
constexpr float kLikeMixture = 0.15f;  // distance of mean normals below which two such pixels see them alike
constexpr float kSamePlace = 1e-4f;    // share of the distance from the origin that rounded means may differ
constexpr int kAround = 3;             // pixels around one that tell whether paths part behind what it looks through
constexpr float kPartedShare = 0.15f;  // of these
constexpr int kEdgeLevels = 2;         // up to which edges share with edges
constexpr std::size_t kRows = 8;       // that one thread takes at once

constexpr std::array kSteps{-2, -1, 1, 2};
constexpr float kMiddle = 6.0f / 16;
constexpr std::array kWeights{1.0f / 16, 4.0f / 16, 4.0f / 16, 1.0f / 16};

void write(Planes& planes, std::size_t i, vec3 v) {
  for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)][i] = v[c];
}

using GuideRows = std::array<const float*, 9>;

GuideRows rowsAt(const SurfaceGuides& guides, std::size_t i) {
  GuideRows rows;
  for (std::size_t c = 0; c < 3; ++c) {
    rows[c] = guides.position[c].data() + i;
    rows[3 + c] = guides.normal[c].data() + i;
    rows[6 + c] = guides.plane[c].data() + i;
  }
  return rows;
}

inline std::uint8_t likeness(const GuideRows& p, const GuideRows& q, int x, PixelKind kindP, PixelKind kindQ) {
  const float px = p[3][x], py = p[4][x], pz = p[5][x], qx = q[3][x], qy = q[4][x], qz = q[5][x];
  const float dx = q[0][x] - p[0][x], dy = q[1][x] - p[1][x], dz = q[2][x] - p[2][x];
  const float offP = dx * p[6][x] + dy * p[7][x] + dz * p[8][x], offQ = dx * q[6][x] + dy * q[7][x] + dz * q[8][x];
  const float off = std::max(offP * offP, offQ * offQ), square = dx * dx + dy * dy + dz * dz;
  const float cosine = px * qx + py * qy + pz * qz;
  const float apart = (px - qx) * (px - qx) + (py - qy) * (py - qy) + (pz - qz) * (pz - qz);
  const bool onSurface = (kindP == PixelKind::surface) & (cosine >= kLikeNormal) & (off <= 0.01f * square);
  const bool onGlass = (kindP == PixelKind::glass) & (cosine >= kLikeNormal) & (off <= kLikeGlass * square);
  const bool onEdge = (kindP == PixelKind::edge) & (apart < kLikeMixture * kLikeMixture);
  return static_cast<std::uint8_t>((kindP == kindQ) & (onSurface | onGlass | onEdge));
}

/// Sets bit `bit` of `alike` where the pixels of a row at p and q are.
IMPORTON_VECTORS void compareRow(const GuideRows& p, const GuideRows& q, const PixelKind* kindP, const PixelKind* kindQ,
                                 int count, int bit, std::uint8_t* alike) {
  for (int x = 0; x < count; ++x)
    alike[x] = static_cast<std::uint8_t>(alike[x] | likeness(p, q, x, kindP[x], kindQ[x]) << bit);
}

struct RowWeights {
  std::array<Plane, 4> of;  // the neighbours at kSteps
  Plane middle;

  explicit RowWeights(std::size_t width) : middle(width) { of.fill(Plane(width)); }
};

/// From four bits of `alike` per pixel, from `bit` on. The weights of a pixel come to 1.
IMPORTON_VECTORS void weighRow(const std::uint8_t* alike, int bit, int count, float* const* of, float* middle) {
  for (int x = 0; x < count; ++x) {
    const int bits = alike[x] >> bit;
    float w[4];
    for (int k = 0; k < 4; ++k) w[k] = (bits >> k & 1) != 0 ? kWeights[static_cast<std::size_t>(k)] : 0.0f;
    const float scale = 1 / (kMiddle + w[0] + w[1] + w[2] + w[3]);
    for (int k = 0; k < 4; ++k) of[k][x] = w[k] * scale;
    middle[x] = kMiddle * scale;
  }
}

IMPORTON_VECTORS void setRow(const float* weights, const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] = weights[x] * from[x];
}

IMPORTON_VECTORS void addRow(const float* weights, const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) to[x] += weights[x] * from[x];
}

/// Details that are independent in the mean over three levels where all pixels are alike: the area of its Gaussian over
/// that of a detail's autocorrelation.
constexpr double kAllDetails = 43;

/// By the bits of like neighbours, how many times more of them a level adds to a mean. Where none are alike it adds
/// none; along a line it adds the root of what it adds on a surface.
std::array<float, 256> makeDetailFactors() {
  std::array<float, 256> factors;
  const auto squares = [](unsigned bits) {  // sum of squared weights along an axis
    double sum = kMiddle, square = kMiddle * kMiddle;
    for (std::size_t k = 0; k < kWeights.size(); ++k)
      if ((bits >> k & 1u) != 0) sum += kWeights[k], square += kWeights[k] * kWeights[k];
    return square / (sum * sum);
  };
  const double power = std::log(kAllDetails) / (6 * std::log(squares(15)));
  for (unsigned bits = 0; bits < factors.size(); ++bits)
    factors[bits] = static_cast<float>(std::pow(squares(bits & 15u) * squares(bits >> 4), power));
  return factors;
}

}  // namespace

bool SurfaceGuides::areAlike(std::size_t p, std::size_t q) const {
  return likeness(rowsAt(*this, p), rowsAt(*this, q), 0, kind[p], kind[q]) != 0;
}

namespace {

/// Means over the gathers of both halves.
struct Seen {
  bool hasGathers = false;
  vec3 position{0}, normal{0}, sharedPosition{0}, sharedNormal{0};

  Seen(const FilmPixel& a, const FilmPixel& b) : hasGathers(a.gathers >= 1 && b.gathers >= 1) {
    if (!hasGathers) return;
    const float gathers = a.gathers + b.gathers;
    position = (a.position + b.position) / gathers;
    normal = (a.normal + b.normal) / gathers;
    sharedPosition = (a.sharedPosition + b.sharedPosition) / gathers;
    sharedNormal = (a.sharedNormal + b.sharedNormal) / gathers;
  }
  [[nodiscard]] bool isOneSurface() const { return glm::length(normal) > kPurity; }
  [[nodiscard]] bool isOneShared() const { return glm::length(sharedNormal) > kPurity; }
  [[nodiscard]] bool isDirect() const {
    return glm::distance(sharedPosition, position) <=
           kSamePlace * (glm::length(sharedPosition) + glm::length(position));
  }
  /// Whether the camera looks through glass.
  [[nodiscard]] bool isThrough() const { return hasGathers && isOneShared() && !isDirect(); }
};

void set(SurfaceGuides& guides, std::size_t i, PixelKind kind, vec3 position, vec3 normal, vec3 plane) {
  guides.kind[i] = kind;
  write(guides.position, i, position);
  write(guides.normal, i, normal);
  write(guides.plane, i, plane);
}

/// `looksThrough`: paths behind the surface that the camera sees part, here or in many pixels around.
void readGuide(const Seen& seen, bool looksThrough, std::size_t i, SurfaceGuides& guides) {
  if (!seen.hasGathers) return;
  if (looksThrough) {
    const vec3 normal = glm::normalize(seen.sharedNormal);
    set(guides, i, PixelKind::glass, seen.sharedPosition, normal, normal);
  } else if (seen.isOneSurface()) {
    const bool knowsPlane = seen.isDirect() && seen.isOneShared();
    set(guides, i, PixelKind::surface, seen.position, glm::normalize(seen.normal),
        glm::normalize(knowsPlane ? seen.sharedNormal : seen.normal));
  } else {
    set(guides, i, PixelKind::edge, seen.position, seen.normal, seen.normal);
  }
}

/// Whether none of a pixel's paths sees an emitter or the background behind what it looks through.
bool doAllGather(std::span<const FilmPixel> halves, const SampleCounts& counts, std::size_t pixel) {
  const float gathers = halves[pixel].gathers + halves[halves.size() / 2 + pixel].gathers;
  return gathers >= kAllGather * (counts.even(pixel) + counts.odd(pixel));
}

/// Whether so many of the pixels around that look through something see several surfaces that this one's paths part,
/// too, if only there were more of them.
bool doPathsPart(std::span<const std::uint8_t> through, const SurfaceGuides& guides, int x, int y) {
  int parted = 0, all = 0;
  for (int qy = std::max(y - kAround, 0); qy <= std::min(y + kAround, guides.height - 1); ++qy)
    for (int qx = std::max(x - kAround, 0); qx <= std::min(x + kAround, guides.width - 1); ++qx) {
      const std::uint8_t is = through[guides.at(qx, qy)];
      all += is != 0;
      parted += is == 2;
    }
  return static_cast<float>(parted) > kPartedShare * static_cast<float>(all);
}

}  // namespace

SurfaceGuides readGuides(std::span<const FilmPixel> halves, int width, const SampleCounts& counts, int threads) {
  const std::size_t pixels = halves.size() / 2;
  SurfaceGuides guides{width,
                       static_cast<int>(pixels) / width,
                       planesOf(pixels),
                       planesOf(pixels),
                       planesOf(pixels),
                       std::vector<PixelKind>(pixels)};
  std::vector<std::uint8_t> through(pixels);  // 1: looks through something at one surface, 2: at more
  const auto forRows = [&](const auto& body) {
    parallelFor(static_cast<std::size_t>(guides.height), kRows, threads, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        for (int x = 0; x < width; ++x) {
          const std::size_t i = guides.at(x, y);
          body(x, y, i, Seen(halves[i], halves[pixels + i]));
        }
    });
  };
  forRows([&](int, int, std::size_t i, const Seen& seen) {
    through[i] = seen.isThrough() ? (seen.isOneSurface() && doAllGather(halves, counts, i) ? 1 : 2) : 0;
  });
  forRows([&](int x, int y, std::size_t i, const Seen& seen) {
    readGuide(seen, through[i] != 0 && doPathsPart(through, guides, x, y), i, guides);
  });
  return guides;
}

SurfaceSmoother::SurfaceSmoother(const SurfaceGuides& guides, int levels, int threads)
    : guides_(guides), threads_(threads) {
  const std::size_t width = static_cast<std::size_t>(guides.width), height = static_cast<std::size_t>(guides.height);
  alike_.resize(static_cast<std::size_t>(levels));
  for (int level = 0; level < levels; ++level) {
    std::vector<std::uint8_t>& alike = alike_[static_cast<std::size_t>(level)];
    alike.resize(width * height);
    parallelFor(height, kRows, threads, [&](std::size_t begin, std::size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        for (std::size_t k = 0; k < kSteps.size(); ++k) {
          const int offset = kSteps[k] * (1 << level), count = guides.width - std::abs(offset);
          const auto compare = [&](int first, int otherX, int otherY, int length, int bit) {
            const std::size_t p = guides.at(first, y), q = guides.at(otherX, otherY);
            compareRow(rowsAt(guides, p), rowsAt(guides, q), &guides.kind[p], &guides.kind[q], length, bit, &alike[p]);
          };
          const int first = std::max(0, -offset);
          if (count > 0) compare(first, first + offset, y, count, static_cast<int>(k));
          if (y + offset >= 0 && y + offset < guides.height)
            compare(0, 0, y + offset, guides.width, 4 + static_cast<int>(k));
        }
    });
    if (level < kEdgeLevels) continue;
    for (std::size_t i = 0; i < alike.size(); ++i)
      if (guides.kind[i] == PixelKind::edge) alike[i] = 0;
  }
}

float SurfaceSmoother::independentIn(std::size_t pixel, int level) const {
  static const std::array<float, 256> kFactors = makeDetailFactors();
  float count = 1;
  for (int k = level; k < level + 3; ++k) count *= kFactors[alike_[static_cast<std::size_t>(k)][pixel]];
  return count;
}

void SurfaceSmoother::smooth(std::span<Plane* const> planes, int level) {
  smoothAlong(true, planes, level);
  smoothAlong(false, planes, level);
}

void SurfaceSmoother::smoothAlong(bool isX, std::span<Plane* const> planes, int level) {
  while (spare_.size() < planes.size()) spare_.emplace_back(guides_.kind.size());
  const std::vector<std::uint8_t>& alike = alike_[static_cast<std::size_t>(level)];
  const int width = guides_.width;
  parallelFor(static_cast<std::size_t>(guides_.height), kRows, threads_, [&](std::size_t begin, std::size_t end) {
    RowWeights weights(static_cast<std::size_t>(width));
    std::array<float*, 4> of;
    std::transform(weights.of.begin(), weights.of.end(), of.begin(), [](Plane& plane) { return plane.data(); });
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      const std::size_t row = guides_.at(0, y);
      weighRow(&alike[row], isX ? 0 : 4, width, of.data(), weights.middle.data());
      for (std::size_t p = 0; p < planes.size(); ++p) {
        const Plane& from = *planes[p];
        float* to = &spare_[p][row];
        setRow(weights.middle.data(), &from[row], width, to);
        for (std::size_t k = 0; k < kSteps.size(); ++k) {
          const int offset = kSteps[k] * (1 << level);
          if (isX) {
            const int first = std::max(0, -offset), count = width - std::abs(offset);
            if (count > 0) addRow(of[k] + first, &from[guides_.at(first + offset, y)], count, to + first);
          } else if (y + offset >= 0 && y + offset < guides_.height) {
            addRow(of[k], &from[guides_.at(0, y + offset)], width, to);
          }
        }
      }
    }
  });
  for (std::size_t p = 0; p < planes.size(); ++p) planes[p]->swap(spare_[p]);
}

}  // namespace importon
