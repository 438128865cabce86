/// Files with random damage: whatever comes, loading ends with a scene or a SceneError.
#include <gtest/gtest.h>

#include <random>

#include "loader/everything.h"
#include "loader/load.h"
#include "loader/pack_builder.h"

namespace importon::test {
namespace {

/// Flips, overwrites, removes, repeats or cuts a few bytes.
Bytes damaged(Bytes bytes, std::mt19937& random) {
  const auto below = [&](std::size_t limit) {
    return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
  };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    const auto position = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(12)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(position);
        break;
      case 2:
        bytes.insert(position, bytes[at]);
        break;
      case 3:
        bytes[at] = static_cast<unsigned char>(below(256));
        break;
      case 4:
        bytes[at] = 0xFF;
        break;
      case 5:
      case 6:
      case 7:
        bytes[at] = static_cast<unsigned char>('0' + below(10));
        break;
      default:
        bytes[at] = static_cast<unsigned char>(bytes[at] ^ 1u << below(8));
        break;
    }
  }
  return bytes;
}

/// How many of `count` damaged copies still load, at rest or in a pose.
int loaded(const Bytes& whole, unsigned seed, int count, std::optional<double> at = std::nullopt) {
  std::mt19937 random(seed);
  int scenes = 0;
  testing::internal::CaptureStderr();
  for (int i = 0; i < count; ++i) {
    const Bytes bytes = damaged(whole, random);
    Log log(Log::Verbosity::quiet);
    try {
      scenes += load(bytes, log, {.at = at}).triangles.empty() ? 0 : 1;
    } catch (const SceneError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  testing::internal::GetCapturedStderr();
  return scenes;
}

constexpr int kCopies = 1000;
constexpr int kProfileCopies = 60;  // a profile is sampled whole, which takes long

TEST(Mutation, TheWholeFileLoads) {
  for (const GltfBuilder& file : {everything(), packedFile(), profileFile(), animatedFile()})
    EXPECT_EQ(errorOf(file), "");
}

TEST(Mutation, DamagedGlbNeverCrashes) {
  const int scenes = loaded(everything().glb(), 1, kCopies);
  EXPECT_GT(scenes, 0) << "the damage is too heavy to test anything";
  EXPECT_LT(scenes, kCopies) << "the damage is too light to test anything";
}

TEST(Mutation, DamagedAnimationsNeverCrash) {
  const int scenes = loaded(animatedFile().glb(), 6, kCopies, 0.7);
  EXPECT_GT(scenes, 0);
  EXPECT_LT(scenes, kCopies);
}

TEST(Mutation, DamagedGltfNeverCrashes) {
  const int scenes = loaded(everything().gltf(), 2, kCopies);
  EXPECT_GT(scenes, 0);
  EXPECT_LT(scenes, kCopies);
}

void loadWithDamagedData(const GltfBuilder& builder, unsigned seed, int count = kCopies) {
  std::mt19937 random(seed);
  testing::internal::CaptureStderr();
  for (int i = 0; i < count; ++i) {
    GltfBuilder copy = builder;
    copy.binary = damaged(copy.binary, random);
    copy.binary.resize(builder.binary.size());
    (void)errorOf(copy);
  }
  testing::internal::GetCapturedStderr();
}

TEST(Mutation, DamagedDataNeverCrashes) { loadWithDamagedData(everything(), 3); }

TEST(Mutation, DamagedPackedDataNeverCrashes) { loadWithDamagedData(packedFile(), 4); }
TEST(Mutation, DamagedProfilesNeverCrash) { loadWithDamagedData(profileFile(), 5, kProfileCopies); }

/// All members and elements of a document, by JSON pointer.
void collect(const Json& value, const Json::json_pointer& place, std::vector<Json::json_pointer>& places) {
  places.push_back(place);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) collect(member, place / key, places);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], place / i, places);
  }
}

void loadWithWrongKinds(const GltfBuilder& builder, const std::string& from = "",
                        std::optional<double> at = std::nullopt) {
  std::vector<Json::json_pointer> places;
  const Json::json_pointer root(from);
  collect(builder.json[root], root, places);
  const Json kinds[] = {nullptr,
                        true,
                        -1,
                        0,
                        2,
                        2147483648,
                        18446744073709551615u,
                        1e300,
                        -0.5,
                        "",
                        "text",
                        Json::array(),
                        Json::object(),
                        Json::array({0, 0}),
                        Json::array({nullptr})};
  testing::internal::CaptureStderr();
  for (const Json::json_pointer& place : places) {
    for (const Json& kind : kinds) {
      GltfBuilder copy = builder;
      copy.json[place] = kind;
      Log log(Log::Verbosity::quiet);
      try {
        (void)load(copy.glb(), log, {.at = at});
      } catch (const SceneError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      }
    }
  }
  testing::internal::GetCapturedStderr();
}

TEST(Mutation, NoMemberOfTheWrongKindCrashes) { loadWithWrongKinds(everything()); }

TEST(Mutation, NoMemberOfTheWrongKindOfPackedDataCrashes) { loadWithWrongKinds(packedFile()); }

TEST(Mutation, NoMemberOfTheWrongKindOfProfilesCrashes) {
  loadWithWrongKinds(profileFile(), "/extensions/EXT_lights_ies");
  loadWithWrongKinds(animatedFile(), "/animations", 0.7);
}

}  // namespace
}  // namespace importon::test
