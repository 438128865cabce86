/// HDR-FLIP: how different two images look at whatever exposure tells them apart most.
#pragma once
#include <span>
#include <vector>

#include "io/image.h"

namespace importon {

/// Exposures, in stops, at which HDR-FLIP looks: from `start`, where the brightest pixel of the reference just
/// is not clipped, to `stop`, where its median pixel is as bright as that; `count` of them at equal steps.
struct ExposureRange {
  double start = 0, stop = 0;
  int count = 2;
};

/// [Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images", sec. 4]: start =
/// log2(c/max Y), stop = log2(c/median Y), count = max(2, ceil(stop - start)), where c is the value that the tone
/// mapper shows at 0.85 of white. `luminances` are those of the reference; what isn't finite is left out.
[[nodiscard]] ExposureRange exposureRange(std::span<const double> luminances);

/// The curve that the paper shows exposed images by: ACES as fitted by Narkowicz 2015, with the pre-exposure of
/// 0.6 undone, clamped to [0, 1].
[[nodiscard]] float acesCurve(float exposed);

/// The greatest LDR-FLIP of each pixel over the exposures. SceneError naming the file if one of R, G, B is
/// missing. Both images have the same size; pixels that aren't finite in either have 1.
[[nodiscard]] std::vector<float> hdrFlipMap(const Image& test, const std::string& testName, const Image& reference,
                                            const std::string& referenceName);

}  // namespace importon
