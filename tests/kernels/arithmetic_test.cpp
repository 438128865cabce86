// Arithmetic of kernels against that of the host, bit for bit: what images with the same bits on every driver stand on
// (src/gpu/modules/portable_arithmetic.h). Denormals are open: some devices take them for zero.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "shared/elementary.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon {
namespace {

using glm::vec3;

std::uint32_t bitsOf(float x) {
  if (std::isnan(x)) return 0x7FC00000u;
  return std::abs(x) < std::numeric_limits<float>::min() ? 0 : std::bit_cast<std::uint32_t>(x);
}

float dot(vec3 a, vec3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

/// Of arithmetic.comp.
struct Operation {
  std::uint32_t id;
  const char* name;
  std::function<float(vec3)> host;
};

std::uint32_t word(vec3 v) { return std::bit_cast<std::uint32_t>(v.x); }
float clamped(float x, float low, float high) { return std::min(std::max(x, low), high); }

// Of floats of all sizes.
const std::vector<Operation> kSingle{
    {0, "a + b", [](vec3 v) { return v.x + v.y; }},
    {1, "a - b", [](vec3 v) { return v.x - v.y; }},
    {2, "a b", [](vec3 v) { return v.x * v.y; }},
    {3, "a / b", [](vec3 v) { return v.x / v.y; }},
    {4, "sqrt", [](vec3 v) { return std::sqrt(v.x); }},
    {8, "floor", [](vec3 v) { return std::floor(v.x); }},
    {9, "ceil", [](vec3 v) { return std::ceil(v.x); }},
    {10, "min", [](vec3 v) { return std::min(v.x, v.y); }},
    {11, "max", [](vec3 v) { return std::max(v.x, v.y); }},
    {12, "clamp", [](vec3 v) { return clamped(v.x, -1, 1); }},
    {13, "from uint", [](vec3 v) { return static_cast<float>(word(v)); }},
    {14, "from int", [](vec3 v) { return static_cast<float>(std::bit_cast<std::int32_t>(v.x)); }},
    {15, "to int", [](vec3 v) { return std::bit_cast<float>(static_cast<std::int32_t>(clamped(v.x, -1e9f, 1e9f))); }},
    {16, "to uint", [](vec3 v) { return std::bit_cast<float>(static_cast<std::uint32_t>(clamped(v.x, 0, 4e9f))); }},
    {18, "unorm16", [](vec3 v) { return static_cast<float>(word(v) >> 16) * (1 / 65535.0f); }},
    {19, "snorm16",
     [](vec3 v) {
       return std::max(-1.0f, static_cast<float>(std::bit_cast<std::int32_t>(v.x) >> 16) * (1 / 32767.0f));
     }},
    {20, "unorm8", [](vec3 v) { return static_cast<float>((word(v) >> 16) & 255u) * (1 / 255.0f); }},
    {26, "inversesqrt", [](vec3 v) { return 1 / std::sqrt(v.x); }},
    {27, "fract", [](vec3 v) { return v.x - std::floor(v.x); }},
    {28, "sign", [](vec3 v) { return v.x > 0 ? 1.0f : (v.x < 0 ? -1.0f : 0.0f); }},
    {29, "round", [](vec3 v) { return std::nearbyint(v.x); }},
    {32, "1 / a", [](vec3 v) { return 1 / v.x; }},
    {33, "a / 3", [](vec3 v) { return v.x / 3; }},
};

// Of floats within 2^±12, so that nothing between is a denormal.
const std::vector<Operation> kComposed{
    {5, "a b + c", [](vec3 v) { return v.x * v.y + v.z; }},
    {6, "a b - c a", [](vec3 v) { return v.x * v.y - v.z * v.x; }},
    {7, "(a + b) + (c - a)", [](vec3 v) { return (v.x + v.y) + (v.z - v.x); }},
    {21, "mix", [](vec3 v) { return v.x * (1 - v.z) + v.y * v.z; }},
    {22, "dot",
     [](vec3 v) {
       return dot(v, {v.z, v.x, v.y});
     }},
    {23, "length", [](vec3 v) { return std::sqrt(dot(v, v)); }},
    {24, "normalize", [](vec3 v) { return dot(v, v) > 0 ? v.z * (1 / std::sqrt(dot(v, v))) : v.z; }},
    {25, "cross", [](vec3 v) { return v.z * v.y - v.x * v.x; }},
    {30, "reflect",
     [](vec3 v) {
       const float d = dot({v.z, v.x, v.y}, v);
       return v.x - v.z * (d + d);
     }},
    {31, "distance",
     [](vec3 v) {
       const vec3 d{v.x - v.y, v.y - v.z, v.z - v.x};
       return std::sqrt(dot(d, d));
     }},
    {34, "a (1 - b) - (1 - b) c", [](vec3 v) { return v.x * (1 - v.y) - (1 - v.y) * v.z; }},
    {100, "cos", [](vec3 v) { return elementary::portableCos(v.x); }},
    {101, "sin", [](vec3 v) { return elementary::portableSin(v.x); }},
    {102, "exp", [](vec3 v) { return elementary::portableExp(v.x); }},
    {103, "exp2", [](vec3 v) { return elementary::portableExp2(v.x); }},
    {104, "log", [](vec3 v) { return elementary::portableLog(v.x); }},
    {105, "log2", [](vec3 v) { return elementary::portableLog2(v.x); }},
    {106, "pow", [](vec3 v) { return elementary::portablePow(std::abs(v.x), std::abs(v.y)); }},
    {107, "atan", [](vec3 v) { return elementary::portableAtan(v.x, v.y); }},
    {108, "acos", [](vec3 v) { return elementary::portableAcos(clamped(v.x, -1, 1)); }},
};

class Arithmetic : public test::GpuTest {
 protected:
  /// Triples of floats with `exponents` different exponents around 0, with zeros and equal numbers among them.
  static std::vector<vec3> inputs(std::uint32_t count, std::uint32_t exponents) {
    std::vector<vec3> items(count);
    std::uint32_t state = 1;
    const auto random = [&state] {  // [O'Neill 2014, PCG]
      state = state * 747796405u + 2891336453u;
      const std::uint32_t mixed = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
      return (mixed >> 22) ^ mixed;
    };
    for (vec3& item : items) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t bits = random(), exponent = 127 - exponents / 2 + random() % exponents;
        item[k] = std::bit_cast<float>((bits & 0x807FFFFFu) | exponent << 23);
      }
      if (random() % 64 == 0) item[static_cast<int>(random() % 3)] = (random() & 1) != 0 ? 0.0f : -0.0f;
      if (random() % 64 == 0) item.y = item.x;
    }
    return items;
  }

