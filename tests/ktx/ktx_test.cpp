/// ktx_decode.cpp as it is built with libktx, against a stand-in of it.
#include <gtest/gtest.h>
#include <ktx.h>

#include "base/error.h"
#include "scene/images/ktx_decode.h"

namespace importon {
namespace {

class Ktx : public testing::Test {
 protected:
  Ktx() {
    standIn = {.baseWidth = 2, .baseHeight = 1, .vkFormat = 37, .offset = 4, .size = 12};
    for (std::uint8_t i = 0; i < 12; ++i) standIn.data[i] = i;
    standInResult = KTX_SUCCESS;
  }
  ~Ktx() override { EXPECT_EQ(openTextures, 0); }

  static std::vector<uint> decoded() {
    const ImageSize size = readKtxSize({}, "test");
    std::vector<uint> texels(size.texels());
    decodeKtx({}, texels, "test");
    return texels;
  }
  static std::string refusal() {
    try {
      (void)decoded();
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(Ktx, GivesTheTexelsOfItsLargestLevel) {
  EXPECT_EQ(decoded(), (std::vector<uint>{0x07060504u, 0x0B0A0908u}));
  standIn.vkFormat = 0;
  standIn.needsTranscoding = true;
  EXPECT_EQ(decoded().size(), 2u);
}

TEST_F(Ktx, RefusesOtherFormatsThanRgba8) {
  standIn.vkFormat = 77;  // two channels of 16 bits
  EXPECT_NE(refusal().find("not Basis Universal or RGBA8"), std::string::npos);
}

TEST_F(Ktx, RefusesDataThatEndEarly) {
  standIn.size = 11;
  EXPECT_NE(refusal(), "");
}

TEST_F(Ktx, RefusesCubesAndArrays) {
  standIn.isCubemap = true;
  EXPECT_NE(refusal().find("not a two-dimensional texture"), std::string::npos);
}

TEST_F(Ktx, NamesTheErrorOfTheLibrary) {
  standInResult = KTX_FILE_DATA_ERROR;
  EXPECT_NE(refusal().find("the KTX2 cannot be decoded (stand-in)"), std::string::npos);
}

}  // namespace
}  // namespace importon
