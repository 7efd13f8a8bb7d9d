// A team is a workgroup of 4 to 64 invocations that walk the tree together (tree_packet.glsl): one subgroup, or, if
// PACKET_THROUGH_SHARED_MEMORY is defined, any invocations with barriers between them. The whole team makes each call.
// Shuffles replace broadcasts, and ballots votes: on lavapipe they take half the time.
#ifndef MEDIAL_VK_PACKET_TEAM_GLSL
#define MEDIAL_VK_PACKET_TEAM_GLSL

#ifdef PACKET_THROUGH_SHARED_MEMORY

shared float team_values[64];
shared uint team_flags[64];

uint team_lane() { return gl_LocalInvocationID.x; }
bool team_is_whole() { return true; }
void team_barrier() { barrier(); }

float team_max(float x) {
  team_values[team_lane()] = x;
  barrier();
  for (uint i = 0u; i < gl_WorkGroupSize.x; ++i) x = max(x, team_values[i]);
  barrier();
  return x;
}

// Bit i: the flag of lane i, of the first 32.
uint team_ballot(bool flag) {
  team_flags[team_lane()] = uint(flag);
  barrier();
  uint bits = 0u;
  for (uint i = 0u; i < min(32u, gl_WorkGroupSize.x); ++i) bits |= team_flags[i] << i;
  barrier();
  return bits;
}

bool team_any(bool flag) { return team_max(flag ? 1.0 : 0.0) > 0.0; }

float team_read(float x, uint lane) {
  team_values[team_lane()] = x;
  barrier();
  x = team_values[lane];
  barrier();
  return x;
}

#else
#extension GL_KHR_shader_subgroup_basic : enable
#extension GL_KHR_shader_subgroup_ballot : enable
#extension GL_KHR_shader_subgroup_shuffle : enable

uint team_lane() { return gl_SubgroupInvocationID; }
// A driver may cut the workgroup into subgroups that are smaller than it reported.
bool team_is_whole() { return gl_NumSubgroups == 1u && gl_SubgroupSize >= gl_WorkGroupSize.x; }
void team_barrier() {
  subgroupMemoryBarrierShared();
  subgroupBarrier();
}

float team_max(float x) {
  for (uint step = 1u; step < gl_WorkGroupSize.x; step *= 2u) x = max(x, subgroupShuffle(x, team_lane() ^ step));
  return x;
}
uint team_ballot(bool flag) { return subgroupBallot(flag).x; }
bool team_any(bool flag) {
  uvec4 bits = subgroupBallot(flag);
  return (bits.x | bits.y) != 0u;
}
float team_read(float x, uint lane) { return subgroupShuffle(x, lane); }

#endif

vec4 team_read(vec4 v, uint lane) {
  return vec4(team_read(v.x, lane), team_read(v.y, lane), team_read(v.z, lane), team_read(v.w, lane));
}

#endif
