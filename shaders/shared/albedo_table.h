// Shape of the tables of directional albedo (src/render/device_scene/make_albedo_table.cpp, lib/albedo.glsl). A texel
// holds two 16-bit fractions. Cosines and roughnesses run over the square roots of 0 to 1, so that grazing directions
// and sharp lobes have the most entries.
#ifndef IMPORTON_SHARED_ALBEDO_TABLE_H
#define IMPORTON_SHARED_ALBEDO_TABLE_H
#include "glsl_compat.h"

SHARED_BEGIN

// GGX reflection with Fresnel 1 and with (1 - cosine)^5: rows of cosines, one for each alpha; then the rows' means.
SHARED_CONST uint kAlbedoSide = 32u;
SHARED_CONST uint kAlbedoMeans = kAlbedoSide * kAlbedoSide;
// Rough dielectrics, from the thin side and from the dense one: the same for each index; then the means.
SHARED_CONST uint kGlassAlbedoSide = 24u;
SHARED_CONST uint kGlassAlbedoIndices = 16u;
SHARED_CONST float kGlassAlbedoLargest = 0.6f;  // (n - 1) / (n + 1) of the last index
SHARED_CONST uint kGlassAlbedo = kAlbedoMeans + kAlbedoSide;
SHARED_CONST uint kGlassAlbedoMeans = kGlassAlbedo + kGlassAlbedoIndices * kGlassAlbedoSide * kGlassAlbedoSide;
// What clear coats take too much of: for each roughness of the coat rows of cosines for each one of the base; means.
SHARED_CONST uint kCoatSide = 16u;
SHARED_CONST uint kCoatAlphas = 8u;
SHARED_CONST uint kCoatTaken = kGlassAlbedoMeans + kGlassAlbedoIndices * kGlassAlbedoSide;
SHARED_CONST uint kCoatMeans = kCoatTaken + kCoatAlphas * kCoatSide * kCoatSide;
// Sheen: share of light that it reflects if white, and the bound on its value: rows of cosines for each alpha.
SHARED_CONST uint kSheenSide = 32u;
SHARED_CONST uint kSheenAlbedo = kCoatMeans + kCoatAlphas * kCoatSide;
SHARED_CONST float kLeastSheenAlpha = 0.0049f;
// Anisotropic GGX reflection as the first table: for each alpha across the tangent, for each stretch along it, for each
// azimuth a row of cosines; then the means.
SHARED_CONST uint kStretchAlphas = 10u;
SHARED_CONST uint kStretches = 10u;
SHARED_CONST uint kStretchAzimuths = 6u;
SHARED_CONST uint kStretchCosines = 24u;
SHARED_CONST uint kStretchAlbedo = kSheenAlbedo + kSheenSide * kSheenSide;
SHARED_CONST uint kStretchMeans = kStretchAlbedo + kStretchAlphas * kStretches * kStretchAzimuths * kStretchCosines;
SHARED_CONST uint kAlbedoTexels = kStretchMeans + kStretchAlphas * kStretches;

SHARED_END
#endif
