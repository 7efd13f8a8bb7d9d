// The structures that C++ and GLSL share (shaders/shared/types/gpu_types.h): the layout of the C++ compiler against
// that of the shader compiler, member by member, in every embedded kernel that uses them.
#include "gpu_types.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "ball_types.h"
#include "device/embedded_shaders.h"
#include "follow_types.h"
#include "proximity_types.h"
#include "support/device/spirv_structs.h"
#if __has_include("thesis_types.h")
#include "thesis_types.h"
#define MEDIAL_VK_HAS_THESIS_TYPES 1
#endif

namespace medial_vk {
namespace {

struct Member {
  std::string name;
  std::size_t offset;
};

struct Layout {
  std::string name;
  std::size_t size;
  std::vector<Member> members;
};

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): a member's name and its offset from one word.
#define MEDIAL_VK_MEMBER(type, member) \
  Member { #member, offsetof(gpu::type, member) }

// long: a table of all structs that shaders share.
const std::vector<Layout>& shared_layouts() {
  static const std::vector<Layout> layouts = {
      {"Cell",
       sizeof(gpu::Cell),
       {MEDIAL_VK_MEMBER(Cell, x), MEDIAL_VK_MEMBER(Cell, y), MEDIAL_VK_MEMBER(Cell, z), MEDIAL_VK_MEMBER(Cell, voxel),
        MEDIAL_VK_MEMBER(Cell, list_begin), MEDIAL_VK_MEMBER(Cell, list_count), MEDIAL_VK_MEMBER(Cell, word_begin),
        MEDIAL_VK_MEMBER(Cell, flags), MEDIAL_VK_MEMBER(Cell, nearest), MEDIAL_VK_MEMBER(Cell, touching),
        MEDIAL_VK_MEMBER(Cell, partner), MEDIAL_VK_MEMBER(Cell, winding)}},
      {"Line",
       sizeof(gpu::Line),
       {MEDIAL_VK_MEMBER(Line, p), MEDIAL_VK_MEMBER(Line, q), MEDIAL_VK_MEMBER(Line, toward_p),
        MEDIAL_VK_MEMBER(Line, toward_q), MEDIAL_VK_MEMBER(Line, cell), MEDIAL_VK_MEMBER(Line, voxel),
        MEDIAL_VK_MEMBER(Line, accepted), MEDIAL_VK_MEMBER(Line, seed)}},
      {"FoundPoint",
       sizeof(gpu::FoundPoint),
       {MEDIAL_VK_MEMBER(FoundPoint, centre), MEDIAL_VK_MEMBER(FoundPoint, spoke_a),
        MEDIAL_VK_MEMBER(FoundPoint, spoke_b), MEDIAL_VK_MEMBER(FoundPoint, voxel_x),
        MEDIAL_VK_MEMBER(FoundPoint, voxel_y), MEDIAL_VK_MEMBER(FoundPoint, voxel_z),
        MEDIAL_VK_MEMBER(FoundPoint, cell)}},
      {"Cluster",
       sizeof(gpu::Cluster),
       {MEDIAL_VK_MEMBER(Cluster, lower), MEDIAL_VK_MEMBER(Cluster, upper), MEDIAL_VK_MEMBER(Cluster, centre),
        MEDIAL_VK_MEMBER(Cluster, axis), MEDIAL_VK_MEMBER(Cluster, point), MEDIAL_VK_MEMBER(Cluster, half_height),
        MEDIAL_VK_MEMBER(Cluster, sin_tilt), MEDIAL_VK_MEMBER(Cluster, first), MEDIAL_VK_MEMBER(Cluster, count)}},
      {"OpenEdge",
       sizeof(gpu::OpenEdge),
       {MEDIAL_VK_MEMBER(OpenEdge, from), MEDIAL_VK_MEMBER(OpenEdge, to), MEDIAL_VK_MEMBER(OpenEdge, apex)}},
      {"TriangleLinks",
       sizeof(gpu::TriangleLinks),
       {MEDIAL_VK_MEMBER(TriangleLinks, corner), MEDIAL_VK_MEMBER(TriangleLinks, flags),
        MEDIAL_VK_MEMBER(TriangleLinks, neighbour), MEDIAL_VK_MEMBER(TriangleLinks, padding)}},
      {"Aim", sizeof(gpu::Aim), {MEDIAL_VK_MEMBER(Aim, base), MEDIAL_VK_MEMBER(Aim, direction)}},
      {"UndecidedCell",
       sizeof(gpu::UndecidedCell),
       {MEDIAL_VK_MEMBER(UndecidedCell, x), MEDIAL_VK_MEMBER(UndecidedCell, y), MEDIAL_VK_MEMBER(UndecidedCell, z),
        MEDIAL_VK_MEMBER(UndecidedCell, kind), MEDIAL_VK_MEMBER(UndecidedCell, width),
        MEDIAL_VK_MEMBER(UndecidedCell, padding_0), MEDIAL_VK_MEMBER(UndecidedCell, padding_1),
        MEDIAL_VK_MEMBER(UndecidedCell, padding_2)}},
      {"ProximityNode",
       sizeof(gpu::ProximityNode),
       {MEDIAL_VK_MEMBER(ProximityNode, balls), MEDIAL_VK_MEMBER(ProximityNode, below)}},
      {"ProximityTree",
       sizeof(gpu::ProximityTree),
       {MEDIAL_VK_MEMBER(ProximityTree, root), MEDIAL_VK_MEMBER(ProximityTree, levels),
        MEDIAL_VK_MEMBER(ProximityTree, reach), MEDIAL_VK_MEMBER(ProximityTree, unused)}},
      {"ProximityBody",
       sizeof(gpu::ProximityBody),
       {MEDIAL_VK_MEMBER(ProximityBody, inside), MEDIAL_VK_MEMBER(ProximityBody, cover),
        MEDIAL_VK_MEMBER(ProximityBody, centre)}},
      {"ProximityPose",
       sizeof(gpu::ProximityPose),
       {MEDIAL_VK_MEMBER(ProximityPose, row_x), MEDIAL_VK_MEMBER(ProximityPose, row_y),
        MEDIAL_VK_MEMBER(ProximityPose, row_z), MEDIAL_VK_MEMBER(ProximityPose, a), MEDIAL_VK_MEMBER(ProximityPose, b),
        MEDIAL_VK_MEMBER(ProximityPose, inside_error), MEDIAL_VK_MEMBER(ProximityPose, cover_error)}},
      {"ProximityBounds",
       sizeof(gpu::ProximityBounds),
       {MEDIAL_VK_MEMBER(ProximityBounds, lower), MEDIAL_VK_MEMBER(ProximityBounds, upper),
        MEDIAL_VK_MEMBER(ProximityBounds, cover_a), MEDIAL_VK_MEMBER(ProximityBounds, cover_b),
        MEDIAL_VK_MEMBER(ProximityBounds, inside_a), MEDIAL_VK_MEMBER(ProximityBounds, inside_b)}},
      {"ProximityConstants",
       sizeof(gpu::ProximityConstants),
       {MEDIAL_VK_MEMBER(ProximityConstants, pose_count), MEDIAL_VK_MEMBER(ProximityConstants, body_count),
        MEDIAL_VK_MEMBER(ProximityConstants, most_steps), MEDIAL_VK_MEMBER(ProximityConstants, leaves_rest)}},
      {"FollowConstants",
       sizeof(gpu::FollowConstants),
       {MEDIAL_VK_MEMBER(FollowConstants, ball_count), MEDIAL_VK_MEMBER(FollowConstants, place_count),
        MEDIAL_VK_MEMBER(FollowConstants, triangle_count), MEDIAL_VK_MEMBER(FollowConstants, from_rest),
        MEDIAL_VK_MEMBER(FollowConstants, scale), MEDIAL_VK_MEMBER(FollowConstants, inverse_scale),
        MEDIAL_VK_MEMBER(FollowConstants, shrunk), MEDIAL_VK_MEMBER(FollowConstants, flat_turn)}},
      {"RefitConstants",
       sizeof(gpu::RefitConstants),
       {MEDIAL_VK_MEMBER(RefitConstants, triangle_count), MEDIAL_VK_MEMBER(RefitConstants, first_level),
        MEDIAL_VK_MEMBER(RefitConstants, end_level), MEDIAL_VK_MEMBER(RefitConstants, scale)}},
      {"StepConstants",
       sizeof(gpu::StepConstants),
       {MEDIAL_VK_MEMBER(StepConstants, cell_size),
        MEDIAL_VK_MEMBER(StepConstants, circumradius),
        MEDIAL_VK_MEMBER(StepConstants, list_radius),
        MEDIAL_VK_MEMBER(StepConstants, voxel_size),
        MEDIAL_VK_MEMBER(StepConstants, epsilon),
        MEDIAL_VK_MEMBER(StepConstants, angle),
        MEDIAL_VK_MEMBER(StepConstants, cos_twice_angle),
        MEDIAL_VK_MEMBER(StepConstants, radius),
        MEDIAL_VK_MEMBER(StepConstants, deep_angle),
        MEDIAL_VK_MEMBER(StepConstants, cos_twice_deep_angle),
        MEDIAL_VK_MEMBER(StepConstants, slack),
        MEDIAL_VK_MEMBER(StepConstants, grid_x),
        MEDIAL_VK_MEMBER(StepConstants, grid_y),
        MEDIAL_VK_MEMBER(StepConstants, grid_z),
        MEDIAL_VK_MEMBER(StepConstants, voxels_per_cell),
        MEDIAL_VK_MEMBER(StepConstants, depth),
        MEDIAL_VK_MEMBER(StepConstants, first_entry),
        MEDIAL_VK_MEMBER(StepConstants, items_counter),
        MEDIAL_VK_MEMBER(StepConstants, items_multiplier),
        MEDIAL_VK_MEMBER(StepConstants, first_item),
        MEDIAL_VK_MEMBER(StepConstants, level),
        MEDIAL_VK_MEMBER(StepConstants, open_edges),
        MEDIAL_VK_MEMBER(StepConstants, ends),
        MEDIAL_VK_MEMBER(StepConstants, block_xy),
        MEDIAL_VK_MEMBER(StepConstants, block_z),
        MEDIAL_VK_MEMBER(StepConstants, half_side),
        MEDIAL_VK_MEMBER(StepConstants, touch_half_side),
        MEDIAL_VK_MEMBER(StepConstants, cluster_count),
        MEDIAL_VK_MEMBER(StepConstants, lists),
        MEDIAL_VK_MEMBER(StepConstants, clusters_per_round),
        MEDIAL_VK_MEMBER(StepConstants, lines_per_cell),
        MEDIAL_VK_MEMBER(StepConstants, second_task)}},
      {"ScanConstants",
       sizeof(gpu::ScanConstants),
       {MEDIAL_VK_MEMBER(ScanConstants, items_counter), MEDIAL_VK_MEMBER(ScanConstants, items_multiplier),
        MEDIAL_VK_MEMBER(ScanConstants, total_x), MEDIAL_VK_MEMBER(ScanConstants, total_y),
        MEDIAL_VK_MEMBER(ScanConstants, total_z), MEDIAL_VK_MEMBER(ScanConstants, limit_x),
        MEDIAL_VK_MEMBER(ScanConstants, limit_y), MEDIAL_VK_MEMBER(ScanConstants, limit_z)}},
      {"DispatchConstants",
       sizeof(gpu::DispatchConstants),
       {MEDIAL_VK_MEMBER(DispatchConstants, items_counter), MEDIAL_VK_MEMBER(DispatchConstants, items_multiplier),
        MEDIAL_VK_MEMBER(DispatchConstants, items_divisor), MEDIAL_VK_MEMBER(DispatchConstants, group_size),
        MEDIAL_VK_MEMBER(DispatchConstants, least_items), MEDIAL_VK_MEMBER(DispatchConstants, first_item),
        MEDIAL_VK_MEMBER(DispatchConstants, item_limit), MEDIAL_VK_MEMBER(DispatchConstants, queries_per_item),
        MEDIAL_VK_MEMBER(DispatchConstants, list_counter), MEDIAL_VK_MEMBER(DispatchConstants, first_entry),
        MEDIAL_VK_MEMBER(DispatchConstants, entry_limit), MEDIAL_VK_MEMBER(DispatchConstants, threads),
        MEDIAL_VK_MEMBER(DispatchConstants, argument)}},
      {"SplitBall",
       sizeof(gpu::SplitBall),
       {MEDIAL_VK_MEMBER(SplitBall, high), MEDIAL_VK_MEMBER(SplitBall, middle), MEDIAL_VK_MEMBER(SplitBall, low)}},
      {"BallNode",
       sizeof(gpu::BallNode),
       {MEDIAL_VK_MEMBER(BallNode, middle_high), MEDIAL_VK_MEMBER(BallNode, middle_low),
        MEDIAL_VK_MEMBER(BallNode, axis_0), MEDIAL_VK_MEMBER(BallNode, axis_1), MEDIAL_VK_MEMBER(BallNode, axis_2),
        MEDIAL_VK_MEMBER(BallNode, slope)}},
      {"MeasuredBall",
       sizeof(gpu::MeasuredBall),
       {MEDIAL_VK_MEMBER(MeasuredBall, volume), MEDIAL_VK_MEMBER(MeasuredBall, area),
        MEDIAL_VK_MEMBER(MeasuredBall, volume_bound), MEDIAL_VK_MEMBER(MeasuredBall, area_bound)}},
      {"BallConstants",
       sizeof(gpu::BallConstants),
       {MEDIAL_VK_MEMBER(BallConstants, ball_count), MEDIAL_VK_MEMBER(BallConstants, first_ball),
        MEDIAL_VK_MEMBER(BallConstants, end_ball), MEDIAL_VK_MEMBER(BallConstants, first_leaf),
        MEDIAL_VK_MEMBER(BallConstants, iterations)}},
#ifdef MEDIAL_VK_HAS_THESIS_TYPES
      {"ThesisCell",
       sizeof(gpu::ThesisCell),
       {MEDIAL_VK_MEMBER(ThesisCell, x), MEDIAL_VK_MEMBER(ThesisCell, y), MEDIAL_VK_MEMBER(ThesisCell, z),
        MEDIAL_VK_MEMBER(ThesisCell, flags), MEDIAL_VK_MEMBER(ThesisCell, distance), MEDIAL_VK_MEMBER(ThesisCell, flux),
        MEDIAL_VK_MEMBER(ThesisCell, sphere), MEDIAL_VK_MEMBER(ThesisCell, padding)}},
      {"Retraction",
       sizeof(gpu::Retraction),
       {MEDIAL_VK_MEMBER(Retraction, p), MEDIAL_VK_MEMBER(Retraction, q), MEDIAL_VK_MEMBER(Retraction, contact),
        MEDIAL_VK_MEMBER(Retraction, voxel), MEDIAL_VK_MEMBER(Retraction, source),
        MEDIAL_VK_MEMBER(Retraction, padding_0), MEDIAL_VK_MEMBER(Retraction, padding_1)}},
#endif
  };
  return layouts;
}

void expect_same(const Layout& cpp, const test::SpirvStruct& glsl) {
  ASSERT_EQ(glsl.offsets.size(), cpp.members.size()) << "members";
  ASSERT_EQ(glsl.names.size(), cpp.members.size()) << "are names kept in the embedded modules?";
  for (std::uint32_t i = 0; i < cpp.members.size(); ++i) {
    EXPECT_EQ(glsl.names.at(i), cpp.members[i].name) << "member " << i;
    EXPECT_EQ(glsl.offsets.at(i), cpp.members[i].offset) << cpp.members[i].name;
  }
  // Arrays in storage buffers: consecutive elements lie as far apart as in C++.
  if (glsl.stride != 0) {
    EXPECT_EQ(glsl.stride, cpp.size);
  }
}

class SharedStruct : public testing::TestWithParam<Layout> {};

TEST_P(SharedStruct, LiesInMemoryAsInEveryKernel) {
  const Layout& cpp = GetParam();
  int kernels = 0;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    SCOPED_TRACE(std::string(shader.name));
    for (const test::SpirvStruct& glsl : test::read_spirv_structs(shader.words)) {
      if (glsl.name != cpp.name) continue;
      ++kernels;
      expect_same(cpp, glsl);
    }
  }
  EXPECT_GT(kernels, 0) << "no embedded kernel has a structure of this name with a layout";
}

INSTANTIATE_TEST_SUITE_P(GpuTypes, SharedStruct, testing::ValuesIn(shared_layouts()),
                         [](const auto& layout) { return layout.param.name; });

// Vulkan guarantees 128 bytes of push constants, and no more.
TEST(GpuTypes, PushConstantsFitEveryDevice) {
  EXPECT_LE(sizeof(gpu::StepConstants), 128u);
  EXPECT_LE(sizeof(gpu::ScanConstants), 128u);
  EXPECT_LE(sizeof(gpu::DispatchConstants), 128u);
  EXPECT_LE(sizeof(gpu::PrepareConstants), 128u);
}

// Structures in storage buffers that are missing from the table above.
TEST(GpuTypes, EveryStructureInAStorageBufferIsCompared) {
  for (const EmbeddedShader& shader : embedded_shaders()) {
    for (const test::SpirvStruct& glsl : test::read_spirv_structs(shader.words)) {
      if (glsl.stride == 0) continue;  // a block, or push constants
      const auto same_name = [&](const Layout& layout) { return layout.name == glsl.name; };
      EXPECT_TRUE(std::any_of(shared_layouts().begin(), shared_layouts().end(), same_name))
          << shader.name << " has an array of " << glsl.name << ", which is in no header that C++ reads";
    }
  }
}

}  // namespace
}  // namespace medial_vk
