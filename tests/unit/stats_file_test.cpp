#include "app/stats_file.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace importon::stats_file_test {
namespace {

using Json = nlohmann::ordered_json;

RenderStats sample() {
  RenderStats stats;
  stats.deviceName = "llvmpipe";
  stats.deviceType = "cpu";
  stats.triangles = 12;
  stats.lights = 2;
  stats.features = {"mirror"};
  stats.width = 64;
  stats.height = 48;
  stats.passes = 3;
  stats.seconds.total = 1.5;
  stats.seconds.gather = 0.25;
  stats.kernels = {{"trace", 9, 12.5, 3.5}};
  stats.closestRays = 12'345'678'901'234u;
  stats.importonsEmitted = 100;
  stats.photonsEmitted = 200;
  stats.caustic = {9, 7, 5, 2, {1, 2, 3}, {1, 2, 3}};
  stats.global.hits = 11;
  stats.devicePeakBytes = 1024;
  stats.error.estimated = 0.04;
  stats.devices = {{"llvmpipe", "Mesa", "cpu", 5, 3, 200, 1024}};
  return stats;
}

Json written(const RenderStats& stats, std::span<const Warning> warnings = {}) {
  RenderJob job;
  job.scene = "room.gltf";
  job.seed = 5;
  job.commandLine = {"room.gltf", "-o", "o.exr"};
  return Json::parse(statsJson(job, stats, warnings));
}

std::vector<std::string> keysOf(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

using Keys = std::vector<std::string>;

TEST(StatsFile, HasTheKeysOfTheContract) {
  const Json json = written(sample());
  EXPECT_EQ(keysOf(json),
            (Keys{"version", "command", "seed", "device", "scene", "devices", "light", "gather_from", "image",
                  "seconds", "kernels", "rays", "importons", "photons", "memory", "error", "warnings"}));
  EXPECT_EQ(keysOf(json["device"]), (Keys{"name", "driver", "type"}));
  EXPECT_EQ(keysOf(json["devices"][0]),
            (Keys{"name", "driver", "type", "seed", "passes", "photons_emitted", "device_peak_bytes"}));
  EXPECT_EQ(keysOf(json["scene"]), (Keys{"file", "triangles", "lights", "features"}));
  EXPECT_EQ(keysOf(json["image"]), (Keys{"width", "height", "passes"}));
  EXPECT_EQ(keysOf(json["seconds"]),
            (Keys{"total", "load", "bvh", "device", "importance", "cells", "photons", "gather", "resolve", "output"}));
  EXPECT_EQ(keysOf(json["kernels"][0]), (Keys{"label", "launches", "total_ms", "compile_ms"}));
  EXPECT_EQ(keysOf(json["rays"]), (Keys{"closest", "shadow"}));
  EXPECT_EQ(keysOf(json["importons"]), (Keys{"emitted", "caustic", "global"}));
  EXPECT_EQ(keysOf(json["photons"]), (Keys{"emitted", "pilot", "caustic", "global"}));
  const Keys mapKeys{"emitted", "hits", "stored", "redistributed", "flux_hits", "flux_map"};
  EXPECT_EQ(keysOf(json["photons"]["caustic"]), mapKeys);
  EXPECT_EQ(keysOf(json["photons"]["global"]), mapKeys);
  EXPECT_EQ(keysOf(json["memory"]), (Keys{"device_peak_bytes", "photon_map_bytes", "host_peak_bytes"}));
}

TEST(StatsFile, HoldsTheValues) {
  const Json json = written(sample());
  EXPECT_EQ(json["command"], (Json{"room.gltf", "-o", "o.exr"}));
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["scene"]["file"], "room.gltf");
  EXPECT_EQ(json["scene"]["features"][0], "mirror");
  EXPECT_EQ(json["image"]["passes"], 3);
  EXPECT_EQ(json["seconds"]["gather"], 0.25);
  EXPECT_EQ(json["kernels"][0]["total_ms"], 12.5);
  EXPECT_EQ(json["kernels"][0]["compile_ms"], 3.5);
  EXPECT_EQ(json["rays"]["closest"], 12'345'678'901'234u);
  EXPECT_EQ(json["photons"]["caustic"]["redistributed"], 2);
  EXPECT_EQ(json["photons"]["caustic"]["flux_map"], (Json{1., 2., 3.}));
  EXPECT_EQ(json["photons"]["global"]["hits"], 11);
  EXPECT_EQ(json["memory"]["device_peak_bytes"], 1024);
}

TEST(StatsFile, HoldsOnlyTheErrorsThatAreKnown) {
  RenderStats stats = sample();
  EXPECT_EQ(keysOf(written(stats)["error"]), (Keys{"estimated"}));
  stats.error = {0.1, 0.2, 0.3, 0.4};
  EXPECT_EQ(keysOf(written(stats)["error"]), (Keys{"estimated", "relmse", "relmse_trimmed", "smape"}));
  EXPECT_EQ(written(stats)["error"]["relmse_trimmed"], 0.3);
  stats.error.band = 0.5;
  EXPECT_EQ(written(stats)["error"]["band"], 0.5);
  stats.error = {};
  EXPECT_EQ(written(stats)["error"], Json::object());
}

TEST(StatsFile, ListsWarnings) {
  const std::vector<Warning> warnings{{"degenerate", 4, "triangle 1 has no area"}};
  const Json json = written(sample(), warnings);
  EXPECT_EQ(json["warnings"], (Json{{{"kind", "degenerate"}, {"count", 4}, {"message", "triangle 1 has no area"}}}));
  EXPECT_EQ(written(sample())["warnings"], Json::array());
}

TEST(StatsFile, StaysJsonWithStrangeNamesAndNumbers) {
  RenderStats stats = sample();
  stats.deviceName = "caf\xe9 \"GPU\"\n";
  stats.error.relmse = std::numeric_limits<double>::infinity();
  const Json json = written(stats);
  EXPECT_TRUE(json["device"]["name"].is_string());
  EXPECT_TRUE(json["error"]["relmse"].is_null());
}

}  // namespace
}  // namespace importon::stats_file_test
