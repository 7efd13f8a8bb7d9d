#version 450
#extension GL_GOOGLE_include_directive : enable
// For the tests of dispatches: counts the runs of each workgroup.
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;  // 1
layout(set = 0, binding = 0) buffer Runs { uint runs[]; };

void main() { atomicAdd(runs[min(workgroup_index(), runs.length() - 1u)], 1u); }
