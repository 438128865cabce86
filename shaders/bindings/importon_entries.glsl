// While importance is estimated every importon stands in the grid once for each level in use:
// entry = importon · levels + which level.
#ifndef IMPORTON_BINDINGS_IMPORTON_ENTRIES_GLSL
#define IMPORTON_BINDINGS_IMPORTON_ENTRIES_GLSL

/// The k-th set bit of `levels`, from the lowest.
uint levelOfEntry(uint levels, uint k) {
  for (; k > 0u; --k) levels &= levels - 1u;
  return uint(findLSB(levels));
}

#endif
