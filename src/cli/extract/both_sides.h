// The analyses of both sides of a mesh as one.
#pragma once

#include "medial_vk/analysis.h"
#include "output/extraction_report/run_record.h"

namespace medial_vk::cli {

/// Points, undecided voxels and sheets of the inside come first; sheets of the outside are numbered from there on, and
/// counts and times are sums. Preconditions: the same grid and the same options; both have sheets, and neither has
/// removed sheets or a medial mesh. The significance is that of the sheets alone: no union of balls has both sides.
Analysis joined(Analysis inside, Analysis outside);

/// The sums of one side, for the report and the page. Precondition: `analysis` has sheets.
SideRecord record_of(MeshSide side, const Analysis& analysis);

}  // namespace medial_vk::cli
