// Balls from files that this program writes, or tables of any origin.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/curvature.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The balls of a table (CSV), whose first line names the columns, in any order: x, y, z and radius; of a table with
/// several sets, where a column `level` numbers them, those of the last set. Other columns are left out, but `link`, of
/// a robot, is refused. Numbers are at most 1e18 and radii positive. Errors, with `name` and the line at fault:
/// kInvalidMesh, and kUsage for a ball whose column `side` says `outside`.
Result<std::vector<Ball>> parse_balls(std::string_view text, const std::string& name);

/// Balls, and the spokes of each if the file has them.
struct BallsWithSpokes {
  std::vector<Ball> balls;
  std::vector<SpokePair> spokes;  ///< As many, or none.
};

/// The same, with spokes where the table has all of the columns spoke_a_x, spoke_a_y, spoke_a_z, spoke_b_x, spoke_b_y
/// and spoke_b_z: unit vectors, rounded to floats, as the program writes them.
Result<BallsWithSpokes> parse_balls_with_spokes(std::string_view text, const std::string& name);

/// Which balls of a body file.
enum class BodyBalls { kInside, kCover };

/// A medial PLY has the balls of its points, a body file (.npz) those of `of_body`; other .npz and .json are those of
/// medial points, curvatures and fitted spheres (ball_arrays.h); any other name but .glb is that of a table; "-": a
/// table on standard input. Errors: kInvalidMesh (the file cannot be read, or has no ball), kUsage (points outside of
/// their solid are among them), kOutOfMemory.
Result<std::vector<Ball>> read_balls(const std::string& path, BodyBalls of_body = BodyBalls::kInside);

/// The same, with the spokes of medial points, or of a table that has their columns. A body file has none.
Result<BallsWithSpokes> read_balls_with_spokes(const std::string& path, BodyBalls of_body = BodyBalls::kInside);

}  // namespace medial_vk
