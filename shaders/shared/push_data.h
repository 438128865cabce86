// Push constants of the kernels.
#ifndef IMPORTON_SHARED_PUSH_DATA_H
#define IMPORTON_SHARED_PUSH_DATA_H
#include "glsl_compat.h"
#include "render_data.h"

SHARED_BEGIN

/// kernels/add_counter.comp
struct AddCounterPush {
  uint counter;
  uint sum;      // its low word; the high one follows
  uint empties;  // 1: the counter is 0 afterwards
};

/// kernels/compact_count.comp
struct CompactCountPush {
  uint source;
};

/// kernels/compact_scatter.comp
struct CompactScatterPush {
  uint source;
  uint takesIndex;  // 1: writes the index of an entry; 0: the queue's value there
};

/// kernels/eye_emit.comp
struct EyeEmitPush {
  uint first;     // pixel or importon
  uint count;
  uint pixels;    // of the tile, or importons
  uint firstSample;  // of each pixel's paths in this pass, or of the plan's paths
  uint total;     // importons in all
  uint isCentred; // 1: through the middle of the pixel
  uint isPlanned; // 1: pixels have as many paths as the sample plan says
};

/// kernels/eye_light.comp
struct EyeLightPush {
  uint source;
};

/// kernels/eye_scatter.comp
struct EyeScatterPush {
  uint source;
  uint knowsImportance;
};

/// kernels/flux_sum.comp
struct FluxSumPush {
  uint what;    // kSum*
  uint source;
};

/// kernels/grid_cells.comp
struct GridCellsPush {
  uint source;
  uint slotMask;
};

/// kernels/grid_points.comp
struct GridPointsPush {
  uint source;
};

/// kernels/guide_learn.comp
struct GuideLearnPush {
  uint isGlobal;
  uint stream;
  uint bins;
  float meanImportance;  // pixels/m²
  float hitsPerPass;     // for each hit that was counted at a site; 0: deficits do not matter
  uint isPotential;      // places count in proportion to their importance
};

/// kernels/hit_count.comp
struct HitCountPush {
  uint isGlobal;
  uint weight;  // hits that each stands for
};

/// kernels/hit_key.comp
struct HitKeyPush {
  uint isGlobal;
  uint slotMask;
  uint isControlled;
};

/// kernels/importon_bound.comp
struct ImportonBoundPush {
  uint levels;
};

/// kernels/importon_count.comp
struct ImportonCountPush {
  uint slotMask;
};

/// kernels/importon_density.comp
struct ImportonDensityPush {
  uint levels;
  uint nearest;
};

/// kernels/importon_differential.comp
struct ImportonDifferentialPush {
  uint source;
};

/// kernels/importon_entries.comp
struct ImportonEntriesPush {
  uint slotMask;
  uint levels;
};

/// kernels/importon_key.comp
struct ImportonKeyPush {
  uint slotMask;
};

/// kernels/importon_level.comp
struct ImportonLevelPush {
  uint slotMask;
  uint nearest;
};

/// kernels/importon_points.comp
struct ImportonPointsPush {
  uint levels;
};

/// kernels/map_lookup.comp
struct MapLookupPush {
  uint source;
  uint isGlobal;
  uint levels;  // counter with the map's grid levels
};

/// kernels/irradiance_estimate.comp
struct IrradianceEstimatePush {
  uint count;
  uint isGlobal;
  uint arePhotons;
  uint levels;  // counter with the map's grid levels
};

/// kernels/cell_group.comp
struct CellGroupPush {
  uint first;  // group of the level
  uint count;
  uint cells;
};

/// kernels/cell_smooth.comp
struct CellSmoothPush {
  uint cells;
};

/// kernels/map_irradiance.comp
struct MapIrradiancePush {
  uint source;
  uint isGlobal;
  uint arePhotons;
  uint levels;  // counter with the map's grid levels
};

/// kernels/map_nearest.comp
struct MapNearestPush {
  uint source;
  uint isGlobal;
  uint levels;   // of the grid, a bit each
  uint nearest;  // M
};

