#include "gpu/context.h"

#include "gpu/device.h"

namespace importon::gpu {

Context::Context(const ContextOptions& options)
    : impl_(std::make_unique<Impl>(Impl{std::make_shared<Device>(options)})) {}

Context::~Context() = default;

const DeviceInfo& Context::info() const { return impl_->device->info(); }
const Limits& Context::limits() const { return impl_->device->limits(); }
bool Context::isLost() const { return impl_->device->isLost(); }
std::uint64_t Context::allocatedBytes() const { return impl_->device->allocatedBytes(); }
std::uint64_t Context::peakBytes() const { return impl_->device->peakBytes(); }

std::vector<std::string> Context::takeValidationMessages() { return impl_->device->validationLog().take(); }

}  // namespace importon::gpu
