// A page that shows a run in a browser: one self-contained HTML file, which works from disk and makes no requests.
#pragma once

#include <span>
#include <string>

#include "boundary_fields/boundary_fields.h"
#include "common/up_axis.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh.h"
#include "medial_vk/result.h"
#include "output/extraction_report/run_record.h"

namespace medial_vk {

/// Ok if this program can write pages; else kUsage with the component that its build lacked. It takes no time: call it
/// before the work.
Status check_page_available();

/// The mesh, the spheres and the report of a run as one file (docs/viewer.md). The report's times are left out, so that
/// the same run gives the same bytes. `up` is the initial axis; the page can change it. `boundary`: at the vertices of
/// the mesh, if anything was measured. Call only if check_page_available() is ok.
std::string encode_page(const Mesh& mesh, std::span<const MedialSphere> spheres, const RunRecord& record,
                        UpAxis up = UpAxis::kY, const BoundaryFields& boundary = {});

}  // namespace medial_vk
