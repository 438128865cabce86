#include "io/image_part.h"

#include <algorithm>

#include "base/error.h"

namespace importon {
namespace {

WholeImage wholeOf(const Image& image) {
  return image.whole.width > 0 ? image.whole : WholeImage{image.width, image.height, 0, 0};
}

/// The pixels from `begin` to before `end` that two lines have, by where they begin and how long they are.
struct SharedRange {
  int begin, length;
};

SharedRange shared(int beginA, int lengthA, int beginB, int lengthB) {
  const int begin = std::max(beginA, beginB);
  return {begin, std::min(beginA + lengthA, beginB + lengthB) - begin};
}

std::vector<float> cutRows(const Channel& channel, int stride, int x, int y, int width, int height) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = y; row < y + height; ++row) {
    const auto begin = channel.values.begin() + std::ptrdiff_t{row} * stride + x;
    values.insert(values.end(), begin, begin + width);
  }
  return values;
}

}  // namespace

std::optional<Image> cutOut(const Image& image, int x, int y, int width, int height) {
  const WholeImage whole = wholeOf(image);
  const int left = x - whole.x, top = y - whole.y;
  if (left < 0 || top < 0 || left > image.width - width || top > image.height - height) return std::nullopt;
  if (width == image.width && height == image.height) return image;
  Image part{width, height, {}, image.attributes, {whole.width, whole.height, x, y}, image.matrices};
  for (const Channel& channel : image.channels)
    part.channels.push_back({channel.name, cutRows(channel, image.width, left, top, width, height), channel.isHalf});
  return part;
}

void cutToShared(Image& a, Image& b, const std::string& where) {
  const WholeImage wholeA = wholeOf(a), wholeB = wholeOf(b);
  if (wholeA.width != wholeB.width || wholeA.height != wholeB.height) return;
  const SharedRange columns = shared(wholeA.x, a.width, wholeB.x, b.width);
  const SharedRange rows = shared(wholeA.y, a.height, wholeB.y, b.height);
  if (columns.length <= 0 || rows.length <= 0)
    throw SceneError("the images are parts that share no pixel", where, "render parts that overlap, or all");
  for (Image* const image : {&a, &b}) *image = *cutOut(*image, columns.begin, rows.begin, columns.length, rows.length);
}

}  // namespace importon
