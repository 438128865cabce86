#include "scene/container/faults.h"

#include <fmt/format.h>

#include "base/error.h"
#include "scene/container/gltf_advice.h"

namespace importon {

void Faults::forgive(std::string_view kind, const std::string& pointer, const std::string& what,
                     const std::string& instead) const {
  const std::string where = pointer.empty() ? source_.name() : source_.at(pointer);
  if (areRefused()) throw SceneError(what, where, kExportAgain);
  log_.warn(kind, fmt::format("{}: {}; {}", where, what, instead));
}

}  // namespace importon
