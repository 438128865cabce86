/// All kernels of a render, specialised by the scene's features.
#pragma once
#include <string>

#include "gpu/kernel.h"
#include "render/features/feature_set.h"

namespace importon {

struct KernelSet {
  gpu::Kernel setCounter, addCounter, compactCount, scan, compactScatter, sortCount, sortScatter, gridCells, gridPoints;
  gpu::Kernel traceClosest, traceShadow;
  gpu::Kernel eyeEmit, eyeScatter, eyeLight, mapLookup, filmAdd, aovSurface, aovMap;
  gpu::Kernel mapNearest, mapIrradiance, irradianceEstimate, aovAsk, aovAnswer;
  gpu::Kernel importonEmit, importonDifferential, importonBound, importonScatter, importonCount, importonLevel,
      importonEntries, importonPoints, importonDensity, importonKey, importonResolve;
  gpu::Kernel photonEmit, photonEmitGuided, photonScatter, causticScatter, guideLearn, irradianceAdd, aovCells, siteAsk;
  gpu::Kernel cellGroup, cellSmooth;
  gpu::Kernel photonScatterGuided, siteEmit, scatterLearn;  // where photons scatter by a guide
  gpu::Kernel recordSelect, hitCount, hitKey, photonQuota, photonStore, photonThin, pilotCount, photonKey,
      photonEntries, photonEntryPoints, photonRedistribute, photonResolve, fluxSum;
  gpu::Kernel cellFind, cellClaim, cellSettle, cellAdd, cellMove;
};

/// Those that `features` and the job's integrator may call for; each is compiled when it is first used.
[[nodiscard]] KernelSet makeKernels(gpu::Context& context, const FeatureSet& features, const RenderJob& job);

/// Compiles those that the job surely calls for, in the order of use, on as many threads as the job has. Meant to run
/// beside what uses them, which waits for no more than its own. Throws DeviceError.
void compileAhead(const KernelSet& set, const FeatureSet& features, const RenderJob& job);

/// The same for any two pairs for which makeKernels makes the same kernels.
[[nodiscard]] std::string describeKernels(const FeatureSet& features, const RenderJob& job);

}  // namespace importon
