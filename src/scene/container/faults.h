/// What to do about a file's small faults: those with which a picture can be made all the same.
#pragma once
#include <string>
#include <string_view>

#include "base/log.h"
#include "scene/container/gltf_source.h"

namespace importon {

enum class Strictness { forgiving, strict };

/// Passed by reference to all that reads a file.
class Faults {
 public:
  Faults(const GltfSource& source, Log& log, Strictness strictness)
      : source_(source), log_(log), strictness_(strictness) {}

  /// `what` is wrong at the JSON pointer `pointer`, and `instead` is what is done about it: a warning, counted by its
  /// `kind`. Where the file is read strictly, throws SceneError.
  void forgive(std::string_view kind, const std::string& pointer, const std::string& what,
               const std::string& instead) const;

  [[nodiscard]] bool areRefused() const { return strictness_ == Strictness::strict; }

 private:
  GltfSource source_;
  Log& log_;
  Strictness strictness_;
};

}  // namespace importon
