#include "loader/gltf_builder.h"

namespace importon::test {
namespace {

void append(Bytes& bytes, std::uint32_t word) {
  const auto* first = reinterpret_cast<const unsigned char*>(&word);
  bytes.insert(bytes.end(), first, first + sizeof word);
}

void appendChunk(Bytes& bytes, const char* type, Bytes payload, unsigned char padding) {
  while (payload.size() % 4 != 0) payload.push_back(padding);
  append(bytes, static_cast<std::uint32_t>(payload.size()));
  bytes.insert(bytes.end(), type, type + 4);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
}

}  // namespace

std::string base64(std::span<const unsigned char> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::span<const std::byte> asBytes(const Bytes& bytes) { return std::as_bytes(std::span(bytes)); }

Bytes toBytes(const std::string& text) { return {text.begin(), text.end()}; }

Bytes makeGlb(const std::string& jsonText, const Bytes& binary) {
  Bytes chunks;
  appendChunk(chunks, "JSON", toBytes(jsonText), ' ');
  if (!binary.empty()) appendChunk(chunks, "BIN\0", binary, 0);
  Bytes bytes = toBytes("glTF");
  append(bytes, 2);
  append(bytes, static_cast<std::uint32_t>(12 + chunks.size()));
  bytes.insert(bytes.end(), chunks.begin(), chunks.end());
  return bytes;
}

GltfBuilder::GltfBuilder() {
  json["asset"]["version"] = "2.0";
  json["scene"] = 0;
  json["scenes"] = Json::array({{{"nodes", Json::array()}}});
}

GltfBuilder GltfBuilder::emissiveTriangle() {
  GltfBuilder builder;
  builder.add("materials", {{"name", "glow"},
                            {"emissiveFactor", {0.25, 0.5, 0.75}},
                            {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}});
  const int positions = builder.addPositions({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  builder.addMesh({{"attributes", {{"POSITION", positions}}}, {"material", 0}});
  return builder;
}

int GltfBuilder::addView(const void* data, std::size_t bytes) {
  while (binary.size() % 4 != 0) binary.push_back(0);
  const std::size_t offset = binary.size();
  const auto* first = static_cast<const unsigned char*>(data);
  binary.insert(binary.end(), first, first + bytes);
  return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
}

int GltfBuilder::add(const std::string& array, const Json& element) {
  json[array].push_back(element);
  return static_cast<int>(json[array].size()) - 1;
}

int GltfBuilder::addRoot(const Json& node) {
  const int index = add("nodes", node);
  json["scenes"][0]["nodes"].push_back(index);
  return index;
}

int GltfBuilder::addMesh(const Json& primitive) {
  const int mesh = add("meshes", {{"primitives", Json::array({primitive})}});
  return addRoot({{"mesh", mesh}});
}

int GltfBuilder::addTexture(const Bytes& encodedImage, const Json& sampler) {
  const int view = addView(encodedImage.data(), encodedImage.size());
  const int image = add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
  Json texture = {{"source", image}};
  if (!sampler.is_null()) texture["sampler"] = add("samplers", sampler);
  return add("textures", texture);
}

Bytes GltfBuilder::glb() const {
  Json document = json;
  const bool needsBuffer = document.is_object() && !document.contains("buffers") && !binary.empty();
  if (needsBuffer) document["buffers"] = Json::array({{{"byteLength", binary.size()}}});
  if (needsBuffer && fallbackBytes != 0) {
    document["buffers"].push_back(
        {{"byteLength", fallbackBytes}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  }
  return makeGlb(document.dump(), binary);
}

Bytes GltfBuilder::gltf() const {
  Json document = json;
  const std::string uri = "data:application/octet-stream;base64," + base64(binary);
  document["buffers"] = Json::array({{{"byteLength", binary.size()}, {"uri", uri}}});
  return toBytes(document.dump());
}

}  // namespace importon::test
