/// Checks of single option values, for CLI11.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace importon {

/// Says what is wrong with a value; empty: nothing.
using OptionCheck = std::function<std::string(const std::string& value)>;

/// A whole number within [least, most]. `unit` may be empty.
[[nodiscard]] OptionCheck wholeNumber(std::int64_t least, std::int64_t most, const std::string& unit);

/// A finite number above zero.
[[nodiscard]] OptionCheck positive(const std::string& unit);

/// A finite number not below zero.
[[nodiscard]] OptionCheck notNegative(const std::string& unit);

/// A number from 0 to 1.
[[nodiscard]] OptionCheck share();

/// Any text but the empty one.
[[nodiscard]] OptionCheck notEmpty();

/// One of `names`.
[[nodiscard]] OptionCheck oneOf(const std::vector<std::string>& names);

/// Cuts "a,b,c". Throws UsageError on names that are empty, twice there, or not among `known`, which it lists.
[[nodiscard]] std::vector<std::string> splitNames(const std::string& list,
                                                  const std::vector<std::string>& known,
                                                  const std::string& option);

}  // namespace importon
