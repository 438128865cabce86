/// An option of a render as data: all that the command line, the help and the fingerprint of a run know of it.
#pragma once
#include <fmt/format.h>

#include <charconv>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/value_checks.h"
#include "render/render_job.h"

namespace importon {

/// Headings of the help, in its order.
enum class OptionGroup { output, image, stop, method, density, talk, pausing, machine, checks };

/// What an option is of no use without.
struct OptionNeed {
  const char* what = "";  // "OPTION needs WHAT"
  const char* advice = "give both, or leave it out";
  bool (*isMet)(const RenderJob&) = nullptr;
};

struct OptionRow {
  std::string names;  // "-o,--output"
  std::string type;   // of its value, as the help shows it; empty: a flag
  std::string help;   // with its default
  OptionGroup group = OptionGroup::method;
  ValueCheck check;                                         // of the value
  std::function<void(RenderJob&, const std::string&)> set;  // of a flag: with an empty text
  std::function<std::string(const RenderJob&)> value;       // as text, the same for equal values

  bool isEveryday = false;  // in the short help
  bool isRequired = false;
  bool changesImage = false;                           // part of the run's fingerprint
  bool isOfPhotons = false;                            // of no use to the path tracer
  bool (*impliesPhotons)(const RenderJob&) = nullptr;  // with its value --gather-from photons is implied
  OptionNeed need = {};
  int words = 1;  // of its value, which check and set take with a space between each two

  /// The long name, "--output".
  [[nodiscard]] std::string name() const { return names.substr(names.find("--")); }

  OptionRow everyday() && {
    isEveryday = true;
    return std::move(*this);
  }
  OptionRow required() && {
    isRequired = true;
    return std::move(*this);
  }
  OptionRow forImage() && {
    changesImage = true;
    return std::move(*this);
  }
  OptionRow forPhotons() && {
    changesImage = isOfPhotons = true;
    return std::move(*this);
  }
  OptionRow implyingPhotons(bool (*holds)(const RenderJob&)) && {
    impliesPhotons = holds;
    return std::move(*this);
  }
  OptionRow needs(OptionNeed other) && {
    need = other;
    return std::move(*this);
  }
};

/// Rows by the type of the job's member.
namespace option_rows {

template <class Number>
std::string textOf(const std::optional<Number>& value) {
  return value ? fmt::format("{}", *value) : "automatic";
}
template <class Number>
std::string textOf(const Number& value) {
  return fmt::format("{}", value);
}

template <class Number>
Number numberOf(const std::string& text) {
  Number number{};
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The help ends with the job's default, unless it names one.
template <class Number>
OptionRow number(OptionGroup group, const char* names, const char* type, Number RenderJob::*member, ValueCheck check,
                 const std::string& help) {
  const bool namesOne = help.find("(default") != std::string::npos;
  return {names,
          type,
          namesOne ? help : fmt::format("{} (default: {})", help, RenderJob{}.*member),
          group,
          std::move(check),
          [member](RenderJob& job, const std::string& text) { job.*member = numberOf<Number>(text); },
          [member](const RenderJob& job) { return textOf(job.*member); }};
}

template <class Number>
OptionRow number(OptionGroup group, const char* names, const char* type, std::optional<Number> RenderJob::*member,
                 ValueCheck check, const char* help) {
  return {names,
          type,
          help,
          group,
          std::move(check),
          [member](RenderJob& job, const std::string& text) { job.*member = numberOf<Number>(text); },
          [member](const RenderJob& job) { return textOf(job.*member); }};
}

/// One of a few names.
template <class Value, class Member>
OptionRow choice(OptionGroup group, const char* names, Member RenderJob::*member,
                 std::vector<std::pair<std::string, Value>> choices, const char* help) {
  std::vector<std::string> known;
  std::string type;
  for (const auto& [name, value] : choices) {
    known.push_back(name);
    type += (type.empty() ? "" : ",") + name;
  }
  const auto set = [member, choices](RenderJob& job, const std::string& text) {
    for (const auto& [name, value] : choices)
      if (name == text) job.*member = value;
  };
  const auto nameOf = [member, choices](const RenderJob& job) -> std::string {
    for (const auto& [name, value] : choices)
      if (job.*member == value) return name;
    return "automatic";
  };
  return {names, type, help, group, oneOf(known), set, nameOf};
}

/// A file, or any other text but the empty one.
template <class Text>
OptionRow text(OptionGroup group, const char* names, const char* type, Text RenderJob::*member, const char* help) {
  return {names,
          type,
          help,
          group,
          notEmpty(),
          [member](RenderJob& job, const std::string& given) { job.*member = given; },
          [member](const RenderJob& job) { return std::string(job.*member); }};
}

inline OptionRow flag(OptionGroup group, const char* names, bool RenderJob::*member, const char* help) {
  return {names,
          "",
          help,
          group,
          {},
          [member](RenderJob& job, const std::string&) { job.*member = true; },
          [member](const RenderJob& job) { return std::string(job.*member ? "on" : "off"); }};
}

}  // namespace option_rows

}  // namespace importon
