// To add a struct of shaders/shared: one IMPORTON_LAYOUT line with its name and all its members in order. A
// struct that lies in a buffer or in push constants of a shipped kernel and is not here fails the layout test.
#include "gpu/layout.h"
#include "shared/bvh_data.h"
#include "shared/push_data.h"
#include "shared/ray_data.h"
#include "shared/render_data.h"
#include "shared/scene_data.h"

namespace importon::test {

std::vector<HostLayout> hostLayouts() {
  return {
      // shared/scene_data.h
      IMPORTON_LAYOUT(Vertex, uv0, uv1, normal, tangent, colorRG, colorBA),
      IMPORTON_LAYOUT(Triangle, v0, v1, v2, material),
      IMPORTON_LAYOUT(Material, baseColor, emission, metallic, specularColor, roughness, absorption, transmission, ior,
                      specular, normalScale, alphaCutoff, clearcoat, clearcoatRoughness, flags, baseColorTexture,
                      metallicRoughnessTexture, normalTexture, emissiveTexture, transmissionTexture, specularTexture,
                      specularColorTexture, clearcoatTexture, clearcoatRoughnessTexture, clearcoatNormalTexture,
                      clearcoatNormalScale, unused0, unused1),
      IMPORTON_LAYOUT(Texture, firstTexel, width, height, wrapS, wrapT, isNearest, isSrgb, uvSet, uvRow0, uvRow1),
      IMPORTON_LAYOUT(Light, kind, triangle, power, area, emission, position, cosInner, direction, cosOuter,
                      isTwoSided),
      // shared/ray_data.h
      IMPORTON_LAYOUT(Ray, origin, tMax, direction, id),
      IMPORTON_LAYOUT(Hit, t, u, v, triangle),
      // shared/bvh_data.h
      IMPORTON_LAYOUT(BvhNode, gridOrigin, gridExponents, lowX, highX, lowY, highY, lowZ, highZ, firstChild, kind),
      IMPORTON_LAYOUT(BvhTriangle, v0, triangle, v1, next, v2, kind),
      // shared/render_data.h
      IMPORTON_LAYOUT(MapSettings, photonsPerPixel, constantDensity, densityFloor, importonLevels, recordMask,
                      importonFlux, densityLimit, lookupPhotons, fewestPhotons, photonsPerPass, firstPhoton,
                      photonsCounted),
      IMPORTON_LAYOUT(Parameters, cameraOrigin, cameraIsOrthographic, cameraForward, width, cameraRight, height,
                      cameraUp, seed, gridOrigin, gridExtent, sceneCentre, sceneRadius, environmentSize,
                      environmentLight, lightCount, totalPower, pass, maxDepth, fluxScale, quotaPhotons, samplesPerPass,
                      firstSample, densityScale, largestQuotaRadius, cameraMedium, importonFlux, irradianceUnits,
                      photonUnits, irradianceScale, causticMap, globalMap),
      IMPORTON_LAYOUT(LightAlias, threshold, other, probability),
      IMPORTON_LAYOUT(PathState, throughput, flags, id, medium, outerMedium, pdfSolidAngle, lightWeight, source,
                      distance),
      IMPORTON_LAYOUT(Spread, position, direction, gradient),
      IMPORTON_LAYOUT(PathDifferential, x, y, u, v, share),
      IMPORTON_LAYOUT(PathLight, direct, caustic, indirect, modulation, position, normal, gathers),
      IMPORTON_LAYOUT(FilmPixel, direct, caustic, indirect, modulation, position, normal, gathers, square, foundSquare),
      IMPORTON_LAYOUT(EyeVertex, position, radius, throughput, triangle, direction, u, v),
      IMPORTON_LAYOUT(MapPoint, position, packed),
      IMPORTON_LAYOUT(Record, flux, kind),
      IMPORTON_LAYOUT(DispatchArguments, items, tiles, rays),
      // shared/push_data.h
      IMPORTON_LAYOUT(PhotonCell, keyA, keyB, photon),
      IMPORTON_LAYOUT(CellFindPush, isGlobal),
      IMPORTON_LAYOUT(CellSettlePush, capacity),
      IMPORTON_LAYOUT(AddCounterPush, counter, sum, empties),
      IMPORTON_LAYOUT(CompactCountPush, source),
      IMPORTON_LAYOUT(CompactScatterPush, source, takesIndex),
      IMPORTON_LAYOUT(EyeEmitPush, first, count, pixels, firstSample, total, isCentred, isPlanned),
      IMPORTON_LAYOUT(EyeLightPush, source),
      IMPORTON_LAYOUT(EyeScatterPush, source, knowsImportance),
      IMPORTON_LAYOUT(FluxSumPush, what, source),
      IMPORTON_LAYOUT(GridCellsPush, source, slotMask),
      IMPORTON_LAYOUT(GridPointsPush, source),
      IMPORTON_LAYOUT(HitCountPush, isGlobal, weight),
      IMPORTON_LAYOUT(HitKeyPush, isGlobal, slotMask, isControlled),
      IMPORTON_LAYOUT(ImportonBoundPush, levels),
      IMPORTON_LAYOUT(ImportonCountPush, slotMask),
      IMPORTON_LAYOUT(ImportonDensityPush, levels, nearest),
      IMPORTON_LAYOUT(ImportonDifferentialPush, source),
      IMPORTON_LAYOUT(ImportonEntriesPush, slotMask, levels),
      IMPORTON_LAYOUT(ImportonKeyPush, slotMask),
      IMPORTON_LAYOUT(ImportonLevelPush, slotMask, nearest),
      IMPORTON_LAYOUT(ImportonPointsPush, levels),
      IMPORTON_LAYOUT(IrradianceEstimatePush, count, isGlobal, arePhotons, levels),
      IMPORTON_LAYOUT(CellGroupPush, first, count, cells),
      IMPORTON_LAYOUT(CellSmoothPush, cells),
      IMPORTON_LAYOUT(MapIrradiancePush, source, isGlobal, arePhotons, levels),
      IMPORTON_LAYOUT(MapNearestPush, source, isGlobal, levels, nearest),
      IMPORTON_LAYOUT(PhotonEntriesPush, slotMask, levels),
      IMPORTON_LAYOUT(AovLightPush, count, isGlobal),
      IMPORTON_LAYOUT(MapLookupPush, source, isGlobal, levels),
      IMPORTON_LAYOUT(PhotonEmitPush, firstPhoton, count, stream, bins, isGlobal),
      IMPORTON_LAYOUT(GuideLearnPush, isGlobal, stream, bins, meanImportance, hitsPerPass, isPotential),
      IMPORTON_LAYOUT(PhotonKeyPush, isFinished, isGlobal, slotMask),
      IMPORTON_LAYOUT(PhotonQuotaPush, isBatch, hasStored, acceptance, fewest),
      IMPORTON_LAYOUT(PhotonRedistributePush, receivers, shares),
      IMPORTON_LAYOUT(PhotonScatterPush, source, stream, guide),
      IMPORTON_LAYOUT(PhotonStorePush, capacity, isWeighted),
      IMPORTON_LAYOUT(PhotonThinPush, isGlobal, floorProbability),
      IMPORTON_LAYOUT(PilotCountPush, isGlobal),
      IMPORTON_LAYOUT(RecordSelectPush, source, mask),
      IMPORTON_LAYOUT(ScanPush, source, perTile, target, accumulate),
      IMPORTON_LAYOUT(ScatterGrid, origin, perMetre, voxels),
      IMPORTON_LAYOUT(ScatterLearnPush, guide),
      IMPORTON_LAYOUT(SetCounterPush, counter, value, a, b, limit),
      IMPORTON_LAYOUT(SiteAskPush, count, isGlobal),
      IMPORTON_LAYOUT(SiteEmitPush, first, count, sites, meanImportance, hitsPerPass, isPotential),
      IMPORTON_LAYOUT(SortCountPush, source, shift),
      IMPORTON_LAYOUT(SortScatterPush, source, shift, isFirst),
      IMPORTON_LAYOUT(FilmAddPush, count, samples, offset, first, isPlanned, paths),
      IMPORTON_LAYOUT(AovSurfacePush, count),
      IMPORTON_LAYOUT(AovCellsPush, count),
      IMPORTON_LAYOUT(AovMapPush, count, isGlobal, levels),
      IMPORTON_LAYOUT(TracePush, source),
  };
}

}  // namespace importon::test
