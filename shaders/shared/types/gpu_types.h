// Structures and numbers that C++ and GLSL share. Both compilers read this file; tests/unit/shaders/gpu_types_test.cpp
// compares the offsets that each of them assigns. Storage buffers use std430.
#ifndef MEDIAL_VK_GPU_TYPES_H
#define MEDIAL_VK_GPU_TYPES_H

#ifdef __cplusplus
#include <cstdint>
#define MEDIAL_VK_GPU_CONSTANT constexpr uint
#define MEDIAL_VK_GPU_CONSTANT_FLOAT constexpr float
namespace medial_vk::gpu {
using uint = std::uint32_t;
struct alignas(16) vec4 {
  float x, y, z, w;
};
struct alignas(16) uvec4 {
  uint x, y, z, w;
};
struct alignas(8) uvec2 {
  uint x, y;
};
#else
#define MEDIAL_VK_GPU_CONSTANT const uint
#define MEDIAL_VK_GPU_CONSTANT_FLOAT const float
#endif

// A cube of the grid that may hold salient medial points, and the position of its contact list. Coordinates count cells
// of its own level.
struct Cell {
  uint x, y, z;
  uint voxel;       // finest level and below: slot of the finest voxel it is or lies in
  uint list_begin;  // first entry of its contact list
  uint list_count;
  uint word_begin;  // first 32-entry word of its contact masks
  uint flags;       // kCell*
  uint nearest;     // triangle nearest to the centre; absent for lists of clusters and one level below
  uint touching;    // entries of its list, the first ones, that touch the cube itself (Lemma A)
  uint partner;     // of the contacts that touch, one whose sheet with the nearest passes close to the centre
  uint winding;     // kCellMeasured: two halves, the winding number at the centre, its change over the circumradius
};
MEDIAL_VK_GPU_CONSTANT kNoTriangle = 0xffffffffu;
MEDIAL_VK_GPU_CONSTANT kCellInside = 1u;      // the whole cell is known to lie in the solid
MEDIAL_VK_GPU_CONSTANT kCellEmpty = 4u;       // proved after it was kept
MEDIAL_VK_GPU_CONSTANT kCellSettled = 8u;     // given up: any point in it is near a face or near the angle
MEDIAL_VK_GPU_CONSTANT kCellUntrusted = 2u;   // meets the boundary and touches a triangle without a trusted normal
MEDIAL_VK_GPU_CONSTANT kCellMeasured = 16u;   // `winding` is set
MEDIAL_VK_GPU_CONSTANT kBoundaryDepth = 5u;   // levels below the finest voxel at which such cells are given up

// A segment that crosses the medial surface: the ends and the directions from them to the boundary.
struct Line {
  vec4 p;         // w: distance from p to the boundary
  vec4 q;         // w: the same of q
  vec4 toward_p;  // unit vector from p to its nearest boundary point
  vec4 toward_q;
  uint cell;
  uint voxel;
  uint accepted;  // 0 no, 1 by its end p, 2 by its end q, if that is inside
  uint seed;      // index among the seeds of its cell
};

// A medial point of a finest voxel, in the unit box.
struct FoundPoint {
  vec4 centre;   // w: radius
  vec4 spoke_a;  // unit; w: object angle
  vec4 spoke_b;  // unit; w: average outward flux
  uint voxel_x, voxel_y, voxel_z;
  uint cell;  // slot of the finest voxel
};

// Data that a triangle shares with its neighbours (docs/theory.md, Lemma D). Edge k goes from corner k to the next.
struct TriangleLinks {
  uint corner[3];     // rows of the table of spokes to vertices
  uint flags;         // kLink*
  uint neighbour[3];  // across its edges; see kLinkBothSides
  uint padding;
};
MEDIAL_VK_GPU_CONSTANT kNoLink = 0xffffffffu;
MEDIAL_VK_GPU_CONSTANT kLinkEdge = 1u;     // shifted by k: a spoke may end on edge k, and this triangle lists it
MEDIAL_VK_GPU_CONSTANT kLinkCorner = 8u;   // the same for corner k
MEDIAL_VK_GPU_CONSTANT kLinkWhole = 64u;   // no good normal: listed as one convex set, spokes by directions only
// Untrusted: spokes may end on both sides of the face (Lemma I). For an edge that the triangle lists, `neighbour` is
// the row, in the table of spokes to vertices, of the arc of spokes to that edge.
MEDIAL_VK_GPU_CONSTANT kLinkBothSides = 128u;
MEDIAL_VK_GPU_CONSTANT kLinkUncrossed = 256u;  // no other triangle meets its interior

// A point at which a line may cross a medial sheet, and the sheet's normal.
struct Aim {
  vec4 base;       // from the centre of the cell; w: distance of the sheet from the boundary, smaller is better
  vec4 direction;  // unit; w: 0 if there is none
};
MEDIAL_VK_GPU_CONSTANT kAimsPerCell = 4u;

// Per finest voxel: the number of its cells that remained after the search, of all levels below the finest, and this
// bit if one of its cells was given up.
MEDIAL_VK_GPU_CONSTANT kGivenUpBit = 0x80000000u;

// A finest voxel that is neither found nor proved empty.
struct UndecidedCell {
  uint x, y, z;
  uint kind;    // UndecidedKind
  float width;  // bound for the points that may be hidden there, in the unit box
  uint padding_0, padding_1, padding_2;
};
MEDIAL_VK_GPU_CONSTANT kNearFace = 0u;
MEDIAL_VK_GPU_CONSTANT kNearAngle = 1u;
MEDIAL_VK_GPU_CONSTANT kAtBoundary = 2u;
MEDIAL_VK_GPU_CONSTANT kOtherReason = 3u;

// A run of triangles that are neighbours in leaf order, with bounds of their positions and of their normals. All of
// them lie in the box and in the cylinder.
struct Cluster {
  vec4 lower;   // of the box
  vec4 upper;
  vec4 centre;  // of the cylinder; w: its radius
  vec4 axis;    // unit; w: cosine of the greatest angle between a normal and it, or kNoCone
  vec4 point;   // on the boundary; w: `count`
  float half_height;  // of the cylinder
  float sin_tilt;     // sine of that angle
  uint first, count;
};
MEDIAL_VK_GPU_CONSTANT_FLOAT kNoCone = -2.0f;  // some normal is not trusted, or normals turn by a right angle

// An edge along which the triangles of an open mesh run from `to` to `from` more often than back.
struct OpenEdge {
  vec4 from;  // w: the difference of the two counts
  vec4 to;
  vec4 apex;  // the triangle (from, to, apex) closes the mesh here
};
MEDIAL_VK_GPU_CONSTANT kMostOpenEdges = 16384u;  // of a mesh that is closed in this way

// Push constants of every kernel of the certified pipeline (at most 128 bytes). Lengths are fractions of the longest
// side of the bounding box.
struct StepConstants {
  float cell_size;        // side of the cells of this level
  float circumradius;     // of the cells, rounded up: the radius within which medial points are sought
  float list_radius;      // contacts of the ball of this radius are listed
  float voxel_size;       // side of the finest voxel
  float epsilon;
  float angle;            // threshold of the object angle, rounded down
  float cos_twice_angle;  // cosine of the turn that a line must show
  float radius;           // threshold of the radius, or a number no radius reaches
  float deep_angle;       // threshold of the object angle where the radius suffices
  float cos_twice_deep_angle;
  float slack;      // bound of the rounding error of a distance
  uint grid_x, grid_y, grid_z;  // finest voxels along each axis
  uint voxels_per_cell;         // finest voxels along a side of the cell (1 at the finest level and below)
  uint depth;                   // levels below the finest voxel
  uint first_entry;             // of the contact lists, in this round
  uint items_counter;           // which counter bounds the items of this dispatch
  uint items_multiplier;        // items per count
  uint first_item;              // offset of this dispatch's items
  uint level;                   // index into the statistics
  uint open_edges;              // 0: the mesh is closed; above kMostOpenEdges: they are not listed
  uint ends;                    // kEnds*: cells that are given up
  uint block_xy;                // the block of the grid that is searched: x of its lower corner, y shifted left by 16
  uint block_z;                 // and z; log2 of its side, shifted left by 16. Both in finest voxels
  float half_side;              // of the cells, rounded up
  float touch_half_side;        // the same for contacts that touch: at the finest level, with room for lines
  uint cluster_count;
  uint lists;                   // kLists*: contents of the parents' lists
  uint clusters_per_round;      // entries of such lists that are expanded in one dispatch
  uint lines_per_cell;          // seeds that are proposed for a cell
  uint second_task;             // 1: kernels with two tasks perform the second
};

// Bits of StepConstants::ends.
MEDIAL_VK_GPU_CONSTANT kEndsAll = 1u;      // cells that are kept now stay undecided
MEDIAL_VK_GPU_CONSTANT kEndsSettled = 2u;  // cells that can hide points near a face or the angle only are given up

MEDIAL_VK_GPU_CONSTANT kListsTriangles = 0u;  // never of top cells
MEDIAL_VK_GPU_CONSTANT kListsClusters = 1u;  // and the same for the lists of the children
MEDIAL_VK_GPU_CONSTANT kListsExpanded = 2u;  // clusters; the lists of the children will hold triangles

// The line that gave a finest voxel its point: a rank above this many bits, the line's number below, never all of them;
// or none.
MEDIAL_VK_GPU_CONSTANT kRankShift = 22u;
MEDIAL_VK_GPU_CONSTANT kNoWinner = 0xffffffffu;

// Arguments of the prefix sums: `items` elements, totals to counters, limits of the usable totals.
struct ScanConstants {
  uint items_counter;
  uint items_multiplier;
  uint total_x, total_y, total_z;  // counters that receive the totals of the components
  uint limit_x, limit_y, limit_z;  // a total above its limit raises the overflow counter
};

// Data from which an indirect dispatch is sized (prepare.glsl): groups = ceil(counter * multiplier / divisor /
// group_size) unless the dispatch is not needed.
struct DispatchConstants {
  uint items_counter;
  uint items_multiplier;
  uint items_divisor;
  uint group_size;
  uint least_items;    // not needed for fewer
  uint first_item;     // items before this one are not counted
  uint item_limit;     // at most this many items from first_item on
  uint queries_per_item;  // closest-point queries of an item, for the counter of queries
  uint list_counter;   // counter with the longest list, or kNoCounter
  uint first_entry;    // nothing to do if no list is longer than this
  uint entry_limit;    // the rounds that are recorded read no list beyond this
  uint threads;        // of the device, each of which takes one stretch of a dispatch; 1: no such device
  uint argument;       // index of the three words to write
};
MEDIAL_VK_GPU_CONSTANT kGroupsInRow = 32768u;  // at most; every device allows 65,535
MEDIAL_VK_GPU_CONSTANT kGroupsInRun = 16u;     // of which a row holds a whole number, if there are several rows

// Arguments of prepare_dispatches: its rows in the table of DispatchConstants, and its task before them.
struct PrepareConstants {
  uint first, count;
  uint start;  // kStart*
};
MEDIAL_VK_GPU_CONSTANT kStartNothing = 0u;
MEDIAL_VK_GPU_CONSTANT kStartChildren = 1u;  // the cells kept by the last level become the parents of the next
MEDIAL_VK_GPU_CONSTANT kStartBelow = 2u;     // the same with the cells that a search has left
MEDIAL_VK_GPU_CONSTANT kStartAgain = 3u;     // the cells left by the first search of a level go to the second

// Prefix sums of no more elements are computed by one workgroup.
MEDIAL_VK_GPU_CONSTANT kFewElements = 2048u;

// Counters on the device.
MEDIAL_VK_GPU_CONSTANT kNoCounter = 0xffffffffu;
MEDIAL_VK_GPU_CONSTANT kOverflow = 0u;          // bit per limit exceeded; dispatches sized afterwards are empty
MEDIAL_VK_GPU_CONSTANT kTooFewRounds = 8u;      // the bit of lists that are longer than the recorded rounds read
MEDIAL_VK_GPU_CONSTANT kParents = 1u;           // cells whose children are examined
MEDIAL_VK_GPU_CONSTANT kCells = 2u;             // cells kept at this level
MEDIAL_VK_GPU_CONSTANT kLines = 3u;
MEDIAL_VK_GPU_CONSTANT kVoxels = 4u;            // finest voxels kept
MEDIAL_VK_GPU_CONSTANT kFound = 5u;             // finest voxels with a point
MEDIAL_VK_GPU_CONSTANT kUndecided = 6u;
MEDIAL_VK_GPU_CONSTANT kLongestParentList = 7u;
MEDIAL_VK_GPU_CONSTANT kLongestCellList = 8u;
MEDIAL_VK_GPU_CONSTANT kListEntries = 9u;       // used by the lists of this level
MEDIAL_VK_GPU_CONSTANT kMaskWords = 10u;
MEDIAL_VK_GPU_CONSTANT kQueries = 12u;          // closest-point queries made
MEDIAL_VK_GPU_CONSTANT kIgnored = 14u;          // totals that are not used
MEDIAL_VK_GPU_CONSTANT kKept = 15u;             // cells left after the search of a level
MEDIAL_VK_GPU_CONSTANT kUtilisation = 16u;      // greatest share of its limit that a limited total has had, in 1/1024
MEDIAL_VK_GPU_CONSTANT kRequests = 17u;         // cells, or lines, whose side is not known; opposites of flux samples
MEDIAL_VK_GPU_CONSTANT kOpen = 18u;             // children that the first test of dismissal leaves open
MEDIAL_VK_GPU_CONSTANT kStatistics = 20u;       // per level: kVisited and so on
MEDIAL_VK_GPU_CONSTANT kStatisticsPerLevel = 10u;
MEDIAL_VK_GPU_CONSTANT kVisitedCount = 0u, kKeptCount = 1u, kContactCount = 2u, kFoundCount = 3u;
MEDIAL_VK_GPU_CONSTANT kLineCount = 4u;         // lines narrowed
MEDIAL_VK_GPU_CONSTANT kTestCount = 5u;         // distances from points to triangles: low word, high word
MEDIAL_VK_GPU_CONSTANT kClusterTestCount = 7u;  // distances from points to clusters
MEDIAL_VK_GPU_CONSTANT kNodeTestCount = 8u;     // nodes of the tree that walks have tested: low word, high word
MEDIAL_VK_GPU_CONSTANT kMaxLevels = 24u;
MEDIAL_VK_GPU_CONSTANT kCounterCount = 20u + 12u * 24u;  // enough for those of thesis_types.h, too

// The largest float, as bits: devices may lack infinities.
MEDIAL_VK_GPU_CONSTANT kFarthestBits = 0x7f7fffffu;

// Entries of a contact list that one invocation reads in one dispatch; longer lists take several rounds of the same
// dispatch. lavapipe ends an invocation's loops silently after 65,535 iterations in all.
MEDIAL_VK_GPU_CONSTANT kEntriesPerRound = 49152u;
MEDIAL_VK_GPU_CONSTANT kLinesPerCell = 8u;
MEDIAL_VK_GPU_CONSTANT kSortedDepth = 1u;      // levels below the finest voxel whose lines are sorted
MEDIAL_VK_GPU_CONSTANT kSortedPerLane = 16u;   // items of an invocation of sort_by_work.comp
MEDIAL_VK_GPU_CONSTANT kDirectSeed = 2u;       // a seed that is a point, with the direction to its second contact
MEDIAL_VK_GPU_CONSTANT kSectionsPerLine = 8u;  // points inside a line per narrowing step
MEDIAL_VK_GPU_CONSTANT kFluxSamples = 48u;     // spiral points of the flux that is stored with a point
MEDIAL_VK_GPU_CONSTANT kFluxGroup = 6u;        // of them, or of their opposites, that are queried together

#ifdef __cplusplus
}  // namespace medial_vk::gpu
#endif
#endif
