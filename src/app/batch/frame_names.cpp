#include "app/batch/frame_names.h"

#include <optional>
#include <string>

#include "base/error.h"
#include "fmt/format.h"

namespace importon {
namespace {

namespace fs = std::filesystem;

/// What stands at a % of a pattern.
struct Place {
  std::size_t length = 0;        // of it, in the pattern
  std::optional<int> width = 0;  // of the number; none: a percent sign
};

/// None: nothing that a name may have.
std::optional<Place> placeAt(const std::string& pattern, std::size_t at) {
  constexpr std::size_t kMostDigits = 2;
  const std::string rest = pattern.substr(at + 1);
  if (rest.starts_with('%')) return Place{2, std::nullopt};
  const std::size_t digits = rest.find_first_not_of("0123456789");
  if (digits == std::string::npos || rest[digits] != 'd' || digits > kMostDigits) return std::nullopt;
  if (digits == 0) return Place{2, 0};
  if (rest[0] != '0' || digits == 1) return std::nullopt;  // blanks before the number are not for names
  return Place{digits + 2, rest[1] - '0'};
}

/// Calls `visit` with each place and where it is; of one that is none with an empty place.
template <class Visit>
void visitPlaces(const std::string& pattern, const Visit& visit) {
  for (std::size_t at = pattern.find('%'); at != std::string::npos; at = pattern.find('%', at)) {
    const std::optional<Place> place = placeAt(pattern, at);
    visit(place, at);
    at += place ? place->length : 1;
  }
}

[[noreturn]] void refuse(const char* option, const std::string& what, const fs::path& pattern) {
  throw UsageError(fmt::format("{} {}", option, what), pattern.string(),
                   "give one number in the file's name, as in NAME.%04d.exr; %% stands for %");
}

}  // namespace

bool hasFrameNumber(const fs::path& pattern) {
  bool hasNumber = false;
  visitPlaces(pattern.filename().string(),
              [&](const std::optional<Place>& place, std::size_t) { hasNumber |= place && place->width; });
  return hasNumber;
}

void checkFramePattern(const char* option, const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  int numbers = 0;
  visitPlaces(name, [&](const std::optional<Place>& place, std::size_t at) {
    if (!place) refuse(option, fmt::format("has \"{}\", which is no number of frames", name.substr(at, 2)), pattern);
    numbers += place->width ? 1 : 0;
  });
  if (numbers == 0) refuse(option, "names one file for all frames", pattern);
  if (numbers > 1) refuse(option, "has a place for more than one number", pattern);
  const std::string folder = pattern.parent_path().string();
  visitPlaces(folder, [&](const std::optional<Place>& place, std::size_t) {
    if (place && place->width) refuse(option, "has a number in the name of its folder", pattern);
  });
}

fs::path frameName(const fs::path& pattern, std::int64_t frame) {
  const std::string name = pattern.filename().string();
  std::string filled;
  std::size_t done = 0;
  visitPlaces(name, [&](const std::optional<Place>& place, std::size_t at) {
    filled += name.substr(done, at - done);
    filled += place && place->width ? fmt::format("{:0{}}", frame, *place->width) : std::string("%");
    done = at + (place ? place->length : 1);
  });
  return pattern.parent_path() / (filled + name.substr(done));
}

}  // namespace importon
