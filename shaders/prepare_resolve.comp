#version 450
#extension GL_GOOGLE_include_directive : enable
// One workgroup for each query that gave up; the list is ready for the next kernel that may fill it.
layout(local_size_x_id = 0) in;  // 1
layout(set = 0, binding = 0) buffer Unresolved { uint unresolved[]; };  // tree_query.glsl

const uint kRow = 32768u;  // groups along x; every device allows 65,535

void main() {
  uint count = unresolved[0];
  unresolved[0] = 0u;
  unresolved[1] = min(count, kRow);
  unresolved[2] = max((count + kRow - 1u) / kRow, 1u);
  unresolved[3] = 1u;
  unresolved[4] = count;
  unresolved[5] += count;
}
