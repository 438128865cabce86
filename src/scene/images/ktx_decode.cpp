#include "scene/images/ktx_decode.h"

#include <array>
#include <cstring>

#include "base/error.h"

#ifdef IMPORTON_HAS_KTX
#include <fmt/format.h>
#include <ktx.h>

#include <memory>
#endif

namespace importon {

bool isKtx(std::span<const unsigned char> bytes) {
  constexpr std::array<unsigned char, 12> kIdentifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                         '0',  0xBB, '\r', '\n', 0x1A, '\n'};
  return bytes.size() >= kIdentifier.size() && std::memcmp(bytes.data(), kIdentifier.data(), kIdentifier.size()) == 0;
}

#ifdef IMPORTON_HAS_KTX

namespace {

using KtxTexture = std::unique_ptr<ktxTexture2, void (*)(ktxTexture2*)>;

[[noreturn]] void failKtx(KTX_error_code code, const std::string& where) {
  throw SceneError(fmt::format("the KTX2 cannot be decoded ({})", ktxErrorString(code)), where,
                   "save the image as KTX2 again");
}

/// `flags`: whether the data are loaded too.
KtxTexture openKtx(std::span<const unsigned char> bytes, ktxTextureCreateFlags flags, const std::string& where) {
  ktxTexture2* texture = nullptr;
  const KTX_error_code code = ktxTexture2_CreateFromMemory(bytes.data(), bytes.size(), flags, &texture);
  if (code != KTX_SUCCESS) failKtx(code, where);
  return {texture, [](ktxTexture2* open) { ktxTexture_Destroy(ktxTexture(open)); }};
}

}  // namespace

ImageSize readKtxSize(std::span<const unsigned char> bytes, const std::string& where) {
  const KtxTexture texture = openKtx(bytes, KTX_TEXTURE_CREATE_NO_FLAGS, where);
  if (texture->numDimensions != 2 || texture->isArray || texture->isCubemap) {
    throw SceneError("the KTX2 is not a two-dimensional texture", where, "save one picture as KTX2");
  }
  return {texture->baseWidth, texture->baseHeight};
}

void decodeKtx(std::span<const unsigned char> bytes, std::span<uint> texels, const std::string& where) {
  const KtxTexture texture = openKtx(bytes, KTX_TEXTURE_CREATE_LOAD_IMAGE_DATA_BIT, where);
  if (ktxTexture2_NeedsTranscoding(texture.get())) {
    const KTX_error_code code = ktxTexture2_TranscodeBasis(texture.get(), KTX_TTF_RGBA32, 0);
    if (code != KTX_SUCCESS) failKtx(code, where);
  }
  ktx_size_t offset = 0;
  const KTX_error_code code = ktxTexture_GetImageOffset(ktxTexture(texture.get()), 0, 0, 0, &offset);
  if (code != KTX_SUCCESS) failKtx(code, where);
  constexpr std::uint32_t kUnorm = 37, kSrgb = 43;  // VK_FORMAT_R8G8B8A8_*
  const bool isRgba8 = texture->vkFormat == kUnorm || texture->vkFormat == kSrgb;
  if (!isRgba8) throw SceneError("the KTX2 is not Basis Universal or RGBA8", where, "save the image as one of these");
  const ktx_size_t size = ktxTexture_GetDataSize(ktxTexture(texture.get()));
  if (offset > size || texels.size_bytes() > size - offset) failKtx(KTX_FILE_DATA_ERROR, where);
  std::memcpy(texels.data(), ktxTexture_GetData(ktxTexture(texture.get())) + offset, texels.size_bytes());
}

#else

namespace {

[[noreturn]] void refuseKtx(const std::string& where) {
  throw SceneError("the image is KTX2, which this build of importon cannot read", where,
                   "save it as PNG, JPEG, WebP or AVIF, or build importon where libktx is installed");
}

}  // namespace

ImageSize readKtxSize(std::span<const unsigned char>, const std::string& where) { refuseKtx(where); }

void decodeKtx(std::span<const unsigned char>, std::span<uint>, const std::string& where) { refuseKtx(where); }

#endif

}  // namespace importon
