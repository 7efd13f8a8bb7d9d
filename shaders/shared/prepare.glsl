// Turns counters into the group counts of indirect dispatches. A dispatch gets none after an overflow, after the host has
// asked to stop, or in rounds that no list is long enough for. Include after declaring `counters`, `arguments` and `stop`.
#ifndef MEDIAL_VK_PREPARE_GLSL
#define MEDIAL_VK_PREPARE_GLSL

const uint kRow = 32768u;  // groups along x; every device allows 65,535

uint longest_list(DispatchConstants d) {
  return d.list_counter == kNoCounter ? 0xffffffffu : counters[d.list_counter];
}

// A list that needs more rounds than are recorded is an overflow.
void check_rounds(DispatchConstants d) {
  if (d.list_counter != kNoCounter && longest_list(d) > d.entry_limit) atomicOr(counters[kOverflow], kTooFewRounds);
}

void write_arguments(DispatchConstants d) {
  uint all = counters[d.items_counter] * d.items_multiplier;
  uint items = min(all - min(all, d.first_item), d.item_limit);
  bool needed = counters[kOverflow] == 0u && stop == 0u && all >= d.least_items && longest_list(d) > d.first_entry;
  uint lanes = (items + d.items_divisor - 1u) / d.items_divisor;
  uint groups = needed ? (lanes + d.group_size - 1u) / d.group_size : 0u;
  // Further rounds go on with the same queries.
  if (needed && d.first_entry == 0u && d.queries_per_item > 0u)
    atomicAdd(counters[kQueries], items * d.queries_per_item);
  uint rows = (groups + kRow - 1u) / kRow;
  arguments[3u * d.argument] = min(groups, kRow);
  arguments[3u * d.argument + 1u] = max(rows, 1u);
  arguments[3u * d.argument + 2u] = 1u;
}

#endif
