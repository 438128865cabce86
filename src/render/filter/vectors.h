/// Loops over pixels in a row are compiled for wider vectors too, of which the device that runs them takes its widest.
/// Products are not fused with sums, so that the bits are the same.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define IMPORTON_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define IMPORTON_VECTORS
#endif
