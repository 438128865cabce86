// What moves through a pass: parameters, paths, records of hits, counters.
#ifndef IMPORTON_SHARED_RENDER_DATA_H
#define IMPORTON_SHARED_RENDER_DATA_H
#include "glsl_compat.h"

SHARED_BEGIN

/// What tells the caustic map and the global map apart.
struct MapSettings {
  float photonsPerPixel;  // M_r
  float constantDensity;  // photons/m², 0: by importance
  float densityFloor;     // photons/m²: least required density; the largest radius follows
  uint importonLevels;    // grid levels that importons are in, a bit each
  uint recordMask;        // kRecordCaustic or kRecordGlobal
  float importonFlux;     // pixels that each importon of the map started with
  float densityLimit;     // photons/m²: most required density, for what memory holds
  float lookupPhotons;    // M: photons within a lookup radius where the map has its required density
  float fewestPhotons;    // as many on average where the map is thin
  uint photonsPerPass;    // emitted for the map in this pass
  uvec2 firstPhoton;      // of the pass, counted over all passes: its place in the sequence; low word in x
  float photonsCounted;   // whose hits were counted, over photonsPerPass; 0: none yet
};

/// The same for every kernel of a pass. Lengths in m, render space.
struct Parameters {
  vec3 cameraOrigin;
  uint cameraIsOrthographic;
  vec3 cameraForward;  // unit length
  uint width;          // pixels of the film
  vec3 cameraRight;    // half the whole image's extent: at distance 1 (perspective) or in m (orthographic)
  uint height;
  vec3 cameraUp;
  uint seed;
  vec3 gridOrigin;   // lowest corner of the scene
  float gridExtent;  // power of two, at least the scene's largest side
  vec3 sceneCentre;
  float sceneRadius;
  uvec2 environmentSize;  // texels; at least 1 x 1
  uint environmentLight;  // index of the environment among the lights, kNone: none
  uint lightCount;
  float totalPower;          // W, sum of Light::power
  uint pass;                 // from 0; importance has its own random streams
  uint maxDepth;             // scattering events
  float fluxScale;           // units of fixed-point flux per W, a power of two
  float quotaPhotons;        // Q: photons within a quota radius
  uint samplesPerPass;       // camera paths, and so gather rays, of each pixel in a whole pass
  uvec2 firstSample;         // of the pass, of each pixel, counted over all passes; low word in x
  float densityScale;        // growth of D_r over passes
  float largestQuotaRadius;  // m
  float importonFlux;        // pixels that each importon starts with
  float irradianceUnits;     // of fixed-point flux per W in the irradiance map
  float photonUnits;         // per such unit: flux of an average photon is 4 of them
  float irradianceScale;     // W per photonUnit, for one pass
  vec3 background;           // W/(m² sr), seen where the camera sees no surface, if not the environment
  uvec2 imageSize;           // pixels of the whole image, of which the film may be a part
  uvec2 filmCorner;          // the film's upper left pixel there
  vec3 lensRight;            // radius of a thin lens along cameraRight, m; 0: the camera is a pinhole
  float inverseFocus;        // 1/m, of the distance along cameraForward that is in focus
  vec3 lensUp;               // as lensRight
  MapSettings causticMap;
  MapSettings globalMap;
};

/// Walker's alias table for choosing a light by its power. [Walker 1977]
struct LightAlias {
  float threshold;  // keep the entry below it, else take `other`
  uint other;
  float probability;  // of the light of this index
};

/// A path between two scattering events. Its ray is in the ray array at the same slot.
struct PathState {
  vec3 throughput;      // eye: weight against the first diffuse vertex; photon: flux in W; importon: pixels
  uint flags;           // see below
  uint id;              // eye: pixel; photon: index within the pass; importon: index
  uvec2 media;          // of the solids that the ray is in: lib/media.glsl
  float pdfSolidAngle;  // of the sampled direction, 1/sr; 0 after a specular event
  float lightWeight;    // sum of the light weights at the last vertex, for MIS
  uint source;          // photon: its light; eye: which of its pixel's paths in this pass
  float distance;       // m, length since the last non-specular vertex
};

