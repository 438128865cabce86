/// Animations that are wrong: refused with their place, or forgiven with a warning and a picture.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "loader/animation_builder.h"
#include "loader/load.h"

namespace importon::test {
namespace {

using B = GltfBuilder;
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

B moving() {
  B builder = B::emissiveTriangle();
  addMove(builder, 0, {1, 0, 0}, {3, 0, 0});
  return builder;
}

std::string errorAt(const B& builder, Strictness strictness = Strictness::forgiving) {
  Log log(Log::Verbosity::quiet);
  try {
    (void)load(builder.glb(), log, {.strictness = strictness, .at = 0.5});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

struct Wrong {
  const char* name;
  std::function<void(B&)> spoil;
  const char* message;  // a part of it
  const char* pointer;  // of a refusal; nullptr: none
};

void PrintTo(const Wrong& test, std::ostream* out) { *out << test.name; }

Json& animation(B& b) { return b.json["animations"][0]; }
Json& sampler(B& b) { return animation(b)["samplers"][0]; }
Json& channel(B& b) { return animation(b)["channels"][0]; }
void setTimes(B& b, const std::vector<float>& times) { sampler(b)["input"] = b.addAccessor(times, kFloat, "SCALAR"); }

constexpr const char* kInput = "/animations/0/samplers/0/input";
constexpr const char* kOutput = "/animations/0/samplers/0/output";

const Wrong kBroken[] = {
    {"AnimationsAreAnObject", [](B& b) { b.json["animations"] = Json::object(); }, "expected an array", "/animations"},
    {"NoChannels", [](B& b) { animation(b).erase("channels"); }, "'channels' is missing", "/animations/0"},
    {"NoSamplers", [](B& b) { animation(b).erase("samplers"); }, "'samplers' is missing", "/animations/0"},
    {"NoTarget", [](B& b) { channel(b).erase("target"); }, "'target' is missing", "/animations/0/channels/0"},
    {"NoSampler", [](B& b) { channel(b).erase("sampler"); }, "'sampler' is missing", "/animations/0/channels/0"},
    {"SamplerOutside", [](B& b) { channel(b)["sampler"] = 1; }, "index 1 is not among the 1 samplers",
     "/animations/0/channels/0/sampler"},
    {"SamplerNegative", [](B& b) { channel(b)["sampler"] = -1; }, "-1", "/animations/0/channels/0/sampler"},
    {"NodeOutside", [](B& b) { channel(b)["target"]["node"] = 7; }, "index 7 is not among",
     "/animations/0/channels/0/target/node"},
    {"PathIsANumber", [](B& b) { channel(b)["target"]["path"] = 7; }, "expected a string",
     "/animations/0/channels/0/target/path"},
    {"InputMissing", [](B& b) { sampler(b).erase("input"); }, "'input' is missing", "/animations/0/samplers/0"},
    {"InputOutside", [](B& b) { sampler(b)["input"] = 99; }, "index 99 is not among", kInput},
    {"OutputOutside", [](B& b) { sampler(b)["output"] = -1; }, "index -1 is not among", kOutput},
    {"TimesFall",
     [](B& b) {
       setTimes(b, {1, 0});
     },
     "key 1 is at 0 s, after one at 1 s", kInput},
    {"TimesAreNoNumbers",
     [](B& b) {
       setTimes(b, {0, kNoNumber});
     },
     "the time of key 1 is nan", kInput},
    {"TimesAreEndless",
     [](B& b) {
       setTimes(b, {0, std::numeric_limits<float>::infinity()});
     },
     "inf", kInput},
    {"TimesAreNegative",
     [](B& b) {
       setTimes(b, {-1, 0});
     },
     "the time of key 0 is -1", kInput},
    {"TimesAreIntegers",
     [](B& b) {
       sampler(b)["input"] = b.addAccessor(std::vector<std::uint16_t>{0, 1}, kUnsignedShort, "SCALAR");
     },
     "not single floats", kInput},
    {"TimesAreVectors", [](B& b) { sampler(b)["input"] = sampler(b)["output"]; }, "not single floats", kInput},
    {"TooManyKeysForTheirView", [](B& b) { b.json["accessors"][sampler(b)["input"].get<int>()]["count"] = 1000000000; },
     "reach past", kInput},
    {"TooManyKeysWithoutAView",
     [](B& b) {
       Json& times = b.json["accessors"][sampler(b)["input"].get<int>()];
       times["count"] = 1000000000;
       times.erase("bufferView");
     },
     "1000000000 keys have no times", kInput},
    {"MoreKeysThanValues",
     [](B& b) {
       setTimes(b, {0, 1, 2});
     },
     "3 keys have 2 values but need 3", kOutput},
    {"FewerKeysThanValues", [](B& b) { setTimes(b, {0}); }, "1 keys have 2 values but need 1", kOutput},
    {"SplineWithoutTangents", [](B& b) { sampler(b)["interpolation"] = "CUBICSPLINE"; },
     "2 keys have 2 values but need 6", kOutput},
    {"ManyValuesWithoutAView",
     [](B& b) {
       Json& values = b.json["accessors"][sampler(b)["output"].get<int>()];
       values["count"] = 1000000000;
       values.erase("bufferView");
     },
     "but need 2", kOutput},
    {"TranslationOfFourNumbers",
     [](B& b) { sampler(b)["output"] = b.addAccessor(std::vector<glm::vec4>(2), kFloat, "VEC4"); },
     "not 3 numbers each", kOutput},
    {"RotationOfThreeNumbers", [](B& b) { channel(b)["target"]["path"] = "rotation"; }, "not 4 numbers each", kOutput},
    {"ValuesAreMatrices", [](B& b) { sampler(b)["output"] = b.addAccessor(std::vector<glm::mat4>(2), kFloat, "MAT4"); },
     "not 3 numbers each", kOutput},
    {"ValuesAreNoNumbers",
     [](B& b) {
       sampler(b)["output"] = b.addPositions({{0, 0, 0}, {0, kNoNumber, 0}});
     },
     "number 4 of the keys is not finite", kOutput},
    {"WordsOf32Bits",
     [](B& b) {
       channel(b)["target"]["path"] = "rotation";
       sampler(b)["output"] = b.addAccessor(std::vector<glm::uvec4>(2, glm::uvec4(1)), kUnsignedInt, "VEC4");
     },
     "8 or 16 bits", kOutput},
    {"PointerWithoutAPlace",
     [](B& b) {
       channel(b)["target"] = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", Json::object()}}}};
     },
     "'pointer' is missing", "/animations/0/channels/0/target/extensions/KHR_animation_pointer"},
};

class BrokenAnimation : public testing::TestWithParam<Wrong> {};

TEST_P(BrokenAnimation, IsRefusedWithItsPlaceButShownAtRest) {
  B builder = moving();
  GetParam().spoil(builder);
  const std::string error = errorAt(builder);
  EXPECT_NE(error.find(GetParam().message), std::string::npos) << error;
  EXPECT_NE(error.find(std::string("(test.glb#") + GetParam().pointer + "):"), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
  EXPECT_EQ(errorOf(builder, kStrict), "") << "who wants no pose does not read it";
  EXPECT_EQ(warningsOf(builder).size(), 0u);
}
INSTANTIATE_TEST_SUITE_P(Each, BrokenAnimation, testing::ValuesIn(kBroken),
                         [](const auto& row) { return std::string(row.param.name); });

const Wrong kForgiven[] = {
    {"UnknownPath", [](B& b) { channel(b)["target"]["path"] = "colour"; }, "unknown path of an animation", nullptr},
    {"UnknownInterpolation", [](B& b) { sampler(b)["interpolation"] = "BEZIER"; }, "unknown value", nullptr},
    {"MatrixInTheWay", [](B& b) { b.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "animated matrix", nullptr},
    {"NoKeys",
     [](B& b) {
       for (const char* key : {"input", "output"}) b.json["accessors"][sampler(b)[key].get<int>()]["count"] = 0;
     },
     "channel without keys", nullptr},
    {"KeysAtOneTime",
     [](B& b) {
       setTimes(b, {0, 0});
       sampler(b)["output"] = b.addPositions({{0, 0, 0}, {1, 0, 0}});
     },
     "keys at one time", nullptr},
};

class ForgivenAnimation : public testing::TestWithParam<Wrong> {};

TEST_P(ForgivenAnimation, IsAWarningAndAPicture) {
  B builder = moving();
  GetParam().spoil(builder);
  Log log(Log::Verbosity::quiet);
  EXPECT_EQ(load(builder.glb(), log, {.at = 0.5}).triangles.size(), 1u);
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, GetParam().message);
  EXPECT_NE(errorAt(builder, kStrict), "");
}
INSTANTIATE_TEST_SUITE_P(Each, ForgivenAnimation, testing::ValuesIn(kForgiven),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(AnimationFaults, WeightsOfAMeshWithoutTargetsAreNothingKnown) {
  B builder = moving();
  channel(builder)["target"]["path"] = "weights";
  Log log(Log::Verbosity::quiet);
  (void)load(builder.glb(), log, {.at = 0.5});
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_EQ(log.warnings()[0].kind, "animation of what is not known");
}

TEST(AnimationFaults, AChannelWithoutANodeIsIgnored) {
  B builder = moving();
  channel(builder)["target"].erase("node");
  Log log(Log::Verbosity::quiet);
  (void)load(builder.glb(), log, {.strictness = Strictness::strict, .at = 0.5});
  EXPECT_EQ(log.warnings().size(), 0u);
}

}  // namespace
}  // namespace importon::test
