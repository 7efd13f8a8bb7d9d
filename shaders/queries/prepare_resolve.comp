#version 450
#extension GL_GOOGLE_include_directive : enable
// Requests one workgroup for each query whose walk was given up, and empties the list for the next kernel that may fill
// it.
#include "tree_types.h"

layout(local_size_x_id = 0) in;  // 1
layout(set = 0, binding = 0) buffer Unresolved { uint unresolved[]; };

void main() {
  uint count = unresolved[kUnresolvedWaiting];
  unresolved[kUnresolvedWaiting] = 0u;
  unresolved[kUnresolvedGroups] = min(count, kGroupsInRow);
  unresolved[kUnresolvedGroups + 1u] = max((count + kGroupsInRow - 1u) / kGroupsInRow, 1u);
  unresolved[kUnresolvedGroups + 2u] = 1u;
  unresolved[kUnresolvedCount] = count;
  unresolved[kUnresolvedTotal] += count;
}