/// A ray of importance that left the scene.
struct EscapeRecord {
  vec3 origin;   // render space, where it last met a surface
  float weight;  // what photons would bring along it; 0: the path did not leave
  vec3 direction;
  float pdf;   // of that direction in the environment by radiance, 1/sr
  vec2 place;  // the direction as two coordinates: lib/environment_guide.glsl
};
/// The environment's guide is a mixture of its leaves and of boxes around 8, 64 and 512 of them, so that what the boxes
/// of the leaves leave out has no rare and strong photons: 0.4, 0.2, 0.1 and 0.05 of the photons. The others come by
/// radiance, from anywhere, which keeps it unbiased.
SHARED_CONST uint kEscapeLevels = 4u;
SHARED_CONST uint kEscapeStep = 3u;         // from a level to the next, in levels of the tree
SHARED_CONST float kEscapeShare = 0.4f;     // of the first level; each further one has half of the last
SHARED_CONST float kGuidedEscapes = 0.75f;  // all together

/// How a path moves with one of the variables that made it: derivatives, each times the step of the variable to the
/// neighbouring path. [Suykens and Willems 2001]
struct Spread {
  vec3 position;   // of the vertex, or of the ray's origin, m
  vec3 direction;  // of the ray
  float gradient;  // of the logarithm of the path's weight
};

/// The footprint of an importon. Two variables hold all that came before the last sampled direction.
struct PathDifferential {
  Spread x;  // place in the image, steps of a pixel; later what paths before the last sampled direction covered
  Spread y;
  Spread u;  // the last sampled direction
  Spread v;
  float share;  // weight of the path in its pixel, chosen lobes included
};

// PathState::flags: low byte: scattering events so far
SHARED_CONST uint kPathDepthMask = 0xFFu;
SHARED_CONST uint kPathScattered = 0x100u;     // has had a non-specular event
SHARED_CONST uint kPathSpecular = 0x200u;      // a specular event since the last non-specular one (or the start)
SHARED_CONST uint kPathLookup = 0x400u;        // asks for a map lookup at its vertex
SHARED_CONST uint kPathLookupGlobal = 0x800u;  // of the global map; else of the caustic map
SHARED_CONST uint kPathDeep = 0x1000u;         // has gone on after its first gather ray
SHARED_CONST uint kPathShadowDeep = 0x2000u;   // its shadow ray counts as indirect light
SHARED_CONST uint kPathLookupRest = 0x8000u;   // its map lookup is for all but the diffuse light
SHARED_CONST uint kPathLookupDeep = 0x4000u;   // its map lookup counts as indirect light

/// Along each side of the scene: lib/light_voxel.glsl.
SHARED_CONST uint kLightVoxels = 64u;

/// Camera paths of a tile that are traced at once, and how many of each pixel are, at least, where a pass has so many.
SHARED_CONST uint kPathsAtOnce = 1u << 18;
SHARED_CONST uint kFewestAtOnce = 4u;

/// As many times the paths of a pass that a pixel gets in the mean, one may get at most:
/// src/render/film/adaptive_sampler.h
SHARED_CONST uint kMostPathsShare = 8u;

/// Importance is estimated at one of so many importons, from all of them.
SHARED_CONST uint kImportonsPerSite = 4u;

/// Hits near importons are counted in so many passes.
SHARED_CONST uint kCountingPasses = 8u;

/// What a path brought to its pixel in this pass, W/(m² sr); direct and caustic with their modulation, indirect
/// with it too, and the modulation apart.
struct PathLight {
  vec3 emitted;  // by what is seen, also in mirrors and through glass
  vec3 direct;
  vec3 caustic;
  vec3 indirect;
  vec3 modulation;      // throughput times reflectance at the vertex that gathered
  vec3 position;        // of that vertex, render space
  vec3 normal;          // shading normal there
  vec3 sharedPosition;  // of that vertex, or of the glass that the camera sees before it
  vec3 sharedNormal;    // geometric normal there
  uint gathers;         // 1 if there was one; kSawBackground if the camera saw no surface
};
SHARED_CONST uint kSawBackground = 2u;

