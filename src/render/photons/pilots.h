/// Pilots: photons that are in no map. They train guides, or their hits are only counted, before the first pass.
#pragma once
#include "render/photons/photon_system.h"

namespace importon {

/// Traces photons `first` .. `first + count`, and selects their records for the map of their kind.
void tracePilot(PassContext& context, const PhotonSource& source, std::uint32_t first, std::uint32_t count);

/// The first `photons` of them in batches, with `count` after each; waits for the device.
void tracePilots(PassContext& context, const PhotonSource& source, std::uint32_t photons,
                 const std::function<void()>& count);

/// Trains the guides of a system, scattering first, and drops those that do not pay.
void trainGuides(PassContext& context, PhotonSystem& system);

/// Shoots until the places that matter have what they require: as many are the photons of a pass from then on. Those of
/// the maps have other random numbers, so their mean does not depend on it. [Christensen 2003]
void findEnoughPhotons(PassContext& context, const PhotonSystem& system);

/// Counts the hits of a pass, for storage by probability.
void expectDensity(PassContext& context, PhotonSystem& system);

/// Counts hits near importons, so that the first pass reads the map with the right radius. Returns of how many photons.
[[nodiscard]] std::uint32_t countFirstHits(PassContext& context, const PhotonSystem& system);

/// Lowers the required density of the caustic map where other light drowns the caustic.
void requireLessInOtherLight(PassContext& context, PhotonSystem& caustic, const PhotonSystem& global);

}  // namespace importon
