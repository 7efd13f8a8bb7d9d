#version 450
// For the tests of the recorder: uses all resources that a program can have, and writes its inputs to its output.

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint kFactor = 1;
layout(constant_id = 2) const uint kTexelMask = 0;
layout(push_constant) uniform Push {
  uint count;
  uint offset;
};
layout(set = 0, binding = 0) writeonly buffer Output { uint values[]; };
layout(set = 0, binding = 1) uniform samplerBuffer texels;

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (i >= count) return;
  values[i] = kFactor * i + offset + uint(texelFetch(texels, int(i & kTexelMask)).x);
}
