/// A glTF file that has passed all checks of structure.
#pragma once
#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/log.h"
#include "scene/container/faults.h"
#include "scene/container/file_choices.h"
#include "scene/container/gltf_source.h"
#include "scene/container/uri.h"

namespace importon {

/// Every index in the model is valid, and every buffer view lies in its buffer (as byteLength says: stand-ins of
/// compressed views and buffers that are absent have no bytes). The model has no images. The JSON is for what the model
/// lacks or bends: images, materials, extensions and extras, whose integers tinygltf 2.7 cuts to 32 bits.
struct GltfDocument {
  GltfSource source;
  AssetFolder folder;  // of external files
  Faults faults;
  nlohmann::json json;
  tinygltf::Model model;
  std::vector<std::optional<SceneError>> absences{};  // of the file's buffers: why one has no bytes
  mutable std::map<std::size_t, std::vector<unsigned char>> decodedViews{};  // of viewBytes
  bool isPosed = false;                                                      // by animations
};

/// Parses and checks. What `choices` choose is as if the file said so. Throws SceneError, and UsageError where the
/// choices name nothing that is there.
[[nodiscard]] GltfDocument readDocument(std::span<const std::byte> bytes, const std::filesystem::path& name,
                                        const AssetFolder& folder, Log& log, const FileChoices& choices = {});

/// Makes the model anew after a change of the JSON that leaves counts and indices as they are. Throws SceneError.
void rereadModel(GltfDocument& document);

}  // namespace importon
