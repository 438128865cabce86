/// What a guide makes of what it learned: shares of photons for its cells, and how far they can be trusted.
#pragma once
#include <span>
#include <vector>

#include "render/render_job.h"

namespace importon {

/// Shares of the cells of a guide, and what they promise.
struct GuideShares {
  std::vector<double> cells;  // sum 1
  double plainShare = 0;      // of photons that go by power, a little of it evenly, so that nothing has probability zero
  double gain = 1;            // variance by power over variance by these shares, as photons show that did not teach them
};

/// Each of bins x bins cells with its neighbours in the same group: half from itself, half from the eight around.
[[nodiscard]] std::vector<double> smoothBins(const std::vector<double>& moments, std::size_t groups, int bins);

/// Shares for `lights` lights of `bins` x `bins` cells, by the root of the learned second moment, smoothed; `plainShare`
/// goes by power, and some of that evenly. `moments`: of each cell; `powers`: of the lights, sum 1.
/// With GuideWeight::potential the shares go by the moments themselves: as much as photons bring to important places,
/// whatever it does to noise. [Peter and Pietrek 1998]
[[nodiscard]] std::vector<double> shareOut(const std::vector<double>& moments, const std::vector<double>& powers, int bins,
                                           GuideWeight guideWeight, double plainShare);

/// Shares from what two halves of the photons taught. The plain share is the one with which shares by each half make
/// least variance for the other half: so a guide that knows nothing which holds for other photons stays off. For
/// GuideWeight::potential it is the least one.
[[nodiscard]] GuideShares chooseShares(const std::vector<double>& evenMoments, const std::vector<double>& oddMoments,
                                       const std::vector<double>& powers, int bins, GuideWeight guideWeight);

}  // namespace importon
