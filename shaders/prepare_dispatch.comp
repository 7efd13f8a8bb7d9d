#version 450
#extension GL_GOOGLE_include_directive : enable
// Turns a counter into the group counts of an indirect dispatch; none after an overflow, after the host has asked to stop,
// or in rounds that no list is long enough for. A list that needs more rounds than are recorded is an overflow.
#include "gpu_types.h"

layout(local_size_x_id = 0) in;  // 1
layout(push_constant) uniform Push { DispatchConstants dispatch; };
layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) writeonly buffer Arguments { uint arguments[]; };
layout(set = 0, binding = 2) readonly coherent buffer Stop { uint stop; };

const uint kRow = 32768u;  // groups along x; every device allows 65,535

void main() {
  uint longest = dispatch.list_counter == kNoCounter ? 0xffffffffu : counters[dispatch.list_counter];
  if (dispatch.list_counter != kNoCounter && longest > dispatch.entry_limit) counters[kOverflow] |= kTooFewRounds;
  uint items = counters[dispatch.items_counter] * dispatch.items_multiplier;
  items = min(items - min(items, dispatch.first_item), dispatch.item_limit);
  bool needed = counters[kOverflow] == 0u && stop == 0u && longest > dispatch.first_entry;
  uint lanes = (items + dispatch.items_divisor - 1u) / dispatch.items_divisor;
  uint groups = needed ? (lanes + dispatch.group_size - 1u) / dispatch.group_size : 0u;
  // Further rounds go on with the same queries.
  if (needed && dispatch.first_entry == 0u && dispatch.queries_per_item > 0u)
    counters[kQueries] += items * dispatch.queries_per_item;
  uint rows = (groups + kRow - 1u) / kRow;
  arguments[3u * dispatch.argument] = min(groups, kRow);
  arguments[3u * dispatch.argument + 1u] = max(rows, 1u);
  arguments[3u * dispatch.argument + 2u] = 1u;
}
