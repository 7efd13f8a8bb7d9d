#include "cli/clearance/kept_bodies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <span>
#include <system_error>
#include <utility>

#include "body_files/body_file.h"
#include "cli/shared/load_body.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "common/digest.h"
#include "common/tool_errors.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/version.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

void add_solid(const LinkSolid& solid, Digest& digest) {
  digest.add(std::uint32_t{solid.ball.has_value()});
  if (solid.ball) {
    for (const double coordinate : solid.ball->centre) digest.add(coordinate);
    digest.add(solid.ball->radius);
  } else {
    digest.add(solid.mesh.prepared().mesh);
  }
}

bool has_same_shape(const LinkSolid& a, const LinkSolid& b) {
  if (a.ball && b.ball) return a.ball->centre == b.ball->centre && a.ball->radius == b.ball->radius;
  if (a.ball || b.ball) return false;
  const Mesh &first = a.mesh.prepared().mesh, &second = b.mesh.prepared().mesh;
  return first.vertices == second.vertices && first.triangles == second.triangles;
}

/// Of two owners, whose first solids have these numbers; that of the second one ends before `end`.
bool have_same_shapes(const RobotAndScene& all, std::size_t first, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t other = first + (i - begin);
    if (other >= begin || all.owner_of(other) != all.owner_of(first)) return false;
    const bool is_same = has_same_shape(all.solids.around[i], all.solids.around[other]) &&
                         has_same_shape(all.solids.inside[i], all.solids.inside[other]);
    if (!is_same) return false;
  }
  const std::size_t behind = first + (end - begin);  // of the first link, which may have more solids
  return behind == begin || all.owner_of(behind) != all.owner_of(first);
}

/// The name of a part or of a file without folder and ending, in letters that every file system takes.
std::string plain_stem(const std::string& name) {
  constexpr std::size_t kMost = 60;
  std::string stem = platform::stem_of(name).substr(0, kMost);
  for (std::size_t i = 0; i < stem.size(); ++i) {
    const char c = stem[i];
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!is_plain && (i == 0 || (c != '-' && c != '.'))) stem[i] = '_';
  }
  return stem;
}

/// All proofs of a body whose solid is between two meshes.
Result<SphereProofs> prove_between(const std::string& path, const RobotAndScene& all, std::size_t number,
                                   const SolidBalls& balls, unsigned threads) {
  const IndexedMesh &around = all.solids.around[number].mesh, &inside = all.solids.inside[number].mesh;
  if (!inside.is_same(around) && !balls.inside.empty()) {
    const Result<SphereProofs> within = prove_body({inside, balls.inside, {}}, path, threads);
    if (!within) return within.error();
  }
  return prove_body({around, balls.inside, balls.cover}, path, threads);
}

bool has_mesh_of(const BodyFile& file, const LinkSolid& solid) {
  const Mesh& mesh = solid.mesh.prepared().mesh;
  return file.mesh.vertices == mesh.vertices && file.mesh.triangles == mesh.triangles;
}

/// No point of a ball is farther from the solid than its radius less the depth of its centre.
Result<Bounds> reach_out_of(const IndexedMesh& mesh, const std::vector<Ball>& balls, unsigned threads) {
  std::vector<Point> centres;
  centres.reserve(balls.size());
  for (const Ball& ball : balls) centres.push_back(ball.centre);
  std::vector<double> depths(balls.size());
  if (Status status = measure_depths(mesh, centres, depths, {threads}); !status) return status.error();
  double most = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    most = std::max(most, std::nextafter(balls[i].radius - depths[i], std::numeric_limits<double>::infinity()));
  }
  return Bounds{0, most};
}

Result<double> volume_of(const std::vector<Ball>& balls, unsigned threads) {
  BallUnionOptions options;
  options.threads = threads;
  const Result<BallUnion> all = measure_ball_union(balls, options);
  if (!all) return all.error();
  return all.value().volume;
}

Result<BodyMeasures> measures_of(const LinkSolid& solid, const SolidBalls& balls, const SphereProofs& proofs,
                                 unsigned threads) {
  BodyMeasures measures;
  measures.inside_excess = proofs.inside.greatest_excess;
  measures.covered_triangles = proofs.cover.triangles;
  measures.envelope_vertices = proofs.cover.vertices;
  measures.solid_volume = solid.mesh.prepared().report.signed_volume;
  if (!balls.inside.empty()) {
    const Result<Bounds> gap = measure_gap(solid.mesh, balls.inside, {threads});
    if (!gap) return gap.error();
    measures.inside_gap = gap.value();
  }
  const Result<Bounds> reach_out = reach_out_of(solid.mesh, balls.cover, threads);
  if (!reach_out) return reach_out.error();
  measures.cover_reach_out = reach_out.value();
  const Result<double> inside = volume_of(balls.inside, threads), cover = volume_of(balls.cover, threads);
  if (!inside) return inside.error();
  if (!cover) return cover.error();
  measures.inside_volume = inside.value();
  measures.cover_volume = cover.value();
  return measures;
}

