/// A study as text files: study.json and index.html.
#pragma once
#include <string>

#include "report/study.h"

namespace importon {

/// What stands above the figures.
struct StudyTitle {
  std::string version, scene;
};

/// Counts, times and errors of every configuration, as JSON.
[[nodiscard]] std::string studyJson(const StudyTitle& title, const StudyReport& report);

/// A page that needs no other file and no network.
[[nodiscard]] std::string studyPage(const StudyTitle& title, const StudyReport& report);

}  // namespace importon
