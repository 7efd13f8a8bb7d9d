// Eight neighbouring invocations that work on one cell. Include it first.
//
// Kernels that include this are compiled twice. With LOCKSTEP, for devices where the eight are in one subgroup that runs
// in lockstep and has shuffles (Context::Impl::has_lockstep_lanes), they exchange values without memory, and wait for
// each other without a barrier of the workgroup, which costs a CPU a change of stacks. Without it they use shared memory.
#ifndef MEDIAL_VK_LANES_GLSL
#define MEDIAL_VK_LANES_GLSL
#ifdef LOCKSTEP
#extension GL_KHR_shader_subgroup_shuffle : require
#endif

const uint kLanes = 8u;
const uint kMostLanes = 256u;

// Among the eight lanes of a cell, in workgroups of at most kMostLanes; all eight lanes call these functions.
//   from_lane (LOCKSTEP only)   the value that lane k holds
//   opposite_lane               the value of the lane four before or after
//   sum_of_lanes, least_of_lanes, or_of_lanes, first_lane_with
//   count_lanes                 the sum over the lanes before this one, and over all
//
// FOR_EACH_LANE(k): a loop over the eight. Shuffles from a lane that the compiler knows take less time, so the loop is
// unrolled for them; elsewhere its body is translated once (docs/performance.md, "Programs and their translation").

#ifdef LOCKSTEP
#define FOR_EACH_LANE(k) [[unroll]] for (uint k = 0u; k < kLanes; ++k)
#else
#define FOR_EACH_LANE(k) [[dont_unroll]] for (uint k = 0u; k < kLanes; ++k)
#endif

#ifdef LOCKSTEP

void synchronize() { subgroupBarrier(); }

// Index of lane k of the eight in the workgroup.
uint lane_of_eight(uint k) { return (gl_SubgroupInvocationID & ~7u) + k; }

float from_lane(float mine, uint k) { return subgroupShuffle(mine, lane_of_eight(k)); }
vec2 from_lane(vec2 mine, uint k) { return subgroupShuffle(mine, lane_of_eight(k)); }
vec3 from_lane(vec3 mine, uint k) { return subgroupShuffle(mine, lane_of_eight(k)); }
vec4 from_lane(vec4 mine, uint k) { return subgroupShuffle(mine, lane_of_eight(k)); }
uint from_lane(uint mine, uint k) { return subgroupShuffle(mine, lane_of_eight(k)); }

vec4 opposite_lane(vec4 mine) { return subgroupShuffleXor(mine, 4u); }

// Written out: lavapipe runs loops whose counter doubles, with a mask and a test of it in each turn.
vec4 sum_of_lanes(vec4 mine) {
  mine += subgroupShuffleXor(mine, 1u);
  mine += subgroupShuffleXor(mine, 2u);
  return mine + subgroupShuffleXor(mine, 4u);
}
float least_of_lanes(float mine) {
  mine = min(mine, subgroupShuffleXor(mine, 1u));
  mine = min(mine, subgroupShuffleXor(mine, 2u));
  return min(mine, subgroupShuffleXor(mine, 4u));
}
uint or_of_lanes(uint mine) {
  mine |= subgroupShuffleXor(mine, 1u);
  mine |= subgroupShuffleXor(mine, 2u);
  return mine | subgroupShuffleXor(mine, 4u);
}
uvec2 count_lanes(uint mine) {
  uvec2 sum = uvec2(0u);
  [[unroll]] for (uint k = 0; k < kLanes; ++k) {
    uint theirs = from_lane(mine, k);
    sum += uvec2(k < (gl_LocalInvocationID.x & 7u) ? theirs : 0u, theirs);
  }
  return sum;
}

#else

void synchronize() { barrier(); }

shared vec4 exchanged[kMostLanes];
shared uint exchanged_bits[kMostLanes];

vec4 opposite_lane(vec4 mine) {
  uint slot = gl_LocalInvocationID.x;
  barrier();
  exchanged[slot] = mine;
  barrier();
  return exchanged[slot ^ 4u];
}
vec4 sum_of_lanes(vec4 mine) {
  uint slot = gl_LocalInvocationID.x;
  barrier();
  exchanged[slot] = mine;
  barrier();
  // The order of additions is that of the shuffles.
  vec4 sum[kLanes];
  [[unroll]] for (uint k = 0; k < kLanes; ++k) sum[k] = exchanged[(slot & ~7u) + k];
  [[unroll]] for (uint stride = 1; stride < kLanes; stride <<= 1)
    [[unroll]] for (uint k = 0; k + stride < kLanes; k += 2 * stride) sum[k] += sum[k + stride];
  return sum[0];
}
// Short loops are unrolled: their turns would count in the loop budget of lavapipe (docs/reliability.md).
float least_of_lanes(float mine) {
  uint slot = gl_LocalInvocationID.x;
  barrier();
  exchanged[slot].x = mine;
  barrier();
  [[unroll]] for (uint k = 0; k < kLanes; ++k) mine = min(mine, exchanged[(slot & ~7u) + k].x);
  return mine;
}
uint or_of_lanes(uint mine) {
  uint slot = gl_LocalInvocationID.x;
  barrier();
  exchanged_bits[slot] = mine;
  barrier();
  [[unroll]] for (uint k = 0; k < kLanes; ++k) mine |= exchanged_bits[(slot & ~7u) + k];
  return mine;
}
uvec2 count_lanes(uint mine) {
  uint slot = gl_LocalInvocationID.x;
  barrier();
  exchanged_bits[slot] = mine;
  barrier();
  uvec2 sum = uvec2(0u);
  [[unroll]] for (uint k = 0; k < kLanes; ++k) {
    uint theirs = exchanged_bits[(slot & ~7u) + k];
    sum += uvec2(k < (slot & 7u) ? theirs : 0u, theirs);
  }
  return sum;
}

#endif

// The first of the eight lanes with a true flag, or kLanes.
uint first_lane_with(bool flag) {
  uint lanes = or_of_lanes(flag ? 1u << (gl_LocalInvocationID.x & 7u) : 0u);
  return lanes == 0u ? kLanes : uint(findLSB(lanes));
}
#endif
