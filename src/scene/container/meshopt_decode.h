/// EXT_meshopt_compression and KHR_meshopt_compression, by meshoptimizer.
#pragma once
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace importon {

/// The extension of a buffer view, by either name; null if it has none.
[[nodiscard]] const nlohmann::json& meshoptExtension(const nlohmann::json& view);

/// A buffer that compressed views name as where their bytes go: it need not have data.
[[nodiscard]] bool isMeshoptFallback(const nlohmann::json& buffer);

/// What `extension`, checked by checkSchema, makes of the bytes that it names: count · byteStride of them. Throws
/// SceneError at `where`, also for what KHR adds to EXT and meshoptimizer 0.18 does not know: version 1 of the
/// attribute codec and the filter COLOR. At most 64 bytes come out for each that goes in, which is what the codecs can
/// do.
[[nodiscard]] std::vector<unsigned char> decodeMeshopt(const nlohmann::json& extension,
                                                       std::span<const unsigned char> encoded,
                                                       const std::string& where);

}  // namespace importon
