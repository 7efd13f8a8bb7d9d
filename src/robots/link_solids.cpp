#include "robots/link_solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "input/text_scanner.h"
#include "robots/parts.h"
#include "robots/primitive_mesh.h"

namespace medial_vk {
namespace {

Result<IndexedMesh> index_ball(const Ball& ball, FacetSide side, const PrepareOptions& options) {
  Geometry sphere;
  sphere.kind = GeometryKind::kSphere;
  sphere.size = {ball.radius, 0, 0};
  Result<PreparedMesh> prepared = prepare_mesh(make_primitive(sphere, side), options);
  if (!prepared) return prepared.error();
  return IndexedMesh::build(std::move(prepared).value(), {.threads = options.threads});
}

/// Facets inside a sphere are at least (1 - share) (1 - 2^-48) of its radius from the centre, and the corners of those
/// around it at most (1 + 2^-48) / (1 - share) (make_primitive()): twice the share is more than enough for both.
Ball ball_of_facets(const Ball& sphere, FacetSide side) {
  const double share = 2 * facet_share(GeometryKind::kCapsule);
  return {sphere.centre, sphere.radius * (side == FacetSide::kInscribed ? 1 - share : 1 + share)};
}

/// The meshes of parts, with facets on one side of curved ones.
Result<std::vector<LinkSolid>> solids_of(const Robot& robot, const RobotParts& loaded, FacetSide side,
                                         const std::string& name, const PrepareOptions& options) {
  std::map<std::string_view, std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < robot.links.size(); ++i) numbers.emplace(robot.links[i].name, i);
  std::vector<LinkSolid> solids;
  for (const Part& part : loaded.parts) {
    Result<IndexedMesh> mesh = part.mesh ? Result<IndexedMesh>(*part.mesh) : index_ball(*part.ball, side, options);
    if (!mesh) {
      return Error{mesh.error().code,
                   fmt::format("{}: link {}: {}: {}", name, quoted(part.link), part.name, mesh.error().message)};
    }
    solids.push_back({std::move(mesh).value(), numbers.at(part.link), part.pose, part.name, {}});
    if (part.ball) solids.back().ball = ball_of_facets(*part.ball, side);
  }
  return solids;
}

double share_of(const RobotParts& loaded, std::size_t i) {
  return loaded.parts[i].ball ? facet_share(GeometryKind::kCapsule) : loaded.origins[i].facet_share;
}

}  // namespace

Result<LinkSolids> load_link_solids(const Robot& robot, bool visual, const MeshPlaces& places, const std::string& name,
                                    const PrepareOptions& options) {
  const Result<RobotParts> loaded = load_parts(robot, visual, FacetSide::kCircumscribed, places, name, options);
  if (!loaded) return loaded.error();
  Result<std::vector<LinkSolid>> around = solids_of(robot, loaded.value(), FacetSide::kCircumscribed, name, options);
  if (!around) return around.error();
  LinkSolids solids;
  for (std::size_t i = 0; i < loaded.value().parts.size(); ++i) {
    solids.facet_share = std::max(solids.facet_share, share_of(loaded.value(), i));
  }
  solids.around = std::move(around).value();
  solids.inside = solids.around;
  if (solids.facet_share == 0) return solids;
  const Result<RobotParts> again = load_parts(robot, visual, FacetSide::kInscribed, places, name, options);
  if (!again) return again.error();
  Result<std::vector<LinkSolid>> inside = solids_of(robot, again.value(), FacetSide::kInscribed, name, options);
  if (!inside) return inside.error();
  for (std::size_t i = 0; i < solids.inside.size(); ++i) {
    if (share_of(loaded.value(), i) > 0) solids.inside[i] = inside.value()[i];
  }
  return solids;
}

Result<std::vector<GroupPart>> bodies_of(std::span<const LinkSolid> solids, unsigned threads, const KnownBodies& known,
                                         const ProgressCallback& progress, const std::stop_token& stop) {
  std::vector<GroupPart> parts;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(solids.size()));
    const LinkSolid& solid = solids[i];
    const auto has_its_mesh = [&](const LinkSolid& other) { return other.mesh.is_same(solid.mesh); };
    const auto before = solids.first(i);
    const auto same = std::ranges::find_if(before, has_its_mesh);
    const auto known_one = std::ranges::find_if(known.solids, has_its_mesh);
    if (same != before.end()) {
      parts.push_back({parts[static_cast<std::size_t>(same - before.begin())].body, solid.link, solid.pose});
    } else if (known_one != known.solids.end()) {
      const auto number = static_cast<std::size_t>(known_one - known.solids.begin());
      parts.push_back({known.parts[number].body, solid.link, solid.pose});
    } else {
      Result<Body> body = Body::create(solid.mesh, {}, {}, {threads}, {}, stop);
      if (!body) return body.error();
      parts.push_back({std::move(body).value(), solid.link, solid.pose});
    }
  }
  return parts;
}

}  // namespace medial_vk
