/// The Vulkan instance, device and queue. Nothing outside src/gpu includes Vulkan headers: the handles stay
/// behind the Impl pointers.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace importon::gpu {

struct DeviceInfo {
  std::string name, driver, type;  // type: discrete, integrated, virtual, cpu, other
  std::uint32_t apiVersion = 0;
  std::string missing;  // names of missing needed features; empty: usable
  bool isDefault = false;
  std::string identity;  // the same for a device that several drivers show; empty: not known
  bool isTwin = false;   // an earlier one that is usable has this identity, and nobody has chosen the drivers
};

/// What a design may depend on, as the device reports it.
struct Limits {
  std::uint64_t maxStorageBufferRange = 0;  // bytes
  std::uint64_t maxTexelBufferElements = 0;
  bool hasLargeTexelBuffers = false;  // else kernels read the same as storage buffers
  bool roundsDivision = false;        // quotients and roots to the nearest float; else kernels do (rounded_division.h)
  std::uint64_t maxAllocation = 0;    // bytes
  std::uint32_t maxWorkgroupCountX = 0;
  std::uint32_t maxWorkgroupSize = 0;
  std::uint64_t heapBytes = 0;    // of the heap that device-local buffers live in
  double nanosecondsPerTick = 0;  // 0: no timestamps
  bool isCpu = false;
};

struct ContextOptions {
  std::string device{};                 // name (part of it, any case) or index, of one; empty: the default
  bool validation = false;              // validation layers with synchronization validation
  bool stagesTransfers = false;         // copy through staging memory even where buffers can be mapped (for tests)
  std::filesystem::path cacheFolder{};  // keeps what the driver makes of kernels (pipeline_file.h); empty: nothing does
  std::uint64_t kernels = 0;            // a hash of their code
  bool operator==(const ContextOptions&) const = default;
};

/// One device, one compute queue. Throws DeviceError.
class Context {
 public:
  explicit Context(const ContextOptions& options);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const DeviceInfo& info() const;
  [[nodiscard]] const Limits& limits() const;
  /// True once the device was found lost: nothing works on it any more.
  [[nodiscard]] bool isLost() const;
  /// Bytes of device memory now allocated through this context, and their peak.
  [[nodiscard]] std::uint64_t allocatedBytes() const;
  [[nodiscard]] std::uint64_t peakBytes() const;
  /// Validation messages (errors and warnings) since the last call; tests fail on any.
  [[nodiscard]] std::vector<std::string> takeValidationMessages();

  struct Impl;
  [[nodiscard]] Impl& impl() const { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// All devices of this machine, usable or not, with the default one marked: the first discrete GPU, else
/// integrated, else virtual, else a CPU device. Throws DeviceError when there is no driver or no device.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

}  // namespace importon::gpu
