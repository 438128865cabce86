/// The extra layers that `--aov` offers.
#pragma once
#include <array>

namespace importon {

inline constexpr std::array kAovNames{"albedo",
                                      "N",
                                      "P",
                                      "depth",
                                      "direct",
                                      "caustic",
                                      "indirect",
                                      "emission",
                                      "variance",
                                      "error",
                                      "importance.caustic",
                                      "importance.global",
                                      "required.caustic",
                                      "required.global",
                                      "density.caustic",
                                      "density.global",
                                      "radiance.caustic",
                                      "radiance.global",
                                      "importons.caustic",
                                      "importons.global",
                                      "photons.caustic",
                                      "photons.global"};

}  // namespace importon
