/// How a photon map decides which hits it stores.
#pragma once
#include "render/render_job.h"
#include "shared/render_data.h"

namespace importon {

class ExpectedDensity;

struct StorageRule {
  DensityControl control = DensityControl::density;
  uint receivers =
      0;  // M' nearest photons that share the power of a rejected hit, by the rank quota; 0: that of its cell
  const ExpectedDensity* expected = nullptr;  // for control by probability
  float probabilityFloor = 0;
  uint acceptance = kAcceptStep;  // of the quota
  uint shares = kShareEqual;
  uint fewest = 0;  // so many neighbours count as none
};

}  // namespace importon
