// A validation layer that says nothing may be one that is not there: provoke it.
#include <gtest/gtest.h>

#include "gpu/kernel.h"
#include "support/gpu_test.h"
#include "test_kernels/registry.h"

namespace importon::gpu {
namespace {

class Validation : public test::GpuTest {};

TEST_F(Validation, ReportsAFeatureThatWasNotEnabledAndForgetsItOnceTaken) {
  Context own({.validation = true});
  EXPECT_TRUE(own.takeValidationMessages().empty());
  const Kernel kernel(own, "needs int64", test_kernels::code("needs_int64"));
  kernel.compile();
  const auto messages = own.takeValidationMessages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages[0].find("Int64"), std::string::npos) << messages[0];
  EXPECT_TRUE(own.takeValidationMessages().empty());
}

TEST_F(Validation, SaysNothingWhenItIsOff) {
  Context own({.validation = false});
  const Kernel kernel(own, "needs int64", test_kernels::code("needs_int64"));
  kernel.compile();
  EXPECT_TRUE(own.takeValidationMessages().empty());
}

}  // namespace
}  // namespace importon::gpu
