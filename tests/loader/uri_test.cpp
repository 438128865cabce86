#include "scene/uri.h"

#include <gtest/gtest.h>

namespace importon {
namespace {

TEST(Uri, DecodesPercentEscapesAndLeavesTheRest) {
  EXPECT_EQ(percentDecode("a%20b%C3%A9+c"), "a b\xC3\xA9+c");
  EXPECT_EQ(percentDecode("100%"), "100%");
  EXPECT_EQ(percentDecode("%4"), "%4");
  EXPECT_EQ(percentDecode("%zz%41"), "%zzA");
}

TEST(Uri, StaysInTheFolderOfTheAsset) {
  const std::filesystem::path folder = "/assets";
  EXPECT_EQ(resolveInFolder(folder, "a/b.bin"), folder / "a/b.bin");
  EXPECT_EQ(resolveInFolder(folder, "a/../b.bin"), folder / "b.bin");
  EXPECT_EQ(resolveInFolder(folder, "./b.bin"), folder / "b.bin");
  EXPECT_EQ(resolveInFolder(folder, "..b"), folder / "..b");
  for (const char* outside : {"", "..", "../b.bin", "a/../../b.bin", "/etc/passwd", "//host/b", "C:/b.bin",
                              "http://host/b.bin", "file:b.bin", "..\\b.bin"}) {
    EXPECT_FALSE(resolveInFolder(folder, outside)) << outside;
  }
  EXPECT_FALSE(resolveInFolder(folder, std::string("a\0b", 3)));
}

TEST(Uri, TakesDataUrisApart) {
  const auto data = parseDataUri("data:image/png;base64,AAAA");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->mediaType, "image/png");
  EXPECT_EQ(data->base64, "AAAA");
  EXPECT_FALSE(parseDataUri("data:image/png,AAAA"));
  EXPECT_FALSE(parseDataUri("data:image/png;base64"));
  EXPECT_FALSE(parseDataUri("image.png"));
}

TEST(Uri, KnowsHowMuchBase64Holds) {
  EXPECT_EQ(base64DecodedSize(""), 0u);
  EXPECT_EQ(base64DecodedSize("QUJD"), 3u);
  EXPECT_EQ(base64DecodedSize("QUI="), 2u);
  EXPECT_EQ(base64DecodedSize("QQ=="), 1u);
  EXPECT_EQ(base64DecodedSize("QUI"), 2u);
  for (const char* malformed : {"Q", "Q===", "QUJD=", "QU=D", "QU D", "QUJ\n"}) {
    EXPECT_FALSE(base64DecodedSize(malformed)) << malformed;
  }
}

}  // namespace
}  // namespace importon
