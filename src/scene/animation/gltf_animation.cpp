#include "scene/animation/gltf_animation.h"

#include <fmt/format.h>

#include <set>

#include "base/error.h"
#include "scene/animation/animated_value.h"
#include "scene/animation/gltf_sampler.h"
#include "scene/container/gltf_advice.h"
#include "scene/container/gltf_choices.h"
#include "scene/container/gltf_json.h"
#include "scene/container/gltf_schema.h"
#include "scene/container/gltf_schema_rules.h"

namespace importon {
namespace {

using Json = nlohmann::json;

/// Moves one document to one time.
class Poser {
 public:
  Poser(GltfDocument& document, double seconds, Log& log) : document_(document), seconds_(seconds), log_(log) {}

  void play(std::size_t animation) {
    const Json& channels = document_.json["animations"][animation]["channels"];
    for (std::size_t i = 0; i < channels.size(); ++i) playChannel(animation, i);
  }

 private:
  void playChannel(std::size_t animation, std::size_t index) {
    const std::string pointer = fmt::format("/animations/{}/channels/{}", animation, index);
    const Json channel = document_.json["animations"][animation]["channels"][index];
    const std::optional<std::string> moved = pointerOf(channel, pointer);
    if (!moved) return;
    const std::optional<AnimatedValue> value = findAnimatedValue(document_.json, *moved);
    if (!value) {
      log_.warn("animation of what is not known",
                fmt::format("{}: '{}' is nothing that importon knows and that is there; it stays at rest",
                            document_.source.at(pointer), printable(*moved)));
      return;
    }
    if (isOverruled(*value)) {
      document_.faults.forgive("animated matrix", pointer + "/target",
                               fmt::format("the node of '{}' has a matrix", *moved), "it stays at rest");
      return;
    }
    const KeyTrack track = readTrack(animation, channel, pointer, *value);
    if (track.times.empty()) {
      document_.faults.forgive("channel without keys", pointer, "the channel has no keys", "it moves nothing");
      return;
    }
    if (!moved_.insert(*moved).second) {
      log_.warn("moved twice", fmt::format("{}: '{}' is moved by two channels, and the last of them counts; "
                                           "--animation chooses one animation",
                                           document_.source.at(pointer), printable(*moved)));
    }
    setAnimatedValue(document_.json, *value, valueAt(track, seconds_));
  }

  /// A node's matrix goes before its translation, rotation and scale.
  [[nodiscard]] bool isOverruled(const AnimatedValue& value) const {
    const std::string& key = value.place.back();
    return (key == "translation" || key == "rotation" || key == "scale") &&
           document_.json.contains(value.place.parent_pointer() / "matrix");
  }

  KeyTrack readTrack(std::size_t animation, const Json& channel, const std::string& pointer,
                     const AnimatedValue& value) {
    constexpr std::size_t kMostNumbers = std::size_t{1} << 28;
    const auto sampler = static_cast<std::size_t>(integerOr(channel, "sampler", 0));
    const Json& samplers = document_.json["animations"][animation]["samplers"];
    if (sampler >= samplers.size())
      throw SceneError(fmt::format("index {} is not among the {} samplers", sampler, samplers.size()),
                       document_.source.at(pointer + "/sampler"), kExportAgain);
    KeyTrack track = readKeyTrack(document_, samplers[sampler],
                                  fmt::format("/animations/{}/samplers/{}", animation, sampler), value);
    numbers_ += track.times.size() + track.values.size();
    if (numbers_ > kMostNumbers)
      throw SceneError(fmt::format("the animations have more than {} numbers", kMostNumbers),
                       document_.source.at("/animations"), "choose one with --animation, or reduce them");
    return track;
  }

  /// The JSON pointer of what a channel moves; none: nothing, of which it has told.
  [[nodiscard]] std::optional<std::string> pointerOf(const Json& channel, const std::string& place) const {
    const Json& target = member(channel, "target");
    const std::string path = stringOr(target, "path", "");
    if (path == "pointer") return stringOr(member(target, "extensions", "KHR_animation_pointer"), "pointer", "");
    const int node = integerOr(target, "node", -1);
    if (node < 0) {  // glTF 2.0, section 5.6: such a channel should be ignored
      log_.detail(fmt::format("{}: the channel moves no node", document_.source.at(place)));
      return std::nullopt;
    }
    if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") {
      document_.faults.forgive("unknown path of an animation", place + "/target/path",
                               fmt::format("'{}' is nothing that a node has", printable(path)), "it moves nothing");
      return std::nullopt;
    }
    return fmt::format("/nodes/{}/{}", node, path);
  }

  GltfDocument& document_;
  double seconds_;
  Log& log_;
  std::set<std::string> moved_;
  std::size_t numbers_ = 0;
};

std::size_t animationCount(const GltfDocument& document) {
  const Json& animations = member(document.json, "animations");
  return animations.is_array() ? animations.size() : 0;
}

double durationOf(const GltfDocument& document, std::size_t animation) {
  double duration = 0;
  const Json& samplers = document.json["animations"][animation]["samplers"];
  for (std::size_t i = 0; i < samplers.size(); ++i) {
    const std::string pointer = fmt::format("/animations/{}/samplers/{}", animation, i);
    const std::vector<float> times = readKeyTimes(document, samplers[i], pointer);
    if (!times.empty()) duration = std::max(duration, double{times.back()});
  }
  return duration;
}

}  // namespace

void poseDocument(GltfDocument& document, const FileChoices& choices, Log& log) {
  if (!choices.at) return;
  checkSchema(document.json, document.source, document.faults, animationRules());
  const std::optional<std::size_t> chosen = chooseAnimation(document.json, choices.animation);
  const std::size_t count = animationCount(document);
  if (count == 0) {
    log.warn("no animation", fmt::format("{}: nothing moves, at any time", document.source.name()));
    return;
  }
  Poser poser(document, *choices.at, log);
  for (std::size_t i = 0; i < count; ++i)
    if (!chosen || i == *chosen) poser.play(i);
  rereadModel(document);
  document.isPosed = true;
}

std::vector<AnimationSummary> describeAnimations(GltfDocument& document, Log& log) {
  std::vector<AnimationSummary> summaries;
  try {
    checkSchema(document.json, document.source, document.faults, animationRules());
  } catch (const SceneError& error) {
    log.warn("broken animation", error.what());
    return summaries;
  }
  for (std::size_t i = 0; i < animationCount(document); ++i) {
    const Json& animation = document.json["animations"][i];
    AnimationSummary& summary = summaries.emplace_back();
    summary.name = printable(stringOr(animation, "name", ""));
    for (const Json& channel : member(animation, "channels"))
      ++summary.channels[printable(stringOr(member(channel, "target"), "path", "unknown"))];
    try {
      summary.duration = durationOf(document, i);
    } catch (const SceneError& error) {
      log.warn("broken animation", error.what());
    }
  }
  return summaries;
}

}  // namespace importon
