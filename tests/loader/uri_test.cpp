#include "scene/container/uri.h"

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
  const AssetFolder folder{"/assets"};
  EXPECT_EQ(resolveUri(folder, "a/b.bin"), "/assets/a/b.bin");
  EXPECT_EQ(resolveUri(folder, "a/../b.bin"), "/assets/b.bin");
  EXPECT_EQ(resolveUri(folder, "./b.bin"), "/assets/b.bin");
  EXPECT_EQ(resolveUri(folder, "..b"), "/assets/..b");
  for (const char* outside : {"", "..", "../b.bin", "a/../../b.bin", "/etc/passwd", "//host/b", "C:/b.bin",
                              "http://host/b.bin", "file:b.bin", "..\\b.bin"}) {
    EXPECT_FALSE(resolveUri(folder, outside)) << outside;
  }
  EXPECT_FALSE(resolveUri(folder, std::string("a\0b", 3)));
}

TEST(Uri, LeavesTheFolderWhereAllowed) {
  const AssetFolder folder{"/assets", OutsideFiles::allowed};
  EXPECT_EQ(resolveUri(folder, "../b.bin"), "/assets/../b.bin");
  EXPECT_EQ(resolveUri(folder, "/other/b.bin"), "/other/b.bin");
  EXPECT_EQ(resolveUri(folder, "a/b.bin"), "/assets/a/b.bin");
  for (const char* noPath : {"", "C:/b.bin", "http://host/b.bin", "file:b.bin", "..\\b.bin"}) {
    EXPECT_FALSE(resolveUri(folder, noPath)) << noPath;
  }
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
