#include "report/study_pictures.h"

#include <algorithm>
#include <cmath>

#include "io/tone_map.h"
#include "report/false_color.h"
#include "report/flip.h"

namespace importon {
namespace {

constexpr double kDecades = 4;         // of a scale, downwards from its top
constexpr double kShownShare = 0.999;  // of the values that are not 0 lie below the top

/// What a layer shows, without the map's name.
struct Layer {
  const char *name, *title, *unit, *text;
};

constexpr Layer kImportons{
    "importons", "Importons", "importons per pixel",
    "Where importons lie that the camera sees: each counts a share of the pixels that would read "
    "the map there."};
constexpr Layer kImportance{"importance", "Importance Γ", "pixels/m²",
                            "Flux of importons per area: how many pixels, or shares of them, read the map there."};
constexpr Layer kRequired{"required", "Required density", "photons/m²",
                          "M_r photons for each pixel footprint, at least a floor that bounds the largest lookup."};
constexpr Layer kPhotons{"photons", "Photons stored", "photons per pixel",
                         "Photons of the last pass's map that the camera sees. Without control these are all hits."};
constexpr Layer kDensity{"density", "Density stored", "photons/m²",
                         "Photons within a lookup radius over its area, on the scale of the required density."};

const std::vector<float>& valuesOf(const StudyResult& result, const std::string& channel) {
  static const std::vector<float> kEmpty;
  const Channel* found = result.image.find(channel);
  return found != nullptr ? found->values : kEmpty;
}

/// The value below which kShownShare of the positive values lie; 0 if there is none.
double topOf(const std::vector<const std::vector<float>*>& layers) {
  std::vector<float> values;
  for (const auto* layer : layers)
    std::copy_if(layer->begin(), layer->end(), std::back_inserter(values),
                 [](float v) { return v > 0 && std::isfinite(v); });
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(kShownShare * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string channelOf(const char* layer, const std::string& map) { return layer + ("." + map) + ".Y"; }

/// The figure of one layer of one map; `scaleFrom`: the layer that sets the top of the scale. What is the same
/// in several configurations has one picture. None if all is 0.
StudyFigure figureOf(const StudyReport& report, const Layer& layer, const std::string& map, const char* scaleFrom) {
  StudyFigure figure{std::string(layer.title) + ", " + map + " map", layer.text, layer.unit, 0, 0, {}};
  const std::string channel = channelOf(layer.name, map);
  std::vector<const std::vector<float>*> own, scale;
  for (const StudyResult& result : report.results) {
    own.push_back(&valuesOf(result, channel));
    scale.push_back(&valuesOf(result, channelOf(scaleFrom, map)));
  }
  if (topOf(own) <= 0) return figure;
  figure.high = std::max(topOf(scale), 1e-30);
  figure.low = figure.high * std::pow(10, -kDecades);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto isSame = [&](const std::vector<float>* other) { return *other == *own[i]; };
    if (std::any_of(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(i), isSame)) continue;
    const Image& image = report.results[i].image;
    figure.pictures.push_back(
        {report.results[i].config.name, logColors(image.width, image.height, *own[i], figure.low, figure.high)});
  }
  return figure;
}

Image colorOf(const StudyResult& result, const std::string& layer) {
  Image color{result.image.width, result.image.height, {}, {}};
  for (const char* name : {"R", "G", "B"}) {
    const std::string channel = layer.empty() ? name : layer + "." + name;
    color.channels.push_back({name, valuesOf(result, channel)});
  }
  return color;
}

bool isBlack(const Image& image) {
  return std::all_of(image.channels.begin(), image.channels.end(), [](const Channel& c) {
    return std::all_of(c.values.begin(), c.values.end(), [](float v) { return v == 0; });
  });
}

/// The light of a layer (empty: the image) in every configuration, with the exposure of the first one.
StudyFigure lightFigure(const StudyReport& report, const std::string& title, const std::string& text,
                        const std::string& layer) {
  StudyFigure figure{title, text, "", 0, 0, {}};
  const Image first = colorOf(report.results.front(), layer);
  if (isBlack(first)) return figure;
  const Look& look = report.results.front().config.job.look;
  const float exposure = exposureOf(look, first, title);
  for (const StudyResult& result : report.results)
    figure.pictures.push_back({result.config.name, shownPixels(colorOf(result, layer), exposure, look.toneMap, title)});
  return figure;
}

/// LDR-FLIP of every other image against the first one.
StudyFigure differenceFigure(const StudyReport& report) {
  const StudyResult& first = report.results.front();
  StudyFigure figure{"Difference of the images",
                     "LDR-FLIP against the first way to render: what an eye sees when one "
                     "image is shown after the other. Noise counts too.",
                     "FLIP",
                     0,
                     1,
                     {}};
  const float exposure = autoExposure(colorOf(first, ""), "image");
  const ShownImage shown = toneMapped(colorOf(first, ""), exposure, "image");
  for (std::size_t i = 1; i < report.results.size(); ++i) {
    const Image image = colorOf(report.results[i], "");
    figure.pictures.push_back(
        {report.results[i].config.name + " against " + first.config.name,
         falseColors(image.width, image.height, ldrFlipMap(toneMapped(image, exposure, "image"), shown))});
  }
  return figure;
}

}  // namespace

PngPixels logColors(int width, int height, std::span<const float> values, double low, double high) {
  std::vector<float> shares;
  shares.reserve(values.size());
  const double range = std::log(high / low);
  for (const float value : values)
    shares.push_back(value > 0 ? static_cast<float>(std::log(static_cast<double>(value) / low) / range) : 0.F);
  return falseColors(width, height, shares);
}

std::vector<StudyFigure> studyFigures(const StudyReport& report) {
  std::vector<StudyFigure> figures;
  if (report.results.empty()) return figures;
  const auto add = [&](StudyFigure figure) {
    if (!figure.pictures.empty()) figures.push_back(std::move(figure));
  };
  for (const std::string map : {"caustic", "global"}) {
    add(figureOf(report, kImportons, map, "importons"));
    add(figureOf(report, kImportance, map, "importance"));
    add(figureOf(report, kRequired, map, "required"));
    add(figureOf(report, kPhotons, map, "photons"));
    add(figureOf(report, kDensity, map, "required"));
    add(lightFigure(report, "The " + map + " map seen directly",
                    "Light that surfaces reflect by the map alone, without a final gather.", "radiance." + map));
  }
  add(lightFigure(report, "Image", "With the exposure of the first one.", ""));
  add(differenceFigure(report));
  return figures;
}

}  // namespace importon
