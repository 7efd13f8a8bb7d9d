#version 450
#extension GL_GOOGLE_include_directive : enable
// One instance per sphere, directly from the buffer that the extraction job fills.
#include "ball.glsl"
struct Sphere {  // RecordedSphere of medial_vk/extraction_job.h
  vec4 centre;   // w: radius
  vec4 spoke_a;  // w: object angle
  vec4 spoke_b;  // w: flux
  uvec4 voxel;
};
layout(set = 0, binding = 0) readonly buffer Spheres { Sphere spheres[]; };

void main() {
  Sphere s = spheres[gl_InstanceIndex];
  paint = colour_of(s.spoke_a.w);
  place(vec4(placement.xyz + placement.w * s.centre.xyz, placement.w * s.centre.w));
}
