/// How a scene is loaded: what lights it beside the file, and how it is framed.
#pragma once
#include <optional>

#include "scene/container/file_choices.h"
#include "scene/container/uri.h"
#include "scene/instances/keep_meshes.h"
#include "scene/scene.h"

namespace importon {

/// Which environment lights the scene. Punctual lights and emitters always stay.
enum class LightChoice {
  automatic,  // the scene's; the studio where the scene has no light that shows anything, or is a model that glows
  scene,      // the scene's; without light it is an error
  studio      // the studio instead of the scene's
};

struct LoadOptions {
  LightChoice light = LightChoice::scene;
  std::optional<EnvironmentMap> environment = std::nullopt;  // stands in for the file's own
  double environmentRotation = 0;                            // degrees: scene/environment.h
  double frameAspect = kFrameAspect;                         // width over height that a camera of our own frames for
  FileChoices file{};                                        // which scene and variant, how strictly read
  OutsideFiles outside = OutsideFiles::refused;              // may buffers and images lie outside the file's folder?

  bool listsAnimations = false;  // fills Scene::animations
  KeepRule keep{};               // which meshes are kept once for all their instances

  static constexpr double kFrameAspect = 4.0 / 3.0;
};

}  // namespace importon
