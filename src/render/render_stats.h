/// What a render counts and measures, as plain data; `--stats` writes it as JSON (app/stats_file.h).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace importon {

/// Device time of all launches of one label.
struct KernelStats {
  std::string label;
  std::uint64_t launches = 0;
  double milliseconds = 0;
  double compileMilliseconds = 0;  // CPU time, of all kernels of the label that the device has compiled so far
};

/// One photon map. Counts are sums over passes.
struct PhotonMapStats {
  std::uint64_t emitted = 0;         // photons
  std::uint64_t hits = 0;            // on surfaces of the kind that the map holds
  std::uint64_t stored = 0;          // photons in the map that the gather reads
  std::uint64_t redistributed = 0;   // hits that gave their power away
  std::array<double, 3> fluxHits{};  // W per pass, RGB
  std::array<double, 3> fluxMap{};   // W per pass, RGB, as it stands in the map
};

/// Wall-clock seconds. `cells`: cutting surfaces into cells; `resolve`: making images and estimates of the film.
struct PhaseSeconds {
  double total = 0, load = 0, bvh = 0, device = 0, importance = 0, cells = 0, photons = 0, gather = 0, resolve = 0,
         output = 0;
};

/// The error against a reference after a pass.
struct ErrorPoint {
  int pass = 0;        // passes done
  double seconds = 0;  // since the process started, without measuring
  double relmse = 0, relmseTrimmed = 0, smape = 0;
};

/// What is known of the error; empty where nothing is.
struct ErrorStats {
  std::optional<double> estimated, relmse, relmseTrimmed, smape;
  std::vector<ErrorPoint> passes = {};        // where there is a reference
  std::optional<double> low = {}, high = {};  // 90 % band of the true error
  std::optional<double> band = {};            // report/plain_surfaces.h, percent
};

/// What one of the devices of a render did.
struct DeviceStats {
  std::string name, driver, type;
  std::uint32_t seed = 0;
  int passes = 0;
  std::uint64_t photonsEmitted = 0;
  std::uint64_t peakBytes = 0;
};

/// Of a render on several devices: sums over them, of seconds in phases on devices the mean, and of device and name
/// the first.
struct RenderStats {
  std::string deviceName, deviceDriver, deviceType;
  std::uint64_t triangles = 0, lights = 0;
  std::vector<std::string> features;  // names of the features that are modelled
  std::string light;                  // what lights the scene: scene or studio
  std::string gatherFrom;             // what gather rays read: cells, photons or none
  int width = 0, height = 0, passes = 0;
  PhaseSeconds seconds;
  std::vector<KernelStats> kernels;  // in order of first use
  std::uint64_t closestRays = 0, shadowRays = 0;
  std::uint64_t importonsEmitted = 0, importonsCaustic = 0, importonsGlobal = 0;
  std::uint64_t photonsEmitted = 0;
  std::uint64_t photonsPilot = 0;  // in no map: they teach, or their hits are only counted
  PhotonMapStats caustic, global;
  std::uint64_t devicePeakBytes = 0, hostPeakBytes = 0;
  /// Device memory that the photon maps hold at the end: photons, their flux and grids, tables of cells, precomputed
  /// irradiance, expected density, surface cells. Not the lists that all phases share.
  std::uint64_t photonMapBytes = 0;
  ErrorStats error;
  std::vector<DeviceStats> devices;  // that are left at the end
};

}  // namespace importon
