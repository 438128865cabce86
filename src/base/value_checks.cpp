#include "base/value_checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/error.h"
#include "fmt/format.h"
#include "fmt/ranges.h"

namespace importon {
namespace {

std::string withUnit(const std::string& unit) { return unit.empty() ? "" : " " + unit; }

/// Accepts numbers with `isAllowed`; of others it says "TEXT is not WHAT".
template <class Number, class Test>
ValueCheck numberThat(const std::string& what, const Test& isAllowed) {
  return [what, isAllowed](const std::string& text) -> std::string {
    Number value{};
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, value);
    const bool isNumber = read.ec == std::errc() && read.ptr == end;
    return isNumber && isAllowed(value) ? "" : fmt::format("\"{}\" is not {}", text, what);
  };
}

}  // namespace

ValueCheck wholeNumber(std::int64_t least, std::int64_t most, const std::string& unit) {
  return numberThat<std::int64_t>(fmt::format("a whole number from {} to {}{}", least, most, withUnit(unit)),
                                  [=](std::int64_t value) { return value >= least && value <= most; });
}

ValueCheck finite(const std::string& unit) {
  return numberThat<double>("a number" + withUnit(unit), [](double value) { return std::isfinite(value); });
}

ValueCheck positive(const std::string& unit) {
  return numberThat<double>("a number above 0" + withUnit(unit),
                            [](double value) { return value > 0 && std::isfinite(value); });
}

ValueCheck notNegative(const std::string& unit) {
  return numberThat<double>("a number of 0 or more" + withUnit(unit),
                            [](double value) { return value >= 0 && std::isfinite(value); });
}

ValueCheck share() {
  return numberThat<double>("a number from 0 to 1", [](double value) { return value >= 0 && value <= 1; });
}

ValueCheck notEmpty() {
  return [](const std::string& text) -> std::string { return text.empty() ? "the value is empty" : ""; };
}

ValueCheck oneOf(const std::vector<std::string>& names) {
  return [names](const std::string& text) -> std::string {
    const bool isKnown = std::find(names.begin(), names.end(), text) != names.end();
    return isKnown ? "" : fmt::format("\"{}\" is none of {}", text, fmt::join(names, ", "));
  };
}

std::vector<std::string> splitNames(const std::string& list, const std::vector<std::string>& known,
                                    const std::string& option) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string name = list.substr(begin, end - begin);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw UsageError(fmt::format("{}: \"{}\" is not known", option, name), "command line",
                       fmt::format("choose among {}", fmt::join(known, ", ")));
    }
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      throw UsageError(fmt::format("{}: {} is there twice", option, name), "command line", "name each one once");
    }
    names.push_back(name);
    begin = end + 1;
  }
  return names;
}

}  // namespace importon