Error cannot_make(const std::string& folder, const std::string& reason) {
  return {kCannotWrite, fmt::format("{}: {}", folder, reason)};
}

}  // namespace

Status check_folder(const std::string& folder) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(platform::path_of(folder), error);
  if (std::filesystem::is_directory(status)) return {};
  if (std::filesystem::exists(status)) return cannot_make(folder, "is no folder");
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(platform::path_of(folder), error))) {
    return cannot_make(folder, "is a link to nothing");
  }
  return check_writable(folder);
}

Status check_writable_folder(const std::string& folder) {
  std::error_code error;
  return std::filesystem::is_directory(platform::path_of(folder), error) ? check_writable(folder + "/x.body.npz")
                                                                         : Status();
}

Status make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directory(platform::path_of(folder), error);
  if (error) return cannot_make(folder, error.default_error_condition().message());
  return {};
}

std::vector<std::string> names_of_bodies(const RobotAndScene& all, const ClearanceOptions& options) {
  const std::vector<LinkSolid>&around = all.solids.around, &inside = all.solids.inside;
  std::vector<std::string> names;
  names.reserve(around.size());
  std::map<std::string, std::size_t> first_of;  // by stem and digest: the first solid of the first such link
  for (std::size_t begin = 0, end = 0; begin < around.size(); begin = end) {
    Digest of_link;
    of_link.add(kBodyFileFormat);
    of_link.add(static_cast<std::uint64_t>(options.balls));
    of_link.add(options.resolution);
    for (end = begin; end < around.size() && all.owner_of(end) == all.owner_of(begin); ++end) {
      add_solid(around[end], of_link);
      add_solid(inside[end], of_link);
    }
    // Two shapes with one digest are told apart by words that are added.
    const std::string stem = plain_stem(around[begin].name);
    while (true) {
      const auto [first, is_new] = first_of.emplace(stem + of_link.text(), begin);
      if (is_new || have_same_shapes(all, first->second, begin, end)) break;
      of_link.add(std::uint32_t{1});
    }
    for (std::size_t i = begin; i < end; ++i) {
      Digest digest = of_link;
      digest.add(static_cast<std::uint64_t>(i - begin));
      names.push_back(fmt::format("{}-{}.body.npz", plain_stem(around[i].name), digest.text()));
    }
  }
  return names;
}

Result<std::optional<SolidBalls>> read_kept_body(const std::string& path, const RobotAndScene& all, std::size_t number,
                                                 unsigned threads) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  std::error_code error;
  const std::filesystem::path at = platform::path_of(path);
  if (!std::filesystem::exists(at, error) && !error) return std::optional<SolidBalls>();
  const bool opens = std::filesystem::is_regular_file(at, error) && std::ifstream(at).good();
  const auto refused = [opens](Error reason) {
    if (opens && reason.code == ErrorCode::kInvalidMesh)
      reason.message += "; remove the file to have the body fitted again";
    return reason;
  };
  Result<BodyFile> file = read_body_file(path);
  if (!file) return refused(file.error());
  const LinkSolid& solid = all.solids.around[number];
  if (!has_mesh_of(file.value(), solid)) {
    return refused({ErrorCode::kInvalidMesh, fmt::format("{}: its mesh is not that of {}", path, solid.name)});
  }
  SolidBalls balls = {std::move(file.value().inside), std::move(file.value().cover)};
  if (balls.cover.empty()) {
    return refused({ErrorCode::kInvalidMesh, fmt::format("{}: the file has no balls that cover the mesh", path)});
  }
  const Result<SphereProofs> proofs = prove_between(path, all, number, balls, threads);
  if (!proofs) return refused(proofs.error());
  return std::optional(std::move(balls));
}

Result<OutputFile> encode_kept_body(const std::string& path, const RobotAndScene& all, std::size_t number,
                                    const SolidBalls& balls, unsigned threads) {
  const EndAtOnce guard;  // nothing is written yet
  if (interrupted()) return stopped();
  const Result<SphereProofs> proofs = prove_between(path, all, number, balls, threads);
  if (!proofs) {
    const bool is_refused = proofs.error().code == ErrorCode::kInvalidMesh;
    return Error{is_refused ? ErrorCode::kInternal : proofs.error().code, proofs.error().message};
  }
  const LinkSolid& solid = all.solids.around[number];
  const Result<BodyMeasures> measures = measures_of(solid, balls, proofs.value(), threads);
  if (!measures) return measures.error();
  BodyFile file;
  file.version = version();
  file.mesh.vertices = solid.mesh.prepared().mesh.vertices;
  file.mesh.triangles = solid.mesh.prepared().mesh.triangles;
  file.inside = balls.inside;
  file.cover = balls.cover;
  file.measures = measures.value();
  Result<std::string> bytes = encode_body_file(file);
  if (!bytes) return bytes.error();
  return OutputFile{path, std::move(bytes).value()};
}

}  // namespace medial_vk::cli
