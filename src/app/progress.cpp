#include "app/progress.h"

#include <cmath>

#include "fmt/format.h"

namespace importon {
namespace {

/// "950", "1.23 k", "45.6 M", "789 G": three digits.
std::string threeDigits(double value) {
  const char* prefix = "";
  for (const char* next : {"k", "M", "G", "T"}) {
    if (value < 999.5) break;
    value /= 1000;
    prefix = next;
  }
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}", value, decimals, prefix);
}

/// "7 s", "3 min 05 s", "2 h 04 min".
std::string duration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

/// "6.2 %": two digits.
std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

}  // namespace

std::string progressLine(const RenderProgress& progress) {
  std::string line = fmt::format("pass {}", progress.pass);
  if (progress.passes > 0) line += fmt::format("/{}", progress.passes);
  line += "  " + duration(progress.seconds);
  if (progress.photonsPerSecond > 0) line += fmt::format("  {}photons/s", threeDigits(progress.photonsPerSecond));
  if (progress.raysPerSecond > 0) line += fmt::format("  {}rays/s", threeDigits(progress.raysPerSecond));
  if (progress.error >= 0) line += "  error " + percent(progress.error);
  if (progress.error >= 0 && progress.target >= 0) line += " of " + percent(progress.target);
  if (std::isfinite(progress.secondsLeft) && progress.secondsLeft >= 0) {
    line += fmt::format("  {} left", duration(progress.secondsLeft));
  }
  return line;
}

}  // namespace importon
