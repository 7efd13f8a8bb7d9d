// The pictures and pages of two solids, for `medial-vk distance` and `medial-vk clearance`.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/pose.h"
#include "medial_vk/proximity.h"
#include "medial_vk/result.h"
#include "output/atomic_files/atomic_file.h"
#include "output/distance_page/distance_page.h"
#include "output/picture/pair_picture.h"

namespace medial_vk::cli {

/// Appends the triangles in the frame to which `pose` leads.
void append_mesh(const Mesh& mesh, const Pose& pose, Mesh& all);

/// That there is a row `row`, from 1, among `rows` of them; 0 chooses none. `what` has one each: "pose". Error: kUsage.
Status check_row_exists(std::size_t row, std::size_t rows, const char* what);

/// The pose of row `row`, from 1; of 0, the pose whose upper end is least, the first of several. Precondition: there is
/// one, and that row.
std::size_t shown_of(std::span<const PoseInterval> intervals, std::size_t row);

/// A body, and the pose from its frame to that of the picture.
struct PlacedBody {
  const Body& body;
  const Pose& pose;
};

/// The balls that give both ends of the interval of the balls, where the bodies have balls; `b_in_a` is the pose of b
/// in the frame of a. Where these balls `decide`, the nearest points of those inside are also those of the picture;
/// else triangles give the points and the ends, and the balls bound them.
void add_balls(const PlacedBody& a, const PlacedBody& b, const Pose& b_in_a, bool decide, PairPicture& picture);

/// What is proved, as the title of a picture.
std::string title_of(const PoseInterval& interval);

/// The name of a file without its folder; of "-": stdin.
std::string name_of_file(const std::string& path);

/// The picture and the page, of those of which `file_of_picture` and `file_of_page` are not empty; the page gets the
/// picture. Error: kOutOfMemory.
Status append_views(const PairPicture& picture, const PictureView& view, const std::string& file_of_picture,
                    const std::string& file_of_page, DistancePage page, std::vector<OutputFile>& files);

}  // namespace medial_vk::cli
