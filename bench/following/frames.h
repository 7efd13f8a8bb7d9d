// The mesh in a frame of a motion, and what is found of balls there without a follower.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/context.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk::bench {

/// The mesh with these vertices, whose triangles do not cross.
IndexedMesh mesh_in_frame(const IndexedMesh& mesh, const std::vector<Point>& frame);

/// Percent of the volume of a mesh in no ball around one of its medial points.
std::string fresh_points(const IndexedMesh& mesh, int resolution, Context& context);

/// Counts balls that reach out, by the CPU reference, over frames.
class BallsOutside {
 public:
  /// Balls of radius 0 are left out.
  void count(const IndexedMesh& mesh, const std::vector<Point>& frame, std::span<const Ball> balls);
  std::uint64_t failed() const { return failed_; }
  /// "0 of 10,000", or nothing if no ball was tested.
  std::string text() const;

 private:
  std::uint64_t tested_ = 0, failed_ = 0;
};

}  // namespace medial_vk::bench
