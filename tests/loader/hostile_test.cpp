// Files that mean harm: a clear and short error, in a time and with a memory that the file's own size bounds.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>

#include "loader/image_builder.h"
#include "loader/load.h"
#include "loader/pack_builder.h"

namespace importon::test {
namespace {

std::int64_t peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

/// Loading throws a SceneError of less than 1000 bytes that holds `part`, after less than 5 s of processor time, and
/// takes no more memory than 64 MiB and 16 times the file.
void expectRefusedCheaply(const Bytes& file, const std::string& part, Strictness strictness = Strictness::forgiving) {
  const std::int64_t bytesBefore = peakBytes();
  const std::clock_t before = std::clock();
  const std::string error = errorOf(file, strictness);
  const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  EXPECT_NE(error.find(part), std::string::npos) << error.substr(0, 1000);
  EXPECT_NE(error, "");
  EXPECT_LT(error.size(), 1000u);
  EXPECT_LT(seconds, 5);
  EXPECT_LT(peakBytes() - bytesBefore, (std::int64_t{64} << 20) + 16 * static_cast<std::int64_t>(file.size()));
}

void expectRefusedCheaply(const GltfBuilder& builder, const std::string& part,
                          Strictness strictness = Strictness::forgiving) {
  expectRefusedCheaply(builder.glb(), part, strictness);
}

TEST(HostileFile, SizesThatOverflow) {
  for (const std::uint64_t huge :
       {std::uint64_t{1} << 31, std::uint64_t{1} << 32, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    for (const char* member : {"byteOffset", "byteLength"}) {
      GltfBuilder view = GltfBuilder::emissiveTriangle();
      view.json["bufferViews"][0][member] = huge;
      expectRefusedCheaply(view, "/bufferViews/0");
    }
    GltfBuilder accessor = GltfBuilder::emissiveTriangle();
    accessor.json["accessors"][0]["byteOffset"] = huge;
    expectRefusedCheaply(accessor, "test.glb#");
    GltfBuilder buffer = GltfBuilder::emissiveTriangle();
    buffer.json["buffers"] = {{{"byteLength", huge}}};
    expectRefusedCheaply(buffer, "/buffers/0");
  }
}

TEST(HostileFile, CountsOfTwoToTheThirtyFirst) {
  for (const std::uint64_t count : {std::uint64_t{1} << 31, (std::uint64_t{1} << 31) - 1, std::uint64_t{1} << 60}) {
    GltfBuilder plain = GltfBuilder::emissiveTriangle();
    plain.json["accessors"][0]["count"] = count;
    expectRefusedCheaply(plain, "test.glb#");
    GltfBuilder sparse = GltfBuilder::emissiveTriangle();
    Json& accessor = sparse.json["accessors"][0];
    accessor.erase("bufferView");
    accessor["count"] = count;
    accessor["sparse"] = {{"count", count},
                          {"indices", {{"bufferView", 0}, {"componentType", kUnsignedByte}}},
                          {"values", {{"bufferView", 0}}}};
    expectRefusedCheaply(sparse, "test.glb#");
  }
}

TEST(HostileFile, ImageOfTenGigapixelsInAHundredBytes) {
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  Bytes png = makePng(1, 1, {1, 2, 3, 4});
  constexpr unsigned char kHeader[] = {
      0x00, 0x01, 0x86, 0xA0, 0x00, 0x01, 0x86, 0xA0, 0x08,
      0x06, 0x00, 0x00, 0x00, 0xA8, 0x52, 0x0B, 0xC8};  // width, height, RGBA of 8 bits, checksum
  std::copy(std::begin(kHeader), std::end(kHeader), png.begin() + 16);
  EXPECT_LT(png.size(), 100u);
  builder.json["materials"][0]["emissiveTexture"]["index"] = builder.addTexture(png);
  expectRefusedCheaply(builder, "/images/0");
}

TEST(HostileFile, DracoDataThatDeclareBillionsInAFewBytes) {
  const PlainMesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .indices = {0, 1, 2}};
  constexpr std::size_t kHeaderBytes = 11;
  for (const DracoMethod method : {DracoMethod::sequential, DracoMethod::edgebreaker}) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    Json& extension = addDracoMesh(builder, mesh, method)["extensions"]["KHR_draco_mesh_compression"];
    Bytes stream = encodeDraco(mesh, method);
    const Bytes billions = {0xFF, 0xFF, 0xFF, 0xFF, 0x03};  // 2^30 - 1, as a varint
    const std::size_t counts = kHeaderBytes + (method == DracoMethod::edgebreaker ? 1 : 0);
    stream.erase(stream.begin() + counts, stream.begin() + counts + 2);
    for (int i = 0; i < 2; ++i) stream.insert(stream.begin() + counts, billions.begin(), billions.end());
    extension["bufferView"] = builder.addView(stream.data(), stream.size());
    expectRefusedCheaply(builder, "the Draco data declare 1073741823 triangles");
  }
}

TEST(HostileFile, MeshoptDataThatDeclareBillionsInAFewBytes) {
  const std::vector<glm::vec3> positions(3);
  GltfBuilder builder = GltfBuilder::emissiveTriangle();
  const int view = addMeshoptView(builder, positions.data(), 3, 12);
  builder.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"]["count"] = 2000000000;
  builder.json["accessors"][0]["bufferView"] = view;
  expectRefusedCheaply(builder, "2000000000 elements of 12 bytes cannot come of");
}

TEST(HostileFile, DataUrisOfNonsense) {
  const std::string megabytes(8u << 20, '=');
  for (const std::string& uri : {std::string("data:"), std::string("data:,"), std::string("data:;base64,"),
                                 std::string("data:application/octet-stream;base64,\xE2\x82\xAC"),
                                 "data:application/octet-stream;base64," + megabytes, "data:" + megabytes}) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.json["buffers"] = {{{"byteLength", 36}, {"uri", uri}}};
    expectRefusedCheaply(builder, "/buffers/0");
  }
}

TEST(HostileFile, HugeStrings) {
  const std::string megabytes(2u << 20, 'x');
  for (const char* pointer : {"/accessors/0/type", "/materials/0/alphaMode", "/asset/version", "/scene"}) {
    GltfBuilder builder = GltfBuilder::emissiveTriangle();
    builder.json[Json::json_pointer(pointer)] = megabytes;
    expectRefusedCheaply(builder, "test.glb", kStrict);
  }
  GltfBuilder uri = GltfBuilder::emissiveTriangle();
  uri.json["buffers"] = {{{"byteLength", 36}, {"uri", megabytes}}};
  expectRefusedCheaply(uri, "/buffers/0");
  GltfBuilder extension = GltfBuilder::emissiveTriangle();
  extension.json["extensionsRequired"] = {megabytes};
  expectRefusedCheaply(extension, "test.glb");
}

TEST(HostileFile, InvalidUtf8) {
  for (const char* bytes : {"\xFF\xFE", "\xC0\xAF", "\xED\xA0\x80", "\xF8\x88\x80\x80\x80", "\xE2\x82"})
    for (const char* member : {"name", "uri"})
      expectRefusedCheaply(toBytes(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,")" + std::string(member) +
                                   "\":\"" + bytes + "\"}]}"),
                           "malformed");
}

}  // namespace
}  // namespace importon::test
