/// What a guide makes of what it learned: a probability mass function over its cells, and how far it can be trusted.
#pragma once
#include <span>
#include <vector>

#include "render/render_job.h"

namespace importon {

/// Photons of so many passes train guides, beside a pilot.
inline constexpr int kTrainingPasses = 4;

/// A mixture of what was learned with a defensive pmf, which goes by power and a little of it evenly, so that no cell
/// has probability zero.
struct GuidePmf {
  std::vector<double> cells;   // sum 1
  double defensiveWeight = 0;  // of the defensive pmf
  double gain = 1;             // variance by power over variance by this pmf, for photons that did not train it
};

/// Each of bins x bins cells with its neighbours in the same group: half from itself, half from the eight around.
[[nodiscard]] std::vector<double> smoothBins(const std::vector<double>& moments, std::size_t groups, int bins);

/// Probabilities of the cells of each light before anything was learned: half by power, half the same for each light,
/// so that one which much stronger ones outshine, whose light may reach nothing, is learned of too.
[[nodiscard]] std::vector<double> startingPmf(const std::vector<double>& powers, std::size_t cellsPerLight);

/// Probabilities of the bins x bins cells of each light: the root of the learned second moment, smoothed, mixed with
/// the defensive pmf. `moments`: of each cell; `powers`: of the lights, sum 1. With GuideWeight::potential they go by
/// the moments themselves: as much as photons bring to important places, whatever it does to noise. [Peter and Pietrek
/// 1998]
[[nodiscard]] std::vector<double> guidePmf(const std::vector<double>& moments, const std::vector<double>& powers,
                                           int bins, GuideWeight guideWeight, double defensiveWeight);

/// The pmf of what both halves of the photons learned. The defensive weight is the one with which the pmf of each half
/// makes least variance for the other half: so a guide stays off that learned nothing which holds for other photons.
/// For GuideWeight::potential it is the least one.
[[nodiscard]] GuidePmf chooseGuidePmf(const std::vector<double>& evenMoments, const std::vector<double>& oddMoments,
                                      const std::vector<double>& powers, int bins, GuideWeight guideWeight);

}  // namespace importon
