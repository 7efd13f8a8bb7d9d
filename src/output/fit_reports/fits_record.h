// The data of one finished run of `medial-vk spheres`, for the summary and the report.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check_reports/check_report.h"
#include "common/backend.h"
#include "medial_vk/context.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/part_fits.h"
#include "medial_vk/sphere_fits.h"

namespace medial_vk {

/// What may serve better where balls inside leave much of a solid uncovered (docs/theory.md, "Thin parts").
struct FitAdvice {
  double uncovered = 0;    ///< Share of the volume.
  std::size_t inside = 0;  ///< About how many balls inside leave a quarter, where the thickness is even.
  /// As many balls cover all of it that reach out by at most this, mesh units: those inside, grown by their proved
  /// distance from the solid. Of an open mesh, its surface.
  double reach = 0;
  double added = 0;  ///< The volume that these add, as a share of the solid's.
  bool by_distance =
      false;  ///< They were chosen by volume, but have no more than half of it: so their places are free.
};

/// A solid of the run, which is the mesh or a part of the robot, and its balls.
struct FittedSolid {
  std::string link;  ///< Of a mesh: its name.
  std::string name;
  Pose pose;                        ///< From its frame to that of its link.
  std::optional<IndexedMesh> mesh;  ///< Without a value if the solid is a ball.
  std::optional<Ball> ball;
  double facet_share = 0;  ///< PartOrigin::facet_share.

  // Its fit, with the meanings of PartFit.
  std::size_t count = 0;
  SphereAim aim = SphereAim::kVolume;
  std::vector<std::vector<Ball>> levels;
  std::vector<ReachOut> reach;
  std::optional<double> solid_volume;
  bool of_shape = false;
  std::optional<double> spheres_volume;
  std::optional<SphereMeasures> measures;
  std::vector<Ball> proved;
  double seconds = 0;

  std::optional<FitAdvice> advice;         ///< By advise().
  std::optional<SphereContract> contract;  ///< Of a set of a body file; otherwise that of the record.
  std::optional<CheckReport> check;        ///< Of `--check`.

  /// The report of its mesh; an empty one for a ball.
  const MeshReport& report() const;
};

struct FitsRecord {
  // The request.
  std::string input;
  std::string part;  ///< The mesh of `input`, by its name in file names; empty: all of it.
  std::string output;
  std::string output_format;
  bool is_robot = false;
  bool is_body = false;  ///< The mesh is there twice, with the balls inside and with those of the cover.
  SphereFitOptions spheres;
  std::size_t count_per_link = 0;  ///< 0: not given.
  std::size_t total = 0;           ///< 0: not given.
  Backend backend = Backend::kVulkan;

  std::string name;                 ///< Of the mesh or robot.
  std::vector<FittedSolid> solids;  ///< The mesh, twice for a body file, or the parts of the robot.
  std::optional<DeviceDescription> device;
  std::vector<StageTime> times;  ///< Seconds, in the order of the run.
};

/// The names used by the options and in the report.
const char* name_of(SphereContract contract);
const char* name_of(SphereMethod method);
const char* name_of(SphereAim aim);

/// A part of a robot before its fit.
FittedSolid solid_of(const Part& part, double facet_share);
/// Adds the fit of a part.
void take_fit(PartFit fit, FittedSolid& solid);
/// Adds the fit of a mesh, for which `count` balls were requested (0: no number).
void take_fit(SphereFit fit, std::size_t count, FittedSolid& solid);

/// The number of spheres of the last level of all solids.
std::size_t count_spheres(const FitsRecord& record);
/// A share of a volume: exact, or, where a mesh encloses no volume cleanly and is measured by winding numbers at random
/// points, an estimate. The interval of two standard errors around it contains the share in at least 95 of 100 cases.
struct Share {
  double value = 0, standard_error = 0;
  bool is_estimate = false;

  double lower() const { return std::max(0.0, value - 2 * standard_error); }
  double upper() const { return std::min(1.0, value + 2 * standard_error); }
};

/// The share of the volume that balls inside leave uncovered; none if a solid has no volume, or for other contracts.
std::optional<Share> uncovered_share(const FittedSolid& solid, SphereContract contract);
/// Of all solids; none for a body file.
std::optional<Share> uncovered_share(const FitsRecord& record);

}  // namespace medial_vk
