// The index of a workgroup in its dispatch. Runs of workgroups are counted across rows, so that neighbouring runs lie
// in different rows. A processor that runs shaders cuts a dispatch into one stretch for each of its threads, and there
// is one row per thread (prepare.glsl), so that runs are distributed to the threads in turn. Neighbours in a dispatch
// are neighbours in space, with lists of similar length; otherwise one thread would receive the long lists and delay
// the others. Within a run, a thread finds in its cache the data that the previous group has loaded.
#ifndef MEDIAL_VK_WORKGROUP_INDEX_GLSL
#define MEDIAL_VK_WORKGROUP_INDEX_GLSL
#include "gpu_types.h"

uint workgroup_index() {
  uint run = gl_WorkGroupID.x / kGroupsInRun * gl_NumWorkGroups.y + gl_WorkGroupID.y;
  return run * kGroupsInRun + gl_WorkGroupID.x % kGroupsInRun;
}

#endif
