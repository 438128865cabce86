/// A door slit and a lit room in small, for the talk's claims.
#pragma once
#include "render/render_job.h"
#include "support/scene_builder.h"

namespace importon::test {

/// Two rooms and a door between them that is open by a slit; the lamp in one of them. The camera sees a corner of the
/// lit room, or what is behind the door.
[[nodiscard]] inline Scene twoRooms(bool isBehindTheDoor) {
  SceneBuilder builder;
  const uint white = builder.material(diffuse(vec3(0.6f)));
  const uint red = builder.material(diffuse(vec3(0.6f, 0.3f, 0.2f)));
  builder.box(white, {-2, -1, -1}, {2, 1, 1}, Facing::inside);
  builder.box(red, {-0.05, -1, -1}, {0.05, 1, 0.8}, Facing::outside);  // the wall, a slit of 20 cm beside it
  builder.square(builder.material(emitter(vec3(40, 36, 30))), {1, 0.98, 0}, {0, -1, 0}, 0.4);
  if (isBehindTheDoor)
    builder.camera({-0.3, 0.2, -0.7}, {-1.5, -0.4, 0.6}, 1.0, 16, 12);
  else
    builder.camera({0.4, 0, -0.6}, {1.6, -0.6, 0.6}, 1.0, 16, 12);
  return builder.finish();
}

/// One pass with gathers that read photons.
[[nodiscard]] inline RenderJob twoRoomsJob() {
  RenderJob job;
  job.passes = 1;
  job.photons = 1u << 16;
  job.importons = 1u << 13;
  job.maxDepth = 8;
  job.gather = 4;
  job.sharesLight = false;
  job.emission = EmissionChoice::power;
  job.gatherFrom = GatherSource::photons;
  return job;
}

}  // namespace importon::test
