// Push constants of the kernels.
#ifndef IMPORTON_SHARED_PUSH_DATA_H
#define IMPORTON_SHARED_PUSH_DATA_H
#include "glsl_compat.h"
#include "render_data.h"

SHARED_BEGIN

/// kernels/lists/add_counter.comp
struct AddCounterPush {
  uint counter;
  uint sum;      // its low word; the high one follows
  uint empties;  // 1: the counter is 0 afterwards
};

/// kernels/lists/compact_count.comp
struct CompactCountPush {
  uint source;
};

/// kernels/lists/compact_scatter.comp
struct CompactScatterPush {
  uint source;
  uint takesIndex;  // 1: writes the index of an entry; 0: the queue's value there
};

/// kernels/camera/eye_emit.comp
struct EyeEmitPush {
  uint first;     // pixel or importon
  uint count;
  uint pixels;    // of the tile, or importons
  uint firstSample;  // of each pixel's paths in this pass, or of the plan's paths
  uint total;     // importons in all
  uint isCentred; // 1: through the middle of the pixel
  uint isPlanned; // 1: pixels have as many paths as the sample plan says
};

/// kernels/camera/eye_light.comp
struct EyeLightPush {
  uint source;
};

/// kernels/camera/eye_scatter.comp
struct EyeScatterPush {
  uint source;
  uint knowsImportance;
};

/// kernels/photon_map/flux_sum.comp
struct FluxSumPush {
  uint what;    // kSum*
  uint source;
};

/// kernels/lists/grid_cells.comp
struct GridCellsPush {
  uint source;
  uint slotMask;
};

/// kernels/lists/grid_points.comp
struct GridPointsPush {
  uint source;
};

/// kernels/guiding/guide_learn.comp
struct GuideLearnPush {
  uint isGlobal;
  uint stream;
  uint bins;
  float meanImportance;  // pixels/m²
  float hitsPerPass;     // for each hit that was counted at a site; 0: deficits do not matter
  uint isPotential;      // places count in proportion to their importance
};

/// kernels/importance/hit_count.comp
struct HitCountPush {
  uint isGlobal;
  uint weight;  // hits that each stands for
};

/// kernels/photon_map/hit_key.comp
struct HitKeyPush {
  uint isGlobal;
  uint slotMask;
  uint isControlled;
};

/// kernels/importance/importon_bound.comp
struct ImportonBoundPush {
  uint levels;
};

/// kernels/importance/importon_count.comp
struct ImportonCountPush {
  uint slotMask;
};

/// kernels/importance/importon_density.comp
struct ImportonDensityPush {
  uint levels;
  uint nearest;
};

/// kernels/importance/importon_differential.comp
struct ImportonDifferentialPush {
  uint source;
};

/// kernels/importance/importon_entries.comp
struct ImportonEntriesPush {
  uint slotMask;
  uint levels;
};

/// kernels/importance/importon_key.comp
struct ImportonKeyPush {
  uint slotMask;
};

/// kernels/importance/importon_level.comp
struct ImportonLevelPush {
  uint slotMask;
  uint nearest;
};

/// kernels/importance/importon_points.comp
struct ImportonPointsPush {
  uint levels;
};

/// kernels/lookups/map_lookup.comp
struct MapLookupPush {
  uint source;
  uint isGlobal;
  uint levels;  // counter with the map's grid levels
};

/// kernels/lookups/irradiance_estimate.comp
struct IrradianceEstimatePush {
  uint count;
  uint isGlobal;
  uint arePhotons;
  uint levels;  // counter with the map's grid levels
};

/// kernels/surface_cache/cell_group.comp
struct CellGroupPush {
  uint first;  // group of the level
  uint count;
  uint cells;
};

/// kernels/surface_cache/cell_smooth.comp
struct CellSmoothPush {
  uint cells;
};

/// kernels/lookups/map_irradiance.comp
struct MapIrradiancePush {
  uint source;
  uint isGlobal;
  uint arePhotons;
  uint levels;  // counter with the map's grid levels
};

/// kernels/lookups/map_nearest.comp
struct MapNearestPush {
  uint source;
  uint isGlobal;
  uint levels;   // of the grid, a bit each
  uint nearest;  // M
};

