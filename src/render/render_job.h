/// All settings of one render, as the command line gives them.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/tone_curve.h"
#include "scene/load_options.h"

namespace importon {

enum class Integrator { photon, path };
enum class PixelFilter { box, gaussian, blackmanHarris };  // kFilter* of shared/features.h
enum class DensityControl { off, density, probability };
enum class ImportanceChoice { map, differentials };
enum class DifferentialBound {
  pixel,
  screen
};  // of required density: the most that a path nearby asks for, or the sum
enum class GatherSource { cells, photons };
enum class Acceptance { step, cosine };                 // kAccept* of shared/render_data.h
enum class PowerShares { count, distance, direction };  // kShare*
enum class MapLookup { radius, nearest };
enum class IrradianceCache { off, photons, importons };  // where irradiance of the global map is precomputed
enum class EmissionChoice { automatic, power, guided };
/// What required density of the caustic map knows beside importance: what light is there besides, or which light glossy
/// surfaces show.
enum class RequiredBy { importance, contribution, direction };
enum class ScatterChoice { material, guided };  // by what photons scatter: the material alone, or a guide too
enum class GuideWeight { importance, deficit, potential };  // what guided emission follows
enum class PhotonsShot { all, enough };  // of a pass: all that it may have, or what important places require

/// A part of the image, pixels from the upper left corner.
struct Crop {
  int x = 0, y = 0, width = 1, height = 1;
};

/// Pictures of a sequence, by their numbers.
struct FrameRange {
  std::int64_t first = 0, last = 0;
};

/// Unset optionals are chosen automatically. Names follow the options of `importon render`, each of which has a row in
/// render/options/option_table.cpp.
struct RenderJob {
  std::filesystem::path scene;
  std::filesystem::path output;
  std::filesystem::path png;         // or JPEG; empty: none
  Look look;                         // of pictures for screens
  bool hasHalfColors = false;        // in OpenEXR
  std::optional<int> width, height;  // pixels
  std::optional<Crop> crop;          // unset: all of the image
  std::optional<double> fStop;       // focal length over the lens's diameter; unset: the camera's
  std::optional<double> focus;       // m, distance in focus; unset: the camera's
  PixelFilter filter = PixelFilter::box;
  std::string camera;        // name or index; empty: the first
  std::string sceneName;     // which scene of the file, by name or index; empty: the file's choice
  std::string variant;       // of KHR_materials_variants; empty: none
  std::optional<double> at;  // s: the pose of the animations; unset: the pose at rest
  std::string animation;     // which one plays, by name or index; empty: all
  bool isStrict = false;     // small faults of the file are refused
  Integrator integrator = Integrator::photon;
  std::optional<int> passes;               // at most
  std::optional<double> seconds;           // wall clock since the process started
  std::optional<double> error;             // estimated relative error at which to stop
  std::optional<std::uint32_t> photons;    // emitted per pass, at most
  std::optional<std::uint32_t> importons;  // in all
  DensityControl control = DensityControl::density;
  double probabilityFloor = 0;  // ε: least probability of storing a hit, for control by probability
  ImportanceChoice importance = ImportanceChoice::map;
  DifferentialBound differentialBound = DifferentialBound::screen;
  std::optional<GatherSource> gatherFrom;  // unset: render/options/gather_source.h decides
  EmissionChoice emission = EmissionChoice::automatic;
  RequiredBy requiredBy = RequiredBy::importance;
  ScatterChoice scatter = ScatterChoice::material;
  GuideWeight guideWeight = GuideWeight::deficit;
  PhotonsShot shooting = PhotonsShot::all;
  std::optional<std::uint32_t> photonBatch;         // photons traced at once
  double causticDensity = 20, globalDensity = 1.5;  // M_r, photons per pixel footprint
  std::optional<double> constantDensity;            // photons/m², the same everywhere
  std::optional<int> redistribute;                  // M'; unset: to the photon of its cell
  Acceptance acceptance = Acceptance::step;         // of the rank quota, which --redistribute chooses
  PowerShares shares = PowerShares::count;
  std::optional<int> quota;         // Q: photons within a quota radius
  bool hasProgramLimits = false;    // density limits of the talk's author's program
  std::optional<MapLookup> lookup;  // unset: within a radius
  IrradianceCache irradiance = IrradianceCache::off;
  std::optional<int> lookupPhotons;     // M of a lookup, in both maps
  bool choosesLookups = false;          // M by what a pilot shows, for each map that lookups read
  std::optional<int> nearestImportons;  // M of the importance estimate
  std::optional<int> gather;            // final gather rays per pixel and pass
  bool sharesLight = true;              // --indirect-filter auto, off
  bool isAdaptive = true;               // more camera paths where the image is noisier
  int maxDepth = 16;                    // scattering events
  std::vector<std::string> aovs;
  std::uint32_t seed = 0;
  bool allowsOutsideFiles = false;  // the scene may name files outside its folder
  std::string device;
  int threads = 0;                                 // 0: all
  std::optional<std::uint64_t> memoryMiB;          // cap for photon maps
  std::optional<std::array<float, 3>> background;  // W/(m² sr), seen where there is no surface; unset: the environment
  bool isTransparent = false;                      // nothing is seen there, and the image has coverage as alpha
  LightChoice light = LightChoice::automatic;
  std::filesystem::path environment;  // lat-long map instead of the scene's own; empty: none
  double environmentRotation = 0;     // degrees: scene/environment.h
  std::filesystem::path stats;        // empty: none
  std::filesystem::path checkpoint;   // takes the state every minute and at the end; empty: none
  std::filesystem::path resume;       // a checkpoint to go on from; empty: none
  std::filesystem::path reference;    // adds the error against it to the statistics; empty: none
  bool validation = false;
  bool leavesCache = false;               // the user's cache folder is neither read nor written
  std::uint32_t workgroupSize = 64;       // invocations; the image does not depend on it
  bool forcesAllFeatures = false;         // every feature on: must give the same image
  std::optional<FrameRange> frames;       // of the animations; unset: one picture, or those of the turntable
  std::optional<double> framesPerSecond;  // unset: kFramesPerSecond
  std::optional<int> turntable;           // frames in which the camera goes round; unset: it stays
  bool skipsMadeFrames = false;
  bool hasSeedPerFrame = false;
  std::optional<std::int64_t> frame;  // which one of a sequence this is; unset: of none
  std::vector<std::string> commandLine;

  static constexpr double kFramesPerSecond = 24;
};

}  // namespace importon
