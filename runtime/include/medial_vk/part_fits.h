// The parts of an assembly, such as the geometries of a robot's links, approximated by balls: each part by its own
// balls, with a proved contract. Numbers of balls are distributed among the parts by need.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/measurements.h"
#include "medial_vk/pose.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_fits.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// A solid of an assembly: a mesh, or a ball. The parts of a link move together and have one frame. The lengths of all
/// parts are in one unit.
struct Part {
  std::string link;  ///< The name of its link. Parts with the same name belong together.
  std::string name;  ///< Messages contain both names.
  Pose pose;         ///< From the frame of the part to that of its link.
  /// In the frame of the part; without a value if the part is a ball. Parts of the same shape may share one mesh.
  std::optional<IndexedMesh> mesh;
  std::optional<Ball> ball;  ///< A part that is a ball, in its own frame. It is approximated by itself, exactly.
  /// The exact volume of the shape that the mesh approximates, such as a cylinder, in cubed mesh units; errors are then
  /// relative to the shape. Precondition: the mesh lies inside the shape (contract inside), or encloses it (contract
  /// cover). Balanced balls are measured against the mesh.
  std::optional<double> volume;
};

/// All given goals must be met, as in SphereFitOptions.
struct PartFitOptions {
  /// Of each part. `count` is not read if one of the next two numbers is given.
  SphereFitOptions spheres;
  std::size_t count_per_link = 0;  ///< Greatest number of balls of each link, for its parts together; 0: no such goal.
  std::size_t total = 0;           ///< Greatest number of balls of all parts together; 0: no such goal.
  /// Of the host, 0: one per core. No result depends on it. `threads` of `spheres` is 0, or the same number; another
  /// one is the error kUsage.
  unsigned threads = 0;

  bool operator==(const PartFitOptions&) const = default;
};

/// The balls of one part, in mesh units.
struct PartFit {
  /// Sets of balls in the frame of the link, the smallest first; one, unless levels were requested. Every set satisfies
  /// the contract by itself, the rounding of the pose included. All parts have the same number of levels: a part with
  /// fewer sets repeats its smallest.
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;  ///< Per level: upper bounds of the distances by which balls reach out.
  std::size_t count = 0;  ///< The number of balls assigned to the part; 0: the number that its other goals require.
  SphereAim aim = SphereAim::kVolume;  ///< SphereFit::aim.
  /// The volume of the shape if `of_shape`, else that which the mesh encloses cleanly, if it does.
  std::optional<double> solid_volume;
  /// `solid_volume` and the volume errors are those of the shape: of the ball, or Part::volume.
  bool of_shape = false;
  std::optional<double> spheres_volume;  ///< Of the union of the last level.
  /// Of `proved`. Without a value for a part that is a ball, and with SphereFitOptions::balls_only; with that option,
  /// no volume of a part that is no ball has one either.
  std::optional<SphereMeasures> measures;
  /// The last level in the frame of the part, where its contract was proved. Empty for a part that is a ball.
  std::vector<Ball> proved;
  FitMeasurements measurements;
};

/// Fits balls to every part and proves the contract, as fit_spheres() does; the results are in the order of the parts.
///
/// A number of balls for several parts is distributed by need: each part gets one ball, and every further ball goes to
/// the part where it covers the most volume that is not yet covered (measure_coverage_curve()), for every contract.
/// With the method best, a larger number gives no part fewer balls and, with contract inside, no part a larger error.
/// With SphereAim::kDistance, every further ball goes to the part with the widest gap instead, so that the widest one
/// of all is narrow; kAuto is decided part by part, for the numbers that are distributed by volume. With
/// SphereFitOptions::max_reach, parts have as many balls as they need, and it is an error (kUsage) if these are more
/// than the number for the link, or in total.
///
/// Up to `threads` parts are fitted side by side. `extractor` is called once for each part and ExtractionOptions, one
/// call at a time but from any thread. Extractions of parts among which balls are distributed are kept until these are
/// fitted. `progress` is called with the stages of fit_spheres() and the finished share of all parts, one call at a
/// time but from any thread; a request to `stop` soon ends the call. Does not throw. Errors: those of fit_spheres(),
/// with the names of link and part; kUsage (fewer balls than parts, both `count_per_link` and `total`, a part with
/// neither mesh nor ball or with both, a pose that is no rigid motion, a radius or volume that is not positive and
/// finite); kInvalidMesh (a part too far from the origin of its link for double precision).
Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const PartFitOptions& options,
                                       const Extractor& extractor, const StageProgress& progress = {},
                                       const std::stop_token& stop = {});

/// The same on the device of `context`. The meshes of parts among which balls are distributed stay on the device until
/// each part is fitted, so that every mesh is uploaded once. If the memory of the device does not suffice for all of
/// them, all meshes but the current one leave the device, and are uploaded again.
Result<std::vector<PartFit>> fit_parts(std::span<const Part> parts, const PartFitOptions& options, Context& context,
                                       const StageProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace medial_vk
