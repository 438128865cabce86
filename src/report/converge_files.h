/// What `importon converge` writes.
#pragma once
#include <string>

#include "report/converge.h"

namespace importon {

/// About the run as a whole, for the files.
struct ConvergeTitle {
  std::string version, scene, reference;
  int seeds = 0;
  std::vector<double> budgets;
  std::optional<double> referenceError;  // trimmed relMSE of the reference's own noise, if known
};

/// results.json: all runs with all points, summaries, levels and times to equal error.
[[nodiscard]] std::string convergeJson(const ConvergeTitle& title, const ConvergeReport& report);

/// results.csv: a row for each point: config, seed, budget, seconds, passes, photons_emitted, photons_stored,
/// device_peak_bytes, photon_map_bytes, relmse, relmse_trimmed, smape, rmse, mean_ratio.
[[nodiscard]] std::string convergeCsv(const ConvergeReport& report);

/// index.html: plots, images side by side and tables, with all that they need in the file itself. A mean whose interval
/// reaches beyond a factor of two is shown as not known, an error of which the reference's own makes more than a tenth
/// as an upper bound.
[[nodiscard]] std::string convergePage(const ConvergeTitle& title, const ConvergeReport& report,
                                       const Image& reference);

}  // namespace importon