  void compare(const std::vector<Operation>& operations, const std::vector<vec3>& items) {
    for (const Operation& operation : operations) {
      const gpu::Specialization constants[]{{1, operation.id}};
      const auto results = test::runKernel<float>(context(), test_kernels::code("arithmetic"), items, constants);
      std::size_t wrong = 0, first = 0;
      for (std::size_t i = 0; i < items.size(); ++i)
        if (bitsOf(results[i]) != bitsOf(operation.host(items[i])) && wrong++ == 0) first = i;
      const vec3 v = items[first];
      EXPECT_EQ(wrong, 0u) << operation.name << ", where (a, b, c) is " << v.x << ", " << v.y << ", " << v.z << ", is "
                           << results[first] << " instead of " << operation.host(v);
    }
  }
};

TEST_F(Arithmetic, OfSingleOperationsHasTheBitsOfTheHost) { compare(kSingle, inputs(1u << 16, 252)); }
TEST_F(Arithmetic, OfFunctionsHasTheBitsOfTheHost) { compare(kComposed, inputs(1u << 16, 24)); }

TEST_F(Arithmetic, SlowOfSixteenMillionInputs) {
  compare(kSingle, inputs(1u << 24, 252));
  compare(kComposed, inputs(1u << 24, 24));
}

}  // namespace
}  // namespace importon
