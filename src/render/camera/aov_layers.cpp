#include "render/camera/aov_layers.h"

#include "render/camera/point_layer.h"
#include "render/film/aov_image.h"
#include "render/options/aov_table.h"

namespace importon {
namespace {

/// Photons or importons within each pixel; 0 without a map.
std::vector<float> countInPixels(PassContext& context, AovSource source, const PhotonSystem& system,
                                 std::span<const float> aovs) {
  if (!system.map || !system.map->isFinished()) return std::vector<float>(context.pixels());
  if (source == AovSource::photons)
    return countPoints(system.map->readPoints(context.stage()), 1, context.parameters, aovs);
  return countPoints(system.importance.readPoints(), static_cast<float>(kImportonsPerSite), context.parameters, aovs);
}

}  // namespace

void addAovs(PassContext& context, const CameraPass& camera, const EyeMaps& maps, const PhotonSystem& caustic,
             const PhotonSystem& global, const FilmLayers& film, Image& image) {
  if (context.job.aovs.empty()) return;
  const std::vector<float> values = camera.traceAovs(maps);
  for (const std::string& name : context.job.aovs) {
    const AovSource source = aovRow(name).source;
    const PhotonSystem& system = name.ends_with("global") ? global : caustic;
    if (source == AovSource::importons || source == AovSource::photons)
      image.channels.push_back({name + ".Y", countInPixels(context, source, system, values)});
    else
      addAovLayer(image, name, film, values, context.scene.worldFromRender);
  }
}

}  // namespace importon
