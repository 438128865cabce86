/// Trials before the first pass of how many photons the lookups of a map are to have: --lookup-photons auto.
#pragma once
#include "render/camera/camera_pass.h"
#include "render/photons/photon_system.h"

namespace importon {

/// Sets the number of photons in the settings of the system's map, if the job leaves it to be chosen. What is in the
/// map is lost. `maps`: what the camera sees without it.
void chooseLookups(PassContext& context, PhotonSystem& system, const CameraPass& camera, EyeMaps maps);

}  // namespace importon
