/// Options whose value is one of a few names.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "app/option_checks.h"

namespace importon {

/// "a,b,c": for the help.
[[nodiscard]] inline std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  return list;
}

/// An option that sets `target` to the value that belongs to the name given.
template <class Value, class Target>
CLI::Option* addChoice(CLI::App& app, const std::string& name, std::map<std::string, Value> choices, Target& target,
                       const std::string& help) {
  const auto assign = [choices, &target](const std::string& text) { target = choices.at(text); };
  std::vector<std::string> names;
  for (const auto& [choice, value] : choices) names.push_back(choice);
  return app.add_option_function<std::string>(name, assign, help)->check(oneOf(names))->type_name(listOf(names));
}

}  // namespace importon
