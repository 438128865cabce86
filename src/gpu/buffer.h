/// Device memory: one allocation per buffer.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/context.h"

namespace importon::gpu {

/// How kernels may see a buffer. Every buffer can be a storage buffer, the source of an indirect dispatch, and
/// be copied; one with a texel format can also be read as a uniform texel buffer (usamplerBuffer,
/// samplerBuffer), which is not subject to maxStorageBufferRange where Limits::hasLargeTexelBuffers.
enum class TexelFormat { none, uint1, uint2, uint4, float1, float2, float4 };

/// 32-bit words of a texel; none: 0.
[[nodiscard]] std::uint32_t texelWords(TexelFormat texels);

class Buffer {
 public:
  Buffer();
  /// Allocates `bytes` rounded up to whole words or texels, at least one; not initialised. Throws DeviceError
  /// when limits or memory do not allow it, with need and limit.
  Buffer(Context& context, std::string name, std::uint64_t bytes, TexelFormat texels = TexelFormat::none);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// What it takes of the device's memory; 0 for none.
  [[nodiscard]] std::uint64_t allocatedBytes() const;
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] TexelFormat texels() const { return texels_; }
  explicit operator bool() const { return impl_ != nullptr; }

  /// Copies through staging memory and waits.
  void uploadBytes(std::span<const std::byte> data, std::uint64_t offset = 0);
  void downloadBytes(std::span<std::byte> data, std::uint64_t offset = 0) const;
  /// Sets all bytes to 0, and waits.
  void clear();
  template <class T>
  void upload(std::span<const T> data, std::uint64_t offset = 0) {
    uploadBytes(std::as_bytes(data), offset);
  }
  template <class T>
  [[nodiscard]] std::vector<T> download(std::size_t count, std::uint64_t offset = 0) const {
    std::vector<T> data(count);
    downloadBytes(std::as_writable_bytes(std::span(data)), offset);
    return data;
  }

  struct Impl;
  [[nodiscard]] Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
  std::string name_;
  std::uint64_t bytes_ = 0;
  TexelFormat texels_ = TexelFormat::none;
};

/// A buffer that holds `data`.
template <class T>
[[nodiscard]] Buffer makeBuffer(Context& context, std::string name, std::span<const T> data,
                                TexelFormat texels = TexelFormat::none) {
  Buffer buffer(context, std::move(name), data.size_bytes(), texels);
  if (!data.empty()) buffer.upload(data);
  return buffer;
}

/// A buffer of zeros.
[[nodiscard]] inline Buffer makeZeros(Context& context, std::string name, std::uint64_t bytes,
                                      TexelFormat texels = TexelFormat::none) {
  Buffer buffer(context, std::move(name), bytes, texels);
  buffer.clear();
  return buffer;
}

}  // namespace importon::gpu
