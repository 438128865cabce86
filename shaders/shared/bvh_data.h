// The bounding volume hierarchy: one array of records of 48 bytes, each a node, a triangle or a placed mesh, so that a
// step of the traversal is the same fetch of three texels for either.
#ifndef IMPORTON_SHARED_BVH_DATA_H
#define IMPORTON_SHARED_BVH_DATA_H
#include "glsl_compat.h"

SHARED_BEGIN

SHARED_CONST uint kBvhWidth = 4u;       // children of a node at most
SHARED_CONST uint kBvhMaxDepth = 64u;   // nodes on a path from the root at most: the size of the stack
SHARED_CONST uint kBvhIndexBits = 24u;  // of record indices
SHARED_CONST uint kBvhRecordTexels = 3u;

// BvhNode::kind, BvhTriangle::kind, BvhInstance::kind
SHARED_CONST uint kBvhInner = 0u;
SHARED_CONST uint kBvhLeaf = 0x80000000u;
SHARED_CONST uint kBvhInstance = 0x40000000u;
SHARED_CONST uint kBvhTurnMask = 3u;  // BvhTriangle: how far its vertices are turned

/// A node. Its children are the records firstChild + 0, 1, … of its slots; their boxes are rounded outwards to
/// a grid of 256 steps per axis: low = gridOrigin + byte · 2^(exponent - 127). Byte s of a word belongs to slot
/// s. Slots without a child have low > high. [Ylitie et al. 2017, section 3]
struct BvhNode {
  vec3 gridOrigin;     // m
  uint gridExponents;  // a byte per axis, x lowest, as in a float's exponent
  uint lowX;
  uint highX;
  uint lowY;
  uint highY;
  uint lowZ;
  uint highZ;
  uint firstChild;
  uint kind;  // kBvhInner
};

/// A triangle as a record in the same array. A leaf with several is a chain. Its vertices are turned so that v0
/// is opposite the longest edge, which makes the plane that they span most exact: v0 is vertex `turn` of the
/// triangle in the scene, v1 the one after it, cyclically.
struct BvhTriangle {
  vec3 v0;        // m, render space
  uint triangle;  // index into the scene's triangles
  vec3 v1;
  uint next;  // record of the leaf's next triangle; 0: the last one
  vec3 v2;
  uint kind;  // kBvhLeaf | turn
};

/// A placed mesh as a leaf of the tree above all meshes. Its own tree, in object space, is among the same records.
struct BvhInstance {
  uint unused0[3];
  uint instance;  // in the array of InstanceData, 1 or greater
  uint unused1[7];
  uint kind;  // kBvhInstance
};

SHARED_END
#endif
