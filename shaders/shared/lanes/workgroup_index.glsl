// Which workgroup of a dispatch this is. Runs of workgroups are counted across rows, so that neighbouring runs lie in
// different rows. A processor that runs shaders cuts a dispatch into one stretch for each of its threads, and there is a
// row for each (prepare.glsl): runs are dealt out to the threads by turns. Neighbours in a dispatch are neighbours in
// space, with lists of like length; one thread would have the long ones, and be waited for. Within a run, a thread finds
// in its cache what the group before has loaded.
#ifndef MEDIAL_VK_WORKGROUP_INDEX_GLSL
#define MEDIAL_VK_WORKGROUP_INDEX_GLSL
#include "gpu_types.h"

uint workgroup_index() {
  uint run = gl_WorkGroupID.x / kGroupsInRun * gl_NumWorkGroups.y + gl_WorkGroupID.y;
  return run * kGroupsInRun + gl_WorkGroupID.x % kGroupsInRun;
}

#endif
