// One number per buffer, the same in every kernel (set 0). A kernel declares those that it uses
// (shaders/bindings/*.glsl).
#ifndef IMPORTON_SHARED_BINDINGS_H
#define IMPORTON_SHARED_BINDINGS_H
#include "glsl_compat.h"

SHARED_BEGIN

// The scene. "texel": bound as a uniform texel buffer (usamplerBuffer), which lavapipe reads much faster than
// a storage buffer at divergent addresses and which is not subject to its limit of 128 MiB.
SHARED_CONST uint kBindingBvhNodes = 0;        // texel uint4, three per BvhRecord
SHARED_CONST uint kBindingVertices = 2;        // texel uint4, three per vertex: DeviceVertex
SHARED_CONST uint kBindingAlbedo = 4;          // texel uint1: shared/albedo_table.h
SHARED_CONST uint kBindingTriangles = 3;       // texel uint4, one per Triangle
SHARED_CONST uint kBindingMaterials = 5;       // texel uint4, eight per Material
SHARED_CONST uint kBindingTextures = 6;        // texel uint4, four per DeviceTexture
SHARED_CONST uint kBindingTexels = 7;          // texel uint1, RGBA8
SHARED_CONST uint kBindingLights = 8;          // texel uint4, four per light: lib/light.glsl
SHARED_CONST uint kBindingLightAlias = 9;      // storage, LightAlias[]
SHARED_CONST uint kBindingLightOfTriangle = 10;  // texel uint1

SHARED_CONST uint kBindingLightTree = 62;      // texel uint4: lib/light_tree.glsl
SHARED_CONST uint kBindingEnvironment = 1;     // texel uint4, one per texel: lib/environment.glsl
SHARED_CONST uint kBindingEnvironmentAlias = 61;  // texel uint2: the same

// Ray queues. A ray stays in its slot; a queue is a list of slots.
SHARED_CONST uint kBindingRays = 11;           // Ray[]: written as storage, read as texel uint4 through kBindingRayTexels
SHARED_CONST uint kBindingRayTexels = 12;
SHARED_CONST uint kBindingHits = 13;           // Hit[], by slot
SHARED_CONST uint kBindingQueue = 14;          // storage, uint[]: slots to trace
SHARED_CONST uint kBindingCounters = 15;       // storage, uint[]

// Paths.
SHARED_CONST uint kBindingParameters = 16;     // storage, Parameters
SHARED_CONST uint kBindingPaths = 17;          // storage, PathState[], by slot
SHARED_CONST uint kBindingShadowRays = 18;     // storage, Ray[], by slot
SHARED_CONST uint kBindingShadowLight = 19;    // storage, vec4[], by slot: light that arrives if nothing is in the way
SHARED_CONST uint kBindingEyeVertices = 20;    // storage, EyeVertex[], by slot: where a map is to be looked up
SHARED_CONST uint kBindingNextQueue = 21;      // storage, uint[]
SHARED_CONST uint kBindingDispatches = 22;     // storage, DispatchArguments[], by counter
SHARED_CONST uint kBindingFilm = 23;           // storage, FilmPixel[]
SHARED_CONST uint kBindingHitTexels = 24;      // texel uint4: kBindingHits

// Lists: compaction, scan and sort.
SHARED_CONST uint kBindingKeep = 25;           // storage, uint[]: 1 where an entry stays
SHARED_CONST uint kBindingBlockSums = 26;      // storage, uint[]
SHARED_CONST uint kBindingKeysIn = 27;         // storage, uint[]
SHARED_CONST uint kBindingValuesIn = 28;
SHARED_CONST uint kBindingKeysOut = 29;
SHARED_CONST uint kBindingValuesOut = 30;

