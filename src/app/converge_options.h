/// The options of `importon converge`.
#pragma once
#include "CLI/CLI.hpp"
#include "app/command_line.h"

namespace importon {

struct ConvergeOptions {
  std::filesystem::path scene, reference, folder;
  std::vector<std::string> names;   // of --configs
  std::vector<std::string> custom;  // "NAME=OPTIONS", of --config
  std::vector<double> times;
  int seeds = 4;
  std::optional<double> referenceError;
};

/// A configuration known by name, and its options of render.
struct KnownConfig {
  const char *name, *options;
};
[[nodiscard]] std::vector<KnownConfig> knownConfigs();

/// Declares the options on `app`; parsing writes to `options`, which must outlive `app`.
void addConvergeOptions(CLI::App& app, ConvergeOptions& options);

/// `common` are options of render that all configurations have. Throws UsageError.
[[nodiscard]] ConvergeCommand makeConvergeCommand(const ConvergeOptions& options,
                                                  const std::vector<std::string>& common);

}  // namespace importon