/// Sums over the passes of one half (odd or even passes), W/(m² sr).
struct FilmPixel {
  vec3 emitted;  // by what is seen
  vec3 direct;
  vec3 caustic;
  vec3 indirect;  // with its modulation
  vec3 modulation;
  vec3 position;  // of the vertices that gathered
  vec3 normal;
  vec3 sharedPosition;  // of these, or of the glass that the camera sees before them
  vec3 sharedNormal;    // geometric normal there
  float gathers;        // how many there were
  vec3 square;          // of the whole radiance of a path
  float foundSquare;    // of the mean over channels of emitted, direct and caustic radiance
  float uncovered;      // how many paths saw the background (features.h), which is not the environment
};

/// Where a path asks for a map lookup.
struct EyeVertex {
  vec3 position;
  float radius;     // of the lookup, m; 0: to be found by the lookup
  vec3 throughput;  // towards the vertex
  uint triangle;
  vec3 direction;  // of the ray that came
  float u;         // barycentric weights of the hit
  float v;
};

// Floats per pixel of the AOV buffer, in this order.
SHARED_CONST uint kAovAlbedo = 0u;       // 3
SHARED_CONST uint kAovNormal = 3u;       // 3, shading normal, world
SHARED_CONST uint kAovPosition = 6u;     // 3, render space
SHARED_CONST uint kAovDepth = 9u;        // m along the ray
SHARED_CONST uint kAovEmission = 10u;    // 3
SHARED_CONST uint kAovImportance = 13u;  // caustic, global: pixels/m²
SHARED_CONST uint kAovRequired = 15u;    // caustic, global: photons/m²
SHARED_CONST uint kAovDensity = 17u;     // caustic, global: photons/m² of the last pass's map
SHARED_CONST uint kAovMapLight = 19u;    // caustic, global: 3 each, W/(m² sr) that the last pass's map holds there
SHARED_CONST uint kAovFloats = 25u;

/// A stored or storable point: photon hit, importon, photon. 16 bytes: one texel.
struct MapPoint {
  vec3 position;
  uint packed;  // direction, normal and grid level: lib/map_point.glsl
};

/// What a hit or importon carries beside its MapPoint.
struct Record {
  vec3 flux;  // photon: W; importon: pixels in x
  uint kind;  // kRecord*
};
SHARED_CONST uint kRecordNone = 0u;
SHARED_CONST uint kRecordCaustic = 1u;    // belongs to the caustic map
SHARED_CONST uint kRecordGlobal = 2u;     // belongs to the global map
SHARED_CONST uint kRecordGlossy = 4u;     // its surface does not reflect by Lambert's law alone
SHARED_CONST uint kRecordRankShift = 3u;  // above: a rank by path, then bounce, 29 bits

/// Fixed-point units of what a guide learns.
SHARED_CONST float kGuideUnits = 1024.0f;
SHARED_CONST float kMomentUnits = 17592186044416.0f;  // 2^44: of the moments that an emission guide learns
SHARED_CONST float kLargestMoment = 256.0f;           // that one photon may bring

/// Cells of a guide for scattering: voxels of the scene's box, six to a voxel, by where the surface faces. Each has
/// kScatterBins x kScatterBins bins of directions.
struct ScatterGrid {
  vec3 origin;     // m, render space
  float perMetre;  // voxels
  uvec3 voxels;
};
SHARED_CONST uint kScatterBins = 8u;
SHARED_CONST uint kScatterFacings = 6u;

// How the quota decides, and by what a rejected hit's power is shared out.
SHARED_CONST uint kAcceptStep = 0u;    // while the density is below the required one
SHARED_CONST uint kAcceptCosine = 1u;  // with a probability that falls as a cosine from 1 to 0 there
SHARED_CONST uint kShareEqual = 0u;
SHARED_CONST uint kShareByDistance = 1u;
SHARED_CONST uint kShareByDirection = 2u;

// What kernels/photon_map/flux_sum.comp sums, in the order of its totals.
SHARED_CONST uint kSumHits = 0u;
SHARED_CONST uint kSumMap = 1u;
SHARED_CONST uint kSumKept = 2u;  // hits that photon_thin kept, with their weights

