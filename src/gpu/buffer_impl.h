/// What a Buffer owns.
#pragma once
#include <cstddef>
#include <memory>

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/handle.h"

namespace importon::gpu {

struct Buffer::Impl {
  std::shared_ptr<Device> device;  // shared: see Device
  BufferHandle buffer;
  MemoryHandle memory;
  BufferViewHandle view;        // empty: no texel format
  std::byte* mapped = nullptr;  // null: reached through staging
  std::uint64_t allocatedBytes = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (device) device->countRelease(allocatedBytes);
    view = {};
    buffer = {};
    memory = {};
  }
};

}  // namespace importon::gpu
