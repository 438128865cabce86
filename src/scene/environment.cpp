#include "scene/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "base/error.h"
#include "scene/light_math.h"

namespace importon {
namespace {

double lightAt(const EnvironmentMap& map, int x, int y) {
  const int column = (x + map.width) % map.width, row = std::clamp(y, 0, map.height - 1);
  return meanOf(map.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                           static_cast<std::size_t>(column)]);
}

/// Light of a texel and of its neighbours, as much as interpolation brings into it.
double blurredLight(const EnvironmentMap& map, int x, int y) {
  constexpr double kWeights[] = {0.125, 0.75, 0.125};
  double sum = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) sum += kWeights[dx + 1] * kWeights[dy + 1] * lightAt(map, x + dx, y + dy);
  return sum;
}

}  // namespace

glm::dvec3 environmentDirection(double x, double y) {
  const double longitude = 2 * kPi * (x - 0.5), latitude = kPi * y;
  return {std::sin(latitude) * std::sin(longitude), std::cos(latitude), -std::sin(latitude) * std::cos(longitude)};
}

double texelSolidAngle(const EnvironmentMap& map, int row) {
  const double top = std::cos(kPi * row / map.height), bottom = std::cos(kPi * (row + 1) / map.height);
  return 2 * kPi / map.width * (top - bottom);
}

vec3 meanRadiance(const EnvironmentMap& map) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < map.height; ++y) {
    glm::dvec3 row(0.0);
    for (int x = 0; x < map.width; ++x)
      row += glm::dvec3(
          map.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x)]);
    sum += row * texelSolidAngle(map, y);
  }
  return vec3(sum / (4 * kPi));
}

std::vector<DrawnEntry> inversionTable(std::span<const double> weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const std::size_t n = weights.size();
  std::vector<DrawnEntry> table(n);
  double before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    before += weights[i];
    table[i].end = static_cast<float>(before / sum);
  }
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (at + 1 < n && !(static_cast<double>(table[at].end) * static_cast<double>(n) > static_cast<double>(i))) ++at;
    table[i].first = at;
  }
  return table;
}

EnvironmentDraw drawByLight(const EnvironmentMap& map) {
  const auto width = static_cast<std::size_t>(map.width), height = static_cast<std::size_t>(map.height);
  std::vector<double> light(width * height), rows(height);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      light[y * width + x] = blurredLight(map, static_cast<int>(x), static_cast<int>(y));
      rows[y] += light[y * width + x] * texelSolidAngle(map, static_cast<int>(y));
    }
  }
  if (std::ranges::all_of(rows, [](double row) { return row == 0; })) {
    std::ranges::fill(light, 1.0);
    for (std::size_t y = 0; y < height; ++y) rows[y] = texelSolidAngle(map, static_cast<int>(y));
  }
  const std::vector<double> even(width, 1.0);
  EnvironmentDraw draw{inversionTable(rows), {}};
  // As the tables have it after rounding, so that what is drawn has this density exactly.
  const auto shareOf = [](std::span<const DrawnEntry> table, std::size_t i) {
    return static_cast<double>(table[i].end) - (i > 0 ? static_cast<double>(table[i - 1].end) : 0.0);
  };
  for (std::size_t y = 0; y < height; ++y) {
    const std::span<const double> row = std::span(light).subspan(y * width, width);
    const bool isDrawn = rows[y] > 0;
    const std::vector<DrawnEntry> columns = inversionTable(isDrawn ? row : even);
    const double share = shareOf(draw.entries, y) / texelSolidAngle(map, static_cast<int>(y));
    for (std::size_t x = 0; x < width; ++x)
      draw.densities.push_back(static_cast<float>(isDrawn ? share * shareOf(columns, x) : 0.0));
    draw.entries.insert(draw.entries.end(), columns.begin(), columns.end());
  }
  return draw;
}

EnvironmentMap turned(const EnvironmentMap& map, double degrees) {
  const double shift = std::fmod(degrees, 360) / 360 * map.width;  // columns to the left
  const auto whole = static_cast<int>(std::floor(shift));
  const auto rest = static_cast<float>(shift - whole);
  EnvironmentMap result = map;
  for (int y = 0; y < map.height; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
    const auto at = [&](int x) { return map.texels[row + static_cast<std::size_t>((x + 2 * map.width) % map.width)]; };
    for (int x = 0; x < map.width; ++x)
      result.texels[row + static_cast<std::size_t>(x)] =
          rest > 0 ? glm::mix(at(x + whole), at(x + whole + 1), rest) : at(x + whole);
  }
  return result;
}

void checkEnvironment(const EnvironmentMap& map, const std::string& where) {
  const auto fail = [&](const char* what) { throw SceneError(what, where, "give a lat-long image of radiance"); };
  if (map.width < 1 || map.height < 1) fail("the environment map is empty");
  if (map.texels.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height))
    fail("the environment map is not whole");
  for (const vec3& texel : map.texels)
    for (int c = 0; c < 3; ++c)
      if (!(texel[c] >= 0.0f && static_cast<double>(texel[c]) <= kBrightestEnvironment))
        fail("the environment map has a value that is negative, not finite or too large");
}

}  // namespace importon
