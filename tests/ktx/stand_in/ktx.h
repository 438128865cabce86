/// As much of libktx's interface as ktx_decode.cpp calls, for machines without it: textures are not decoded, they are
/// what `standIn` says.
#pragma once
#include <cstddef>
#include <cstdint>

// NOLINTBEGIN(readability-identifier-naming): the names are libktx's.
using ktx_size_t = std::size_t;
using ktxTextureCreateFlags = std::uint32_t;

enum KTX_error_code { KTX_SUCCESS = 0, KTX_FILE_DATA_ERROR = 1 };
enum ktx_transcode_fmt_e { KTX_TTF_RGBA32 = 13 };
enum : ktxTextureCreateFlags { KTX_TEXTURE_CREATE_NO_FLAGS = 0, KTX_TEXTURE_CREATE_LOAD_IMAGE_DATA_BIT = 1 };

struct ktxTexture2 {
  bool isArray = false, isCubemap = false, needsTranscoding = false;
  std::uint32_t baseWidth = 0, baseHeight = 0, numDimensions = 2, vkFormat = 0;
  std::uint8_t data[64] = {};
  ktx_size_t offset = 0, size = 0;
};
using ktxTexture_ = ktxTexture2;

/// The texture that every file holds, and how many are open.
inline ktxTexture2 standIn{};
inline KTX_error_code standInResult = KTX_SUCCESS;
inline int openTextures = 0;

inline ktxTexture_* ktxTexture(ktxTexture2* texture) { return texture; }
inline const char* ktxErrorString(KTX_error_code) { return "stand-in"; }
inline KTX_error_code ktxTexture2_CreateFromMemory(const std::uint8_t*, ktx_size_t, ktxTextureCreateFlags,
                                                   ktxTexture2** texture) {
  if (standInResult != KTX_SUCCESS) return standInResult;
  *texture = new ktxTexture2(standIn);
  ++openTextures;
  return KTX_SUCCESS;
}
inline void ktxTexture_Destroy(ktxTexture_* texture) {
  --openTextures;
  delete texture;
}
inline bool ktxTexture2_NeedsTranscoding(ktxTexture2* texture) { return texture->needsTranscoding; }
inline KTX_error_code ktxTexture2_TranscodeBasis(ktxTexture2* texture, ktx_transcode_fmt_e, std::uint32_t) {
  texture->vkFormat = 37;
  return KTX_SUCCESS;
}
inline KTX_error_code ktxTexture_GetImageOffset(ktxTexture_* texture, std::uint32_t, std::uint32_t, std::uint32_t,
                                                ktx_size_t* offset) {
  *offset = texture->offset;
  return KTX_SUCCESS;
}
inline ktx_size_t ktxTexture_GetDataSize(ktxTexture_* texture) { return texture->size; }
inline std::uint8_t* ktxTexture_GetData(ktxTexture_* texture) { return texture->data; }
// NOLINTEND(readability-identifier-naming)
