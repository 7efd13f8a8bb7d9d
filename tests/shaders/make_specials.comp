#version 450
// For the test of an imitation: numbers that devices need not support. Its operands are inputs, and no number is divided
// by itself, so that no compiler knows the results: NVIDIA's makes 1 of x / x.

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push {
  float zero;
  float tiny;
  float huge;
  float other_zero;
};
layout(set = 0, binding = 0) writeonly buffer Output { float values[]; };

void main() {
  values[0] = huge / zero;
  values[1] = zero / other_zero;
  values[2] = -huge * huge;
  values[3] = sqrt(-huge);
  values[4] = tiny * 0.125;
  values[5] = huge - huge;
  values[6] = huge / 2.0;
  vec3 v = vec3(huge, tiny, 1.0) * (huge * tiny);
  vec2 w = vec2(tiny, huge) / zero;
  values[7] = v.x;
  values[8] = v.y;
  values[9] = v.z;
  values[10] = w.x;
  values[11] = w.y;
}
