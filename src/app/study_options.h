/// The options of `importon study`.
#pragma once
#include "CLI/CLI.hpp"
#include "app/command_line.h"

namespace importon {

struct StudyOptions {
  std::filesystem::path scene, folder;
  std::vector<std::string> custom;  // "NAME=OPTIONS", of --config
};

/// Declares the options on `app`; parsing writes to `options`, which must outlive `app`.
void addStudyOptions(CLI::App& app, StudyOptions& options);

/// `common` are options of render that all configurations have. Throws UsageError.
[[nodiscard]] StudyCommand makeStudyCommand(const StudyOptions& options, const std::vector<std::string>& common);

}  // namespace importon
