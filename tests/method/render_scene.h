/// Renders a scene of a test and looks into the image.
#pragma once
#include <string>

#include "render/render.h"

namespace importon::test {

/// Renders quietly, without progress. Throws what render() throws.
[[nodiscard]] RenderResult renderScene(const Scene& scene, const RenderJob& job);

/// The values of a channel, row-major from the top; throws std::runtime_error if there is none.
[[nodiscard]] const std::vector<float>& channel(const RenderResult& result, const std::string& name);

/// Mean over the pixels of the channels R, G and B of `layer` (empty: the image itself).
[[nodiscard]] double meanOf(const RenderResult& result, const std::string& layer = {});

/// Relative mean square error against `reference`: mean of (I-R)²/(R² + 0.01 mean(R)²) over pixels and channels,
/// without the worst 0.1 % of the pixels' channels.
[[nodiscard]] double relativeError(const RenderResult& result, const RenderResult& reference);

}  // namespace importon::test
