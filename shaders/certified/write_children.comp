#version 450
#extension GL_GOOGLE_include_directive : enable
// Writes the kept children and their contact lists, the contacts that touch the cube first, at the positions given by
// the prefix sums of `states`. If the children are finest voxels (step.second_task), each receives a slot of its own.
#include "certified/step.glsl"

layout(set = 0, binding = 0) readonly buffer Parents { Cell parents[]; };
layout(set = 0, binding = 1) readonly buffer ParentLists { uint parent_lists[]; };
layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 4) readonly buffer TouchMasks { uint touch_masks[]; };
layout(set = 0, binding = 5) readonly buffer States { uvec4 states[]; };
layout(set = 0, binding = 6) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 7) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 8) writeonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 9) writeonly buffer Lists { uint lists[]; };
// Before the first round: contacts, those that touch, and the partner. Between rounds: the next position of either
// kind.
layout(set = 0, binding = 10) buffer Counts { uvec4 counts[]; };
layout(set = 0, binding = 11) writeonly buffer Winners { uint winners[]; };
layout(set = 0, binding = 12) writeonly buffer GivenUp { uint given_up[]; };
layout(set = 0, binding = 13) writeonly buffer Reasons { uvec2 reasons[]; };

void write_cell(Cell parent, uint item, uvec4 state, uvec4 offset, uint touching) {
  uvec3 c = child_coordinates(parent, item % 8);
  bool is_finest = step.second_task != 0u;
  uint voxel = is_finest ? offset.x : parent.voxel;
  cells[offset.x] =
      Cell(c.x, c.y, c.z, voxel, offset.y, state.y, offset.z, state.w, nearest[item].y, touching,
           counts[item].z, 0u);
  if (is_finest) {
    winners[voxel] = kNoWinner;
    given_up[voxel] = 0u;
    reasons[voxel] = uvec2(0u);
  }
  atomicMax(counters[kLongestCellList], state.y);
  COUNT(kKeptCount, 1u);
  COUNT(kContactCount, state.y);
}

void main() {
  uint item = invocation_index();
  if (item >= 8u * counters[kParents] || counters[kOverflow] != 0u) return;
  uvec4 state = states[item];
  if (state.x == 0u) return;
  Cell parent = parents[item / 8];
  if (step.first_entry >= parent.list_count) return;
  uvec4 offset = offsets[item];
  uvec2 position = counts[item].xy;  // of the next that does not touch, and of the next that does
  if (step.first_entry == 0u) {
    write_cell(parent, item, state, offset, position.y);
    position = uvec2(position.y, 0u);
  }
  uint word_count = (parent.list_count + 31u) / 32u;
  uint base = 8u * parent.word_begin + (item % 8) * word_count;
  uint w = step.first_entry / 32u;
  uint end = min(word_count, w + kEntriesPerRound / 32u);
  for (; w < end; ++w) {
    uint word = masks[base + w], touches = touch_masks[base + w];
    while (word != 0u) {
      uint bit = uint(findLSB(word));
      uint is_first = touches >> bit & 1u;
      lists[offset.y + (is_first != 0u ? position.y : position.x)] = parent_lists[parent.list_begin + 32u * w + bit];
      position += uvec2(1u - is_first, is_first);
      word &= word - 1u;
    }
  }
  counts[item].xy = position;
}
