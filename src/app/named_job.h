/// Renders with a name: the configurations of converge and study.
#pragma once
#include <string>
#include <vector>

#include "app/command_line.h"

namespace importon {

/// The job of `render SCENE` with these options, by the parser of render; `common` are options that all jobs have.
/// Throws UsageError.
[[nodiscard]] NamedJob makeNamedJob(const std::string& name, const std::string& options,
                                    const std::filesystem::path& scene, const std::vector<std::string>& common);

/// The same from "NAME=OPTIONS", as --config gives it.
[[nodiscard]] NamedJob parseNamedJob(const std::string& text, const std::filesystem::path& scene,
                                     const std::vector<std::string>& common);

/// Throws UsageError if a name is there twice.
void checkNames(const std::vector<NamedJob>& jobs);

}  // namespace importon