/// kernels/lookups/photon_entries.comp, kernels/lookups/photon_entry_points.comp
struct PhotonEntriesPush {
  uint slotMask;
  uint levels;
};

/// kernels/camera/aov_ask.comp, kernels/camera/aov_answer.comp
struct AovLightPush {
  uint count;     // pixels of the tile
  uint isGlobal;
};

/// kernels/photon_map/cell_find.comp
struct CellFindPush {
  uint isGlobal;
};

/// kernels/photon_map/cell_settle.comp
struct CellSettlePush {
  uint capacity;
};

/// kernels/photons/photon_emit.comp
struct PhotonEmitPush {
  uint firstPhoton;
  uint count;
  uint stream;
  uint bins;  // of the guide, along each axis; 0: by power
  uint isGlobal;
};

/// kernels/lookups/photon_key.comp
struct PhotonKeyPush {
  uint isFinished;
  uint isGlobal;
  uint slotMask;
};

/// kernels/photon_map/photon_quota.comp
struct PhotonQuotaPush {
  uint isBatch;
  uint hasStored;
  uint acceptance;  // kAccept*
  uint fewest;      // up to so many neighbours do not count
};

/// kernels/photon_map/photon_redistribute.comp
struct PhotonRedistributePush {
  uint receivers;
  uint shares;  // kShare*
};

/// kernels/photons/photon_scatter.comp
struct PhotonScatterPush {
  uint source;
  uint stream;
  ScatterGrid guide;
};

/// kernels/photon_map/photon_store.comp
struct PhotonStorePush {
  uint capacity;
  uint isWeighted;  // power times the weight that photon_thin noted
};

/// kernels/photon_map/photon_thin.comp
struct PhotonThinPush {
  uint isGlobal;
  float floorProbability;
};

/// kernels/photon_map/pilot_count.comp
struct PilotCountPush {
  uint isGlobal;
};

/// kernels/lists/record_select.comp
struct RecordSelectPush {
  uint source;
  uint mask;
};

/// kernels/lists/scan.comp
struct ScanPush {
  uint source;  // counter of the entries
  uint perTile;  // block sums per tile of entries (64 digits in a sort)
  uint target;  // counter that receives the total; kNone: none
  uint accumulate;  // counter that receives `source` on top of its value; kNone: none
};

/// kernels/guiding/scatter_learn.comp
struct ScatterLearnPush {
  ScatterGrid guide;
};

/// kernels/lists/set_counter.comp
struct SetCounterPush {
  uint counter;
  uint value;
  uint a;      // kNone: nothing is added
  uint b;
  uint limit;  // the counter stays at or below it
};

/// kernels/importance/site_ask.comp
struct SiteAskPush {
  uint count;
  uint isGlobal;
};

/// kernels/guiding/site_emit.comp
struct SiteEmitPush {
  uint first;
  uint count;
  uint sites;
  float meanImportance;  // pixels/m²
  float hitsPerPass;     // for each hit that was counted at a site; 0: deficits do not matter
  uint isPotential;      // places count in proportion to their importance
};

/// kernels/lists/sort_count.comp
struct SortCountPush {
  uint source;
  uint shift;
};

/// kernels/lists/sort_scatter.comp
struct SortScatterPush {
  uint source;
  uint shift;
  uint isFirst;
};

/// kernels/film/film_add.comp
struct FilmAddPush {
  uint count;      // pixels of the tile
  uint samples;    // paths of each that are done
  uint offset;     // first film pixel of the half
  uint first;      // of each pixel's paths in this pass, or of the plan's paths, before these
  uint isPlanned;  // 1: pixels have as many paths as the sample plan says
  uint paths;      // done in all
};

/// kernels/camera/aov_surface.comp
struct AovSurfacePush {
  uint count;  // pixels of the tile
};

/// kernels/camera/aov_map.comp
struct AovMapPush {
  uint count;
  uint isGlobal;
  uint levels;  // counter with the map's grid levels
};

/// kernels/camera/aov_cells.comp
struct AovCellsPush {
  uint count;
};

/// kernels/traversal/trace.comp
struct TracePush {
  uint source;  // counter of the queue
};

SHARED_END
#endif
