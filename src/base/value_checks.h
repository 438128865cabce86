/// Checks of values that are given as text.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace importon {

/// Says what is wrong with a value; empty: nothing.
using ValueCheck = std::function<std::string(const std::string& value)>;

/// A whole number within [least, most]. `unit` may be empty.
[[nodiscard]] ValueCheck wholeNumber(std::int64_t least, std::int64_t most, const std::string& unit);

/// A finite number.
[[nodiscard]] ValueCheck finite(const std::string& unit);

/// A finite number above zero.
[[nodiscard]] ValueCheck positive(const std::string& unit);

/// A finite number not below zero.
[[nodiscard]] ValueCheck notNegative(const std::string& unit);

/// A number from 0 to 1.
[[nodiscard]] ValueCheck share();

/// Any text but the empty one.
[[nodiscard]] ValueCheck notEmpty();

/// One of `names`.
[[nodiscard]] ValueCheck oneOf(const std::vector<std::string>& names);

/// Cuts "a,b,c". Throws UsageError on names that are empty, twice there, or not among `known`, which it lists.
[[nodiscard]] std::vector<std::string> splitNames(const std::string& list, const std::vector<std::string>& known,
                                                  const std::string& option);

}  // namespace importon
