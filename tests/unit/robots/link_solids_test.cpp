// The solids of links for distances: facets on both sides of curved shapes, shared bodies, links that always touch.
#include "robots/link_solids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "robots/model/link_pairs.h"
#include "robots/model/read_urdf.h"
#include "robots/primitive_mesh.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;

std::string link_with(const std::string& name, const std::string& shape, const std::string& origin = "0 0 0") {
  return "<link name='" + name + "'><collision><origin xyz='" + origin + "'/><geometry>" + shape +
         "</geometry></collision></link>";
}

Robot moving(const std::string& inner) {
  const Result<Robot> robot = read_urdf("<robot name='r'>" + inner + "</robot>", "r.urdf", UrdfDetail::kMotion);
  EXPECT_TRUE(robot.ok()) << (robot.ok() ? "" : robot.error().message);
  return robot.value();
}

LinkSolids solids_of_robot(const Robot& robot) {
  const Result<LinkSolids> solids = load_link_solids(robot, false, {}, "r.urdf", {});
  EXPECT_TRUE(solids.ok()) << (solids.ok() ? "" : solids.error().message);
  return solids.value();
}

/// A facet is nearest to the middle where its plane is.
TEST(LinkSolidsTest, FacetsOfASphereAreInsideAndAround) {
  Geometry sphere;
  sphere.kind = GeometryKind::kSphere;
  sphere.size = {0.7, 0, 0};
  for (const FacetSide side : {FacetSide::kInscribed, FacetSide::kCircumscribed}) {
    const Mesh mesh = make_primitive(sphere, side);
    double least = 1e9, greatest = 0;
    for (const Triangle& t : mesh.triangles) {
      const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      const Point normal = cross(b - a, c - a);
      ASSERT_GT(length(normal), 0);
      least = std::min(least, dot(normal, a) / length(normal));
    }
    for (const Point& p : mesh.vertices) greatest = std::max(greatest, length(p));
    const double share = facet_share(GeometryKind::kCapsule);
    if (side == FacetSide::kInscribed) {
      EXPECT_LE(greatest, 0.7);
      EXPECT_GE(least, 0.7 * (1 - share) * (1 - 1e-12));
    } else {
      EXPECT_GE(least, 0.7);
      EXPECT_LE(greatest, 0.7 / (1 - share) * (1 + 1e-12));
    }
    const Result<PreparedMesh> prepared = prepare_mesh(mesh, {});
    ASSERT_TRUE(prepared.ok());
    EXPECT_TRUE(prepared.value().report.closed);
    EXPECT_EQ(prepared.value().report.triangles, mesh.triangles.size());
  }
}

TEST(LinkSolidsTest, OnlyCurvedShapesHaveTwoMeshes) {
  const Robot robot =
      moving(link_with("a", "<box size='1 1 1'/>") + link_with("b", "<cylinder radius='1' length='2'/>"));
  const LinkSolids solids = solids_of_robot(robot);
  ASSERT_EQ(solids.around.size(), 2u);
  EXPECT_TRUE(solids.around[0].mesh.is_same(solids.inside[0].mesh));
  EXPECT_FALSE(solids.around[1].mesh.is_same(solids.inside[1].mesh));
  EXPECT_EQ(solids.facet_share, facet_share(GeometryKind::kCylinder));
  EXPECT_EQ(solids.around[1].link, 1u);
  EXPECT_EQ(solids_of_robot(moving(link_with("a", "<box size='1 1 1'/>"))).facet_share, 0);
}

/// Box 1 turns on box 0, into which box 2 reaches from box 1, at the axis, so that both always meet; box 3 turns at box
/// 2 far from box 0, and meets it only in some positions.
TEST(LinkSolidsTest, LinksThatAlwaysTouchAreFound) {
  const std::string box = "<box size='1 1 1'/>";
  const auto joint = [](const char* name, const char* a, const char* b, const char* axis) {
    return "<joint name='" + std::string(name) + "' type='continuous'><parent link='" + a + "'/><child link='" + b +
           "'/><axis xyz='" + axis + "'/></joint>";
  };
  const Robot robot = moving(link_with("a", box) + link_with("b", box, "0 0 1.5") + link_with("c", box) +
                             link_with("d", box, "1.2 0 0") + joint("ab", "a", "b", "0 0 1") +
                             joint("bc", "b", "c", "0 0 1") + joint("cd", "c", "d", "0 1 0"));
  const LinkSolids solids = solids_of_robot(robot);
  const Result<std::vector<GroupPart>> parts = bodies_of(solids.around, 1);
  ASSERT_TRUE(parts.ok());
  const ChosenPairs chosen = choose_pairs(robot, std::vector<bool>(4, true));
  EXPECT_THAT(chosen.compared, ElementsAre(LinkPair{0, 2}, LinkPair{0, 3}, LinkPair{1, 3}));
  const Result<std::vector<LinkPair>> touching =
      find_always_touching(Kinematics(robot), parts.value(), chosen.compared);
  ASSERT_TRUE(touching.ok());
  EXPECT_THAT(touching.value(), ElementsAre(LinkPair{0, 2}));
  std::stop_source stop;
  stop.request_stop();
  const Result<std::vector<LinkPair>> stopped =
      find_always_touching(Kinematics(robot), parts.value(), chosen.compared, {}, stop.get_token());
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
