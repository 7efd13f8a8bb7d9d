// A page that shows a run in a browser: one HTML file with everything in it, which works from disk and asks no network.
#pragma once

#include <span>
#include <string>

#include "common/up_axis.h"
#include "medial_vk/extraction.h"
#include "medial_vk/mesh.h"
#include "medial_vk/result.h"
#include "output/report/run_record.h"

namespace medial_vk {

/// Ok if this program can write pages; else kUsage and what its build was missing. Costs nothing: ask before the work.
Status check_page_available();

/// The mesh, the spheres and the report of a run as one file (docs/viewer.md). The report's times are left out: the
/// same run gives the same bytes. `up`: at first, the page can change it. Call only if check_page_available() is ok.
std::string encode_page(const Mesh& mesh, std::span<const MedialSphere> spheres, const RunRecord& record,
                        UpAxis up = UpAxis::kY);

}  // namespace medial_vk
