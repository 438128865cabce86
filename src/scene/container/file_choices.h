/// What a user chooses of a file, and how strictly it is read.
#pragma once
#include <optional>
#include <string>

#include "scene/container/faults.h"

namespace importon {

struct FileChoices {
  Strictness strictness = Strictness::forgiving;
  std::string scene{};         // name or index of a scene; empty: the file's default, else the first
  std::string variant{};       // of KHR_materials_variants; empty: the look without one
  std::optional<double> at{};  // s: the pose of the animations at that time; none: the pose at rest
  std::string animation{};     // name or index of the one that plays; empty: all
};

}  // namespace importon
