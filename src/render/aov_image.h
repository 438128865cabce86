/// Layers of the output image.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "io/image.h"
#include "render/film.h"

namespace importon {

/// Adds channels R, G, B, or LAYER.R, ... if `layer` is not empty.
void addColor(Image& image, const std::string& layer, std::span<const vec3> values);

/// Adds the layers of `names` (render/aov_names.h); `floats` holds kAovFloats per pixel.
void addAovLayers(Image& image, std::span<const std::string> names, const FilmLayers& film,
                  std::span<const float> floats, glm::dvec3 worldFromRender);

}  // namespace importon
