// A page that shows sites and the surface between them in a browser: one self-contained HTML file, which works from
// disk and makes no requests.
#pragma once

#include <span>
#include <string>

#include "common/up_axis.h"
#include "output/site_files/site_record.h"

namespace medial_vk {

/// The sites as glass, the faces of the surface by pair, and the roadmap with the path if there are any
/// (docs/viewer.md, "The page of a surface between sites"). The same record gives the same bytes. Call only if
/// check_page_available() (output/page/page.h) is ok.
std::string encode_site_page(const SiteRecord& record, std::span<const VoronoiSite> sites, UpAxis up);

}  // namespace medial_vk
