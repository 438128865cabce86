// The solids that a path is in, as the numbers of their media, a byte each: the innermost in the lowest byte of x, the
// outermost of eight in the highest of y; 0 ends.
#ifndef IMPORTON_LIB_MEDIA_GLSL
#define IMPORTON_LIB_MEDIA_GLSL

uint innermostMedium(uvec2 media) { return media.x & 255u; }

uvec2 withoutInnermost(uvec2 media) { return uvec2(media.x >> 8 | media.y << 24, media.y >> 8); }

/// The medium around the innermost one; 0: none.
uint mediumAround(uvec2 media) { return innermostMedium(withoutInnermost(media)); }

/// True if there is no place for one more.
bool isInTooMany(uvec2 media) { return media.y >> 24 != 0u; }

/// Of nine the outermost is forgotten.
uvec2 enterMedium(uvec2 media, uint medium) { return uvec2(media.x << 8 | medium, media.y << 8 | media.x >> 24); }

/// Without the innermost solid of this medium, wherever it stands.
uvec2 leaveMedium(uvec2 media, uint medium) {
  const uvec2 without = withoutInnermost(media);
  for (uint place = 0u; place < 8u; ++place) {
    const uint shift = 8u * (place & 3u);
    if (((place < 4u ? media.x : media.y) >> shift & 255u) != medium) continue;
    const uint inside = (1u << shift) - 1u;  // the bits of its word that lie further in
    const uvec2 kept = place < 4u ? uvec2(inside, 0u) : uvec2(0xFFFFFFFFu, inside);
    return (media & kept) | (without & ~kept);
  }
  return media;
}

#endif
