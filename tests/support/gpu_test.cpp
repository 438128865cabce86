#include "support/gpu_test.h"

#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "base/error.h"

namespace importon::test {
namespace {

/// The context, or why there is none.
struct Shared {
  std::unique_ptr<gpu::Context> context;
  std::string failure;
};

const Shared& shared() {
  static const Shared instance = [] {
    Shared made;
    try {
      gpu::ContextOptions options;
      options.validation = true;
      made.context = std::make_unique<gpu::Context>(options);
    } catch (const DeviceError& error) {
      made.failure = error.what();
    }
    return made;
  }();
  return instance;
}

bool requiresVulkan() {
  const char* const value = std::getenv("IMPORTON_REQUIRE_VULKAN");
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace

gpu::Context* sharedContext() { return shared().context.get(); }

void GpuTest::SetUp() {
  if (shared().context) return;
  if (requiresVulkan()) FAIL() << shared().failure;
  GTEST_SKIP() << shared().failure;
}

void GpuTest::TearDown() {
  if (!shared().context) return;
  for (const std::string& message : shared().context->takeValidationMessages()) {
    ADD_FAILURE() << "validation: " << message;
  }
}

gpu::Context& GpuTest::context() const { return *shared().context; }

}  // namespace importon::test
