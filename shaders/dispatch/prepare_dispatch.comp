#version 450
#extension GL_GOOGLE_include_directive : enable
// The group counts of one indirect dispatch.
#include "gpu_types.h"

layout(local_size_x_id = 0) in;  // 1
layout(push_constant) uniform Push { DispatchConstants dispatch; };
layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) writeonly buffer Arguments { uint arguments[]; };
layout(set = 0, binding = 2) readonly coherent buffer Stop { uint stop; };
#include "lanes/prepare.glsl"

void main() {
  check_rounds(dispatch);
  write_arguments(dispatch);
}
