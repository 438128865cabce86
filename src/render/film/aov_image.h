/// Layers of the output image.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "io/image.h"
#include "render/film/film.h"

namespace importon {

/// Adds channels R, G, B, or LAYER.R, ... if `layer` is not empty.
void addColor(Image& image, const std::string& layer, std::span<const vec3> values);

/// Adds the layer of that name (render/options/aov_table.h), unless it counts points. `buffer`: kAovFloats per pixel.
void addAovLayer(Image& image, const std::string& name, const FilmLayers& film, std::span<const float> buffer,
                 glm::dvec3 worldFromRender);

}  // namespace importon
