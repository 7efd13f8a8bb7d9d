// The numbers of a run on one mesh as a line of the table.
#pragma once

#include "output/batch_files/batch_table.h"
#include "output/extraction_report/run_record.h"

namespace medial_vk::cli {

/// Fills the columns that the record knows; `has_points`: the search has ended.
void fill_row(const RunRecord& record, bool has_points, BatchRow& row);

}  // namespace medial_vk::cli
