// Computes the group counts of indirect dispatches from counters. A dispatch is empty after an overflow, after a stop
// request of the host, and in rounds for which no list is long enough. Include after declaring `counters`, `arguments`
// and `stop`.
#ifndef MEDIAL_VK_PREPARE_GLSL
#define MEDIAL_VK_PREPARE_GLSL

uint longest_list(DispatchConstants d) {
  return d.list_counter == kNoCounter ? 0xffffffffu : counters[d.list_counter];
}

// A list that needs more rounds than are recorded is an overflow.
void check_rounds(DispatchConstants d) {
  if (d.list_counter != kNoCounter && longest_list(d) > d.entry_limit) atomicOr(counters[kOverflow], kTooFewRounds);
}

// The number of rows into which groups are arranged (workgroup_index.glsl). If the groups do not divide evenly, some
// are added, which find no work. None are added where they would find entries beyond a limit. (Limits are of no more
// groups than one row holds, or of powers of two.)
uint rows_of(uint groups, uint threads, bool is_limited) {
  uint least = max((groups + kGroupsInRow - 1u) / kGroupsInRow, 1u), rows = max(least, threads);
  bool divides = groups % (rows * kGroupsInRun) == 0u, distributes = groups >= 2u * threads * kGroupsInRun;
  return distributes && (divides || !is_limited) ? rows : least;
}

uint columns_of(uint groups, uint rows) {
  uint stride = rows * kGroupsInRun;
  return rows == 1u ? groups : (groups + stride - 1u) / stride * kGroupsInRun;
}

void write_arguments(DispatchConstants d) {
  uint all = counters[d.items_counter] * d.items_multiplier;
  uint left = all - min(all, d.first_item), items = min(left, d.item_limit);
  bool needed = counters[kOverflow] == 0u && stop == 0u && all >= d.least_items && longest_list(d) > d.first_entry;
  uint lanes = (items + d.items_divisor - 1u) / d.items_divisor;
  uint groups = needed ? (lanes + d.group_size - 1u) / d.group_size : 0u;
  // Further rounds continue with the same queries.
  if (needed && d.first_entry == 0u && d.queries_per_item > 0u)
    atomicAdd(counters[kQueries], items * d.queries_per_item);
  uint rows = rows_of(groups, d.threads, items < left);
  arguments[3u * d.argument] = columns_of(groups, rows);
  arguments[3u * d.argument + 1u] = rows;
  arguments[3u * d.argument + 2u] = 1u;
}

#endif