/// A cell of the scene that one stored photon speaks for; see lib/photon_cell.glsl.
struct PhotonCell {
  uint keyA;  // two hashes of the cell, kNone: free
  uint keyB;
  uint photon;  // the stored photon, or kCellClaim + the least rank of the hits that found the cell empty
};
SHARED_CONST uint kCellClaim = 0x40000000u;

/// Workgroup counts of dispatches over what a counter counts: one invocation an item, or one a tile, or as many as
/// trace a queue of rays (lib/trace_queue.glsl).
struct DispatchArguments {
  uvec3 items;
  uvec3 tiles;
  uvec3 rays;
};
SHARED_CONST uint kWorkgroupSize = 64u;  // of kernels dispatched indirectly
SHARED_CONST uint kTileSize = 64u;       // entries per invocation in compaction and sort
SHARED_CONST uint kScanThreads = 128u;   // workgroup size of the scan kernel: the least that Vulkan promises
SHARED_CONST uint kRadix = 64u;          // digits of the sort
SHARED_CONST uint kRadixBits = 6u;

// Purposes of random streams, mixed with the seed.
SHARED_CONST uint kStreamPixels = 2u;
SHARED_CONST uint kStreamImportons = 3u;
SHARED_CONST uint kStreamSites = 6u;               // importance that leaves sites
SHARED_CONST uint kStreamCausticPhotons = 0x100u;  // plus the state of the guide
SHARED_CONST uint kStreamGlobalPhotons = 0x200u;
SHARED_CONST uint kStreamPilot = 0x1000u;  // added to those of photons whose hits are only counted
SHARED_CONST uint kStreamStorage = 4u;     // plus 1 for the global map: which hits are stored

// Counters: uint each
SHARED_CONST uint kCounterQueueA = 0u;
SHARED_CONST uint kCounterQueueB = 1u;
SHARED_CONST uint kCounterRecords = 2u;        // records written so far (queue entries passed)
SHARED_CONST uint kCounterSelected = 3u;       // records of the map at work
SHARED_CONST uint kCounterStored = 4u;         // photons in the map at work
SHARED_CONST uint kCounterLargestCrowd = 5u;   // most photons in a slot of a level at work
SHARED_CONST uint kCounterEntries = 6u;        // entries being sorted
SHARED_CONST uint kCounterTotal = 7u;          // result of a scan
SHARED_CONST uint kCounterOverflow = 8u;       // photons that found no room
SHARED_CONST uint kCounterRaysClosest = 9u;    // rays traced since they were last added to kSumRaysClosest
SHARED_CONST uint kCounterLevels = 11u;        // grid levels of the importons or the batch at work, a bit each
SHARED_CONST uint kCounterSites = 15u;         // importons at which importance is estimated
SHARED_CONST uint kCounterStoredLevels = 14u;  // grid levels of the stored photons at work, a bit each
SHARED_CONST uint kCounterLookups = 12u;       // paths that ask for a map lookup at the depth at work
SHARED_CONST uint kCounterAccepted = 13u;      // hits accepted now
// What each map keeps between batches: kCounterMap + kCountersPerMap · (0 caustic, 1 global) + which.
SHARED_CONST uint kCounterMap = 16u;
SHARED_CONST uint kCountersPerMap = 6u;
SHARED_CONST uint kMapStored = 0u;
SHARED_CONST uint kMapOverflow = 1u;  // photons that found no room
SHARED_CONST uint kMapLevels = 2u;    // grid levels of the finished map, a bit each
SHARED_CONST uint kMapHits = 4u;      // a sum of two words
// Of the irradiance map in this pass.
SHARED_CONST uint kCounterCellsLit = 41u;  // cell sides that had their first photon
// Sums that may pass 2^32 in a pass: two words each, the low one first.
SHARED_CONST uint kSumRaysClosest = 44u;
SHARED_CONST uint kSumRaysShadow = 46u;
SHARED_CONST uint kSumCellHits = 48u;
SHARED_CONST uint kCounterCount = 64u;

SHARED_END
#endif
