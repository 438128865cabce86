/// The layers beside the image that a job asks for.
#pragma once
#include "io/image.h"
#include "render/camera/camera_pass.h"
#include "render/photons/photon_system.h"

namespace importon {

/// Adds the job's AOVs to the image of `film`.
void addAovs(PassContext& context, const CameraPass& camera, const EyeMaps& maps, const PhotonSystem& caustic,
             const PhotonSystem& global, const FilmLayers& film, Image& image);

}  // namespace importon
