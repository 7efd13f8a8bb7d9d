// Proofs of given balls.
#include <gtest/gtest.h>

#include <stop_token>
#include <vector>

#include "medial_vk/prepare.h"
#include "medial_vk/sphere_proofs.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

TEST(ProveSpheres, AcceptsTrueBallsAndRefusesOthers) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const std::vector<Ball> inside = {{{0.5, 0.5, 0.5}, 0.499}}, cover = {{{0.5, 0.5, 0.5}, 0.87}};
  const SphereProofs proofs = prove_spheres(mesh, inside, cover).value();
  EXPECT_TRUE(proofs.inside.proved());
  EXPECT_TRUE(proofs.cover.proved());
  const std::vector<Ball> large = {inside[0], {{0.5, 0.5, 0.5}, 0.5001}}, small = {{{0.5, 0.5, 0.5}, 0.86}};
  const SphereProofs refused = prove_spheres(mesh, large, small).value();
  EXPECT_EQ(refused.inside.failed, 1u);
  EXPECT_EQ(refused.inside.first_failure, 1u);
  EXPECT_FALSE(refused.cover.proved());
  EXPECT_FALSE(prove_spheres(mesh, {{{{2, 0.5, 0.5}, 0.1}}}, cover).value().inside.proved());
}

TEST(ProveSpheres, NoBallCoversNothing) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
  const SphereProofs proofs = prove_spheres(mesh, {}, {}).value();
  EXPECT_TRUE(proofs.inside.proved());
  EXPECT_FALSE(proofs.cover.proved());
  EXPECT_EQ(proofs.cover.uncovered, 12u);
  std::stop_source stopped;
  stopped.request_stop();
  const std::vector<Ball> cover = {{{0.5, 0.5, 0.5}, 0.87}};
  EXPECT_EQ(prove_spheres(mesh, {}, cover, {}, stopped.get_token()).error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(prove_spheres(mesh, {}, {{{{0, 0, 0}, -1}}}).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
