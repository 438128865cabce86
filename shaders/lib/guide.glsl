// A guide for emission: how photons are shared out among the lights and over the unit square of numbers that gives
// each light's directions (for parallel light: its places), in bins x bins cells per light. One point of the unit
// square chooses the row and the column by inversion, which keeps the evenness of its sequence.
// The kernel defines `float guideRow(uint index)`, the shares of rows summed up, light by light, from 0 to 1, and
// `float guideColumn(uint index)`, the same for the columns of each row.
#ifndef IMPORTON_LIB_GUIDE_GLSL
#define IMPORTON_LIB_GUIDE_GLSL

struct GuidedPoint {
  uint light;
  uint cell;      // of all lights' cells
  vec2 u;         // in the light's unit square
  float density;  // probability of the light times density over its unit square
};

GuidedPoint sampleGuide(vec2 u, uint lights, uint bins) {
  uint row = 0u, end = lights * bins;
  while (end - row > 1u) {
    const uint middle = (row + end) >> 1;
    if (guideRow(middle) <= u.y) row = middle;
    else end = middle;
  }
  const uint first = row * (bins + 1u);
  uint column = 0u;
  end = bins;
  while (end - column > 1u) {
    const uint middle = (column + end) >> 1;
    if (guideColumn(first + middle) <= u.x) column = middle;
    else end = middle;
  }
  const float rowLow = guideRow(row), rowShare = guideRow(row + 1u) - rowLow;
  const float columnLow = guideColumn(first + column), columnShare = guideColumn(first + column + 1u) - columnLow;
  const vec2 inside = clamp(vec2((u.x - columnLow) / columnShare, (u.y - rowLow) / rowShare), 0.0, 0.99999994);
  GuidedPoint p;
  p.light = row / bins;
  p.cell = row * bins + column;
  p.u = min((vec2(column, row % bins) + inside) / float(bins), vec2(0.99999994));
  p.density = rowShare * columnShare * float(bins) * float(bins);
  return p;
}

#endif
