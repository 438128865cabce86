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
  EXPECT_EQ(resolveUri(folder, "a/b.bin").path, "/assets/a/b.bin");
  EXPECT_EQ(resolveUri(folder, "a/../b.bin").path, "/assets/b.bin");
  EXPECT_EQ(resolveUri(folder, "./b.bin").path, "/assets/b.bin");
  EXPECT_EQ(resolveUri(folder, "..b").path, "/assets/..b");
  EXPECT_EQ(resolveUri(folder, "a%20b").path, "/assets/a b");
  for (const char* outside :
       {"..", "../b.bin", "%2E%2E/b.bin", "a/../../b.bin", "/etc/passwd", "//host/b", "..\\b.bin"}) {
    EXPECT_EQ(resolveUri(folder, outside).fault, UriFault::outside) << outside;
  }
}

TEST(Uri, EachFaultHasItsName) {
  const AssetFolder folder{"/assets"};
  EXPECT_EQ(resolveUri(folder, "b.bin").fault, UriFault::none);
  EXPECT_EQ(resolveUri(folder, "").fault, UriFault::empty);
  EXPECT_EQ(resolveUri(folder, "a%00b").fault, UriFault::nul);
  EXPECT_EQ(resolveUri(folder, std::string("a\0b", 3)).fault, UriFault::nul);
  for (const char* scheme : {"C:/b.bin", "http://host/b.bin", "file:b.bin", "C:\\b.bin"}) {
    EXPECT_EQ(resolveUri(folder, scheme).fault, UriFault::scheme) << scheme;
  }
}

TEST(Uri, AnEscapedColonIsPartOfAName) {
  EXPECT_EQ(resolveUri({"/assets"}, "a%3Ab.png").path, "/assets/a:b.png");
  EXPECT_EQ(resolveUri({"/assets"}, "./a:b.png").path, "/assets/a:b.png");
}

TEST(Uri, BackslashesAreSlashes) {
  const UriFile file = resolveUri({"/assets"}, "textures\\a.png");
  EXPECT_EQ(file.path, "/assets/textures/a.png");
  EXPECT_TRUE(file.hadBackslashes);
  EXPECT_EQ(resolveUri({"/assets"}, "textures%5Ca.png").path, "/assets/textures/a.png");
  EXPECT_FALSE(resolveUri({"/assets"}, "textures/a.png").hadBackslashes);
}

TEST(Uri, LeavesTheFolderWhereAllowed) {
  const AssetFolder folder{"/assets", OutsideFiles::allowed};
  EXPECT_EQ(resolveUri(folder, "../b.bin").path, "/assets/../b.bin");
  EXPECT_EQ(resolveUri(folder, "..\\b.bin").path, "/assets/../b.bin");
  EXPECT_EQ(resolveUri(folder, "/other/b.bin").path, "/other/b.bin");
  EXPECT_EQ(resolveUri(folder, "a/b.bin").path, "/assets/a/b.bin");
  for (const char* noPath : {"", "C:/b.bin", "http://host/b.bin", "file:b.bin"}) {
    EXPECT_NE(resolveUri(folder, noPath).fault, UriFault::none) << noPath;
  }
}

std::string text(const std::optional<std::vector<unsigned char>>& bytes) {
  return bytes ? std::string(bytes->begin(), bytes->end()) : "none";
}

TEST(Uri, DecodesDataOfAnyMediaType) {
  for (const char* head : {"data:image/png;base64", "data:;base64", "data:text/html;charset=utf-8;base64"}) {
    EXPECT_EQ(text(decodeDataUri(std::string(head) + ",QUJD")), "ABC") << head;
  }
  EXPECT_EQ(text(decodeDataUri("data:,A%42C")), "ABC");
  EXPECT_EQ(text(decodeDataUri("data:image/png;base64,QU*D")), "none");
  EXPECT_EQ(text(decodeDataUri("data:image/png;base64")), "none");
  EXPECT_EQ(text(decodeDataUri("image.png")), "none");
}

TEST(Uri, DecodesBase64) {
  EXPECT_EQ(text(decodeBase64("")), "");
  EXPECT_EQ(text(decodeBase64("QUJD")), "ABC");
  EXPECT_EQ(text(decodeBase64("QUI=")), "AB");
  EXPECT_EQ(text(decodeBase64("QQ==")), "A");
  EXPECT_EQ(text(decodeBase64("QUI")), "AB");
  EXPECT_EQ(decodeBase64("+/9A"), (std::vector<unsigned char>{0xFB, 0xFF, 0x40}));
  for (const char* malformed : {"Q", "Q===", "QUJD=", "QU=D", "QU D", "QUJ\n"}) {
    EXPECT_FALSE(decodeBase64(malformed)) << malformed;
  }
}

}  // namespace
}  // namespace importon
