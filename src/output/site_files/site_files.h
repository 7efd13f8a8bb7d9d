// The surface between sites as bytes of files (docs/formats.md, "Surfaces between sites").
#pragma once

#include <string>

#include "output/site_files/site_record.h"

namespace medial_vk {

/// Points with their sites, and faces with theirs.
std::string encode_sites_ply(const SiteRecord& record, bool ascii);
/// Faces in a group for each piece.
std::string encode_sites_obj(const SiteRecord& record);
/// A line for each point.
std::string encode_sites_csv(const SiteRecord& record);
/// Everything.
std::string encode_sites_json(const SiteRecord& record);
/// Everything, as arrays. Error: kOutOfMemory.
Result<std::string> encode_sites_npz(const SiteRecord& record);
/// A mesh for each piece, in a colour for each pair. Error: kCannotWrite (the file would be too large for its format).
Result<std::string> encode_sites_glb(const SiteRecord& record);
/// The graph of the roadmap, with the path. Precondition: there is a roadmap.
std::string encode_roadmap_json(const SiteRecord& record);

}  // namespace medial_vk
