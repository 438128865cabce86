/// A glTF file that has passed all checks of structure.
#pragma once
#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

#include "base/log.h"
#include "scene/container/gltf_source.h"
#include "scene/container/uri.h"

namespace importon {

/// Every index in the model is valid, every buffer view lies in its buffer, and images hold their undecoded
/// bytes (Image::image, or in their buffer view). The JSON is for what the model lacks or bends: materials,
/// extensions and extras, whose integers tinygltf 2.7 cuts to 32 bits.
struct GltfDocument {
  GltfSource source;
  nlohmann::json json;
  tinygltf::Model model;
};

/// Parses and checks. Throws SceneError.
[[nodiscard]] GltfDocument readDocument(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                        const AssetFolder& folder, Log& log);

}  // namespace importon
