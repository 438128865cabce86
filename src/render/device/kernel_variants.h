/// Kernels that serve several purposes: a pipeline for each, specialised by a constant of its own.
#pragma once
#include "gpu/kernel.h"
#include "kernels/eye_emit.h"
#include "kernels/eye_scatter.h"
#include "kernels/importon_differential.h"
#include "kernels/photon_emit.h"
#include "kernels/photon_scatter.h"
#include "kernels/scan.h"
#include "kernels/trace.h"
#include "kernels/trace_alpha.h"
#include "kernels/trace_panes.h"
#include "shared/features.h"

namespace importon::kernels {

template <class Call, uint kId, uint kValue>
struct Variant : Call {
  static constexpr gpu::Specialization kOwn{kId, kValue};
};

struct TraceClosest : Variant<Trace, kSpecAnyHit, 0> {
  static constexpr std::string_view kLabel = "trace closest";
};
struct TraceShadow : Variant<Trace, kSpecAnyHit, 1> {
  static constexpr std::string_view kLabel = "trace shadow";
};
struct TraceClosestAlpha : Variant<TraceAlpha, kSpecAnyHit, 0> {
  static constexpr std::string_view kLabel = "trace closest";
};
struct TraceShadowAlpha : Variant<TraceAlpha, kSpecAnyHit, 1> {
  static constexpr std::string_view kLabel = "trace shadow";
};
struct TraceShadowPanes : Variant<TracePanes, kSpecAnyHit, 1> {
  static constexpr std::string_view kLabel = "trace shadow";
};
struct OneScan : Variant<Scan, kSpecWorkgroupSize, kScanThreads> {};  // a single workgroup
struct ImportonEmit : Variant<EyeEmit, kSpecEyeMode, kEyeImportons> {
  static constexpr std::string_view kLabel = "importon emit";
};
struct ImportonScatter : Variant<EyeScatter, kSpecEyeMode, kEyeImportons> {
  static constexpr std::string_view kLabel = "importon scatter";
};
struct ImportonFootprint : Variant<ImportonDifferential, kSpecEyeMode, kEyeImportons> {};
struct PhotonEmitByPower : Variant<PhotonEmit, kSpecIsGuided, 0> {};
struct PhotonEmitGuided : Variant<PhotonEmit, kSpecIsGuided, 1> {
  static constexpr std::string_view kLabel = "photon emit guided";
};
struct CausticScatter : Variant<PhotonScatter, kSpecPhotonKind, kPhotonsCaustic> {
  static constexpr std::string_view kLabel = "caustic scatter";
};
struct PhotonScatterGuided : Variant<PhotonScatter, kSpecScatterIsGuided, 1> {
  static constexpr std::string_view kLabel = "photon scatter guided";
};

}  // namespace importon::kernels