// Maps. A grid is three arrays: cells, points in cell order, and their order.
SHARED_CONST uint kBindingRecordPoints = 31;   // texel/storage MapPoint[], hits or importons as they came
SHARED_CONST uint kBindingRecords = 32;        // storage, Record[]
SHARED_CONST uint kBindingRequired = 33;       // storage, float[]: required density at each record, photons/m²
SHARED_CONST uint kBindingPoints = 35;         // texel uint4: MapPoints in cell order
SHARED_CONST uint kBindingStoredCells = 37;    // the grid of stored photons
SHARED_CONST uint kBindingStoredPoints = 38;
SHARED_CONST uint kBindingStoredOrder = 39;
SHARED_CONST uint kBindingImportonCells = 40;  // the grid of importons
SHARED_CONST uint kBindingImportonPoints = 41;
SHARED_CONST uint kBindingImportance = 43;     // texel float1: importance at each importon, pixels/m²
SHARED_CONST uint kBindingPhotonPoints = 44;   // storage, MapPoint[]: stored photons as they came
SHARED_CONST uint kBindingPhotonFlux = 45;     // storage, uint[6] each: fixed-point flux
SHARED_CONST uint kBindingMapFlux = 46;        // texel uint2: packed flux of stored photons in cell order
SHARED_CONST uint kBindingCellsOut = 47;       // storage: a grid being built
SHARED_CONST uint kBindingPointsOut = 48;
SHARED_CONST uint kBindingSelection = 49;      // storage, uint[]: indices of the records of the map at work
SHARED_CONST uint kBindingTotals = 50;         // storage, FluxTotals
SHARED_CONST uint kBindingAov = 51;            // storage, float[]
SHARED_CONST uint kBindingSelectedPoints = 53; // storage, MapPoint[]: of the selection, with their grid level
SHARED_CONST uint kBindingNeighbours = 54;     // storage, uint[]: photons within the quota radius of each hit
SHARED_CONST uint kBindingWeightsOut = 55;     // storage, float[]: pixels that each importon carries, in cell order
SHARED_CONST uint kBindingImportonHits = 57;   // texel uint1: hits near each importon in all passes so far
SHARED_CONST uint kBindingImportonHitsOut = 58;  // storage: the same
SHARED_CONST uint kBindingPhotonCells = 59;     // storage, PhotonCell[]: lib/photon_cell.glsl
SHARED_CONST uint kBindingOldPhotonCells = 60;  // storage, PhotonCell[]: the table before it grew
SHARED_CONST uint kBindingGuideRows = 63;       // texel float1: lib/guide.glsl
SHARED_CONST uint kBindingGuideColumns = 64;    // texel float1
SHARED_CONST uint kBindingGuideSums = 65;       // storage, uint[]: what was learned for each cell
SHARED_CONST uint kBindingPathDifferentials = 66;  // storage, PathDifferential[], by slot
SHARED_CONST uint kBindingFootprints = 67;      // storage, float[]: pixels/m² by the footprint of each importon record
SHARED_CONST uint kBindingBounds = 68;          // storage, float[]: pixels/m² by footprints near each site
SHARED_CONST uint kBindingImportanceBound = 69;  // texel float1: what required density is made of, at each importon
SHARED_CONST uint kBindingLightsSeen = 74;      // texel uint2 per voxel, a bit a light: lib/light_voxel.glsl
SHARED_CONST uint kBindingLightsSeenOut = 75;   // storage: the same
SHARED_CONST uint kBindingSurfaceCells = 70;    // texel uint2, one per triangle: src/render/surface_cache/surface_cells.h
SHARED_CONST uint kBindingRecordCells = 71;     // storage, uvec2[]: cell side of each photon hit, its weight there
SHARED_CONST uint kBindingIrradiance = 72;      // storage, uint[8] per cell side: fixed-point flux, photons, squares
SHARED_CONST uint kBindingIrradianceTexels = 73;  // texel uint4: the same
SHARED_CONST uint kBindingCellIrradiance = 82;     // texel uint4 per cell side: irradiance to be read, area
SHARED_CONST uint kBindingCellIrradianceOut = 83;  // storage: the same
SHARED_CONST uint kBindingCellGroups = 84;         // texel uint4: src/render/surface_cache/cell_tree.h
SHARED_CONST uint kBindingCellMembers = 85;        // texel uint1
SHARED_CONST uint kBindingCellPlaces = 86;         // texel uint2
SHARED_CONST uint kBindingGroupLight = 87;         // texel uint4, two per group's side: bindings/cell_groups.glsl
SHARED_CONST uint kBindingGroupLightOut = 88;      // storage: the same
SHARED_CONST uint kBindingWeights = 56;        // texel float1: the same
SHARED_CONST uint kBindingPathLight = 52;      // storage, PathLight[], by slot
SHARED_CONST uint kBindingLookups = 78;         // storage, uint[]: slots of paths that ask for a map lookup
SHARED_CONST uint kBindingSamplePlan = 77;      // texel uint2, one per pixel: src/render/film/adaptive_sampler.h

SHARED_CONST uint kBindingScatterGuide = 80;    // texel float1: lib/scatter_guide.glsl
SHARED_CONST uint kBindingScatterSums = 81;     // storage, uint[]: importance that came to each of its bins

SHARED_END
#endif