/// kernels/photon_entries.comp, kernels/photon_entry_points.comp
struct PhotonEntriesPush {
  uint slotMask;
  uint levels;
};

/// kernels/aov_ask.comp, kernels/aov_answer.comp
struct AovLightPush {
  uint count;     // pixels of the tile
  uint isGlobal;
};

/// kernels/cell_find.comp
struct CellFindPush {
  uint isGlobal;
};

/// kernels/cell_settle.comp
struct CellSettlePush {
  uint capacity;
};

/// kernels/photon_emit.comp
struct PhotonEmitPush {
  uint firstPhoton;
  uint count;
  uint stream;
  uint bins;  // of the guide, along each axis; 0: by power
  uint isGlobal;
};

/// kernels/photon_key.comp
struct PhotonKeyPush {
  uint isFinished;
  uint isGlobal;
  uint slotMask;
};

/// kernels/photon_quota.comp
struct PhotonQuotaPush {
  uint isBatch;
  uint hasStored;
  uint acceptance;  // kAccept*
  uint fewest;      // up to so many neighbours do not count
};

/// kernels/photon_redistribute.comp
struct PhotonRedistributePush {
  uint receivers;
  uint shares;  // kShare*
};

/// kernels/photon_scatter.comp
struct PhotonScatterPush {
  uint source;
  uint stream;
  ScatterGrid guide;
};

/// kernels/photon_store.comp
struct PhotonStorePush {
  uint capacity;
  uint isWeighted;  // power times the weight that photon_thin noted
};

/// kernels/photon_thin.comp
struct PhotonThinPush {
  uint isGlobal;
  float floorProbability;
};

/// kernels/pilot_count.comp
struct PilotCountPush {
  uint isGlobal;
};

/// kernels/record_select.comp
struct RecordSelectPush {
  uint source;
  uint mask;
};

/// kernels/scan.comp
struct ScanPush {
  uint source;  // counter of the entries
  uint perTile;  // block sums per tile of entries (64 digits in a sort)
  uint target;  // counter that receives the total; kNone: none
  uint accumulate;  // counter that receives `source` on top of its value; kNone: none
};

/// kernels/scatter_learn.comp
struct ScatterLearnPush {
  ScatterGrid guide;
};

/// kernels/set_counter.comp
struct SetCounterPush {
  uint counter;
  uint value;
  uint a;      // kNone: nothing is added
  uint b;
  uint limit;  // the counter stays at or below it
};

/// kernels/site_ask.comp
struct SiteAskPush {
  uint count;
  uint isGlobal;
};

/// kernels/site_emit.comp
struct SiteEmitPush {
  uint first;
  uint count;
  uint sites;
  float meanImportance;  // pixels/m²
  float hitsPerPass;     // for each hit that was counted at a site; 0: deficits do not matter
  uint isPotential;      // places count in proportion to their importance
};

/// kernels/sort_count.comp
struct SortCountPush {
  uint source;
  uint shift;
};

/// kernels/sort_scatter.comp
struct SortScatterPush {
  uint source;
  uint shift;
  uint isFirst;
};

/// kernels/film_add.comp
struct FilmAddPush {
  uint count;      // pixels of the tile
  uint samples;    // paths of each that are done
  uint offset;     // first film pixel of the half
  uint first;      // of each pixel's paths in this pass, or of the plan's paths, before these
  uint isPlanned;  // 1: pixels have as many paths as the sample plan says
  uint paths;      // done in all
};

/// kernels/aov_surface.comp
struct AovSurfacePush {
  uint count;  // pixels of the tile
};

/// kernels/aov_map.comp
struct AovMapPush {
  uint count;
  uint isGlobal;
  uint levels;  // counter with the map's grid levels
};

/// kernels/aov_cells.comp
struct AovCellsPush {
  uint count;
};

/// kernels/trace.comp
struct TracePush {
  uint source;  // counter of the queue
};

SHARED_END
#endif
