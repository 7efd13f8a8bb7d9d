// Definitions that the kernels that answer queries by walking the tree share: bindings, counts, the list of queries
// whose walk was given up. Bindings from 5 on are the kernel's own. Specialization constant COUNTS_CONSTANT enables the
// counts of tests.
#ifndef MEDIAL_VK_TREE_QUERY_GLSL
#define MEDIAL_VK_TREE_QUERY_GLSL
#include "tree_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { QueryConstants push; };
#ifndef COUNTS_CONSTANT
#define COUNTS_CONSTANT 2
#endif
layout(constant_id = COUNTS_CONSTANT) const bool kCountsTests = false;

#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING QUERY_STORAGE_BUFFERS
#define TREE_STORAGE_BINDING 1
#define TREE_TEXEL_BINDING (QUERY_STORAGE_BUFFERS + 1)
#include "tree/triangles.glsl"
#include "tree/tree.glsl"

layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) buffer Unresolved { uint unresolved[]; };
layout(set = 0, binding = 4) readonly buffer Queries { vec4 queries[]; };

uint group_index() { return push.first_group + workgroup_index(); }
uint invocation_index() { return group_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

uint query_count() {
  return push.items_counter == kNoCounter ? push.items : counters[push.items_counter] * push.items_multiplier;
}

void leave_unresolved(uint query) { unresolved[kUnresolvedFirst + atomicAdd(unresolved[kUnresolvedWaiting], 1u)] = query; }

void add_tests(uint word, uint tests) {
  uint before = atomicAdd(unresolved[word], tests);
  if (before + tests < before) atomicAdd(unresolved[word + 1u], 1u);
}

// Called at the end of an invocation.
void count_tests() {
  if (!kCountsTests) return;
  add_tests(kNodeTests, tested_nodes);
  add_tests(kTriangleTests, tested_triangles);
}

#endif
