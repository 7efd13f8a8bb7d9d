// The linear program of radii, against all vertices in extended precision.
#include "hull_fits/search/radius_program.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace medial_vk {
namespace {

using FarRadii = std::array<long double, 3>;

struct RadiusConstraint {
  std::array<double, 3> weight;
  double bound;
};

struct RandomProgram {
  std::size_t count;
  double least;
  std::array<double, 3> greatest;
  std::vector<RadiusConstraint> constraints;

  /// All constraints, as weight . r <= bound.
  std::vector<RadiusConstraint> all() const {
    std::vector<RadiusConstraint> spaces = constraints;
    for (std::size_t i = 0; i < count; ++i) {
      std::array<double, 3> unit = {};
      unit[i] = 1;
      spaces.push_back({unit, greatest[i]});
      unit[i] = -1;
      spaces.push_back({unit, -least});
    }
    return spaces;
  }
};

/// Some weights and bounds are near those before, so that their boundaries meet at small angles.
RandomProgram random_program(std::size_t count, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  RandomProgram program;
  program.count = count;
  program.least = uniform(0, 0.3);
  for (double& x : program.greatest) x = uniform(0.3, 1);
  const std::size_t size = random() % 12;
  for (std::size_t k = 0; k < size; ++k) {
    RadiusConstraint made = {{}, uniform(0.1, 0.9)};
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      made.weight[i] = random() % 5 == 0 ? 0 : uniform(0, 1);
      sum += made.weight[i];
    }
    if (!(sum > 0)) made.weight[0] = sum = 1;
    for (double& x : made.weight) x /= sum;
    if (k > 0 && random() % 2 == 0) {
      const RadiusConstraint& last = program.constraints.back();
      const double share = std::pow(10, uniform(-12, -1));
      for (std::size_t i = 0; i < count; ++i) made.weight[i] = (1 - share) * last.weight[i] + share * made.weight[i];
      made.bound = (1 - share) * last.bound + share * made.bound;
    }
    program.constraints.push_back(made);
  }
  return program;
}

/// The meeting of `count` boundaries, by Gaussian elimination.
std::optional<FarRadii> meeting_of(const std::array<RadiusConstraint, 3>& spaces, std::size_t count) {
  std::array<std::array<long double, 4>, 3> rows{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < count; ++k) rows[i][k] = spaces[i].weight[k];
    rows[i][3] = spaces[i].bound;
  }
  for (std::size_t k = 0; k < count; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < count; ++i) {
      if (std::fabs(rows[i][k]) > std::fabs(rows[pivot][k])) pivot = i;
    }
    if (std::fabs(rows[pivot][k]) < 1e-15L) return std::nullopt;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < count; ++i) {
      if (i == k) continue;
      const long double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = 0; j < 4; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  FarRadii radii = {};
  for (std::size_t k = 0; k < count; ++k) radii[k] = rows[k][3] / rows[k][k];
  return radii;
}

/// The greatest sum of radii with all bounds greater by `slack`; no value: no radii satisfy them. The feasible radii
/// are a polytope, so that the greatest sum is at a vertex.
std::optional<long double> best_vertex(const RandomProgram& program, long double slack) {
  std::vector<RadiusConstraint> spaces = program.all();
  std::optional<long double> best;
  const auto try_vertex = [&](const std::array<RadiusConstraint, 3>& chosen) {
    std::array<RadiusConstraint, 3> moved = chosen;
    for (RadiusConstraint& space : moved) space.bound += static_cast<double>(slack);
    const std::optional<FarRadii> radii = meeting_of(moved, program.count);
    if (!radii) return;
    const FarRadii& r = *radii;
    for (const RadiusConstraint& space : spaces) {
      const long double product = space.weight[0] * r[0] + space.weight[1] * r[1] + space.weight[2] * r[2];
      if (product > space.bound + slack + 1e-17L) return;  // the rounding of long double
    }
    const long double sum = r[0] + r[1] + r[2];
    if (!best || sum > *best) best = sum;
  };
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    if (program.count == 1) {
      try_vertex({spaces[i], {}, {}});
      continue;
    }
    for (std::size_t j = i + 1; j < spaces.size(); ++j) {
      if (program.count == 2) {
        try_vertex({spaces[i], spaces[j], {}});
        continue;
      }
      for (std::size_t k = j + 1; k < spaces.size(); ++k) try_vertex({spaces[i], spaces[j], spaces[k]});
    }
  }
  return best;
}

/// Radii satisfy each constraint up to 2^-44 of the greatest radius, which is below 1, and the rounding of a product,
/// so their sum is at most the best one of a program with bounds that are greater by 2^-43. The other way round, a
/// vertex that bounds smaller by 2^-43 leave is beside one that the program accepts.
constexpr long double kGiven = 0x1p-43L;

class RadiusPrograms : public testing::TestWithParam<std::size_t> {};

TEST_P(RadiusPrograms, FindTheBestVertex) {
  std::mt19937_64 random(GetParam());
  int feasible = 0, infeasible = 0;
  for (int i = 0; i < 1500; ++i) {
    const RandomProgram made = random_program(GetParam(), random);
    RadiusProgram program(made.count, made.least, made.greatest);
    for (const RadiusConstraint& constraint : made.constraints) {
      const bool is_feasible = program.add(constraint.weight, constraint.bound);
      EXPECT_EQ(is_feasible, program.is_feasible());
    }
    const std::optional<long double> most = best_vertex(made, kGiven), surely = best_vertex(made, -kGiven);
    if (surely) {
      EXPECT_TRUE(program.is_feasible()) << i;
    }
    if (!program.is_feasible()) {
      ++infeasible;
      continue;
    }
    ++feasible;
    const std::array<double, 3>& r = program.radii();
    const long double sum = static_cast<long double>(r[0]) + r[1] + r[2];
    ASSERT_TRUE(most) << i;
    EXPECT_LE(sum, *most) << i;
    if (surely) {
      EXPECT_GE(sum, *surely) << i;
    }
    for (const RadiusConstraint& space : made.all()) {
      EXPECT_LE(space.weight[0] * r[0] + space.weight[1] * r[1] + space.weight[2] * r[2],
                space.bound + static_cast<double>(kGiven))
          << i;
    }
    for (std::size_t k = made.count; k < 3; ++k) EXPECT_EQ(r[k], 0);
  }
  EXPECT_GT(feasible, 300);
  EXPECT_GT(infeasible, 100);
}

INSTANTIATE_TEST_SUITE_P(Counts, RadiusPrograms, testing::Values(1, 2, 3));

TEST(RadiusProgram, StartsWithTheGreatestRadii) {
  RadiusProgram program(2, 0.5, {1, 2, 7});
  EXPECT_TRUE(program.is_feasible());
  EXPECT_EQ(program.radii(), (std::array<double, 3>{1, 2, 0}));
  EXPECT_TRUE(program.add({0.5, 0.5, 0}, 1));
  EXPECT_DOUBLE_EQ(program.radii()[0] + program.radii()[1], 2);
  EXPECT_FALSE(program.add({0.5, 0.5, 0}, 0.4)) << "both radii are at least 0.5";
  EXPECT_FALSE(program.add({0.5, 0.5, 0}, 3)) << "it stays so";
  EXPECT_FALSE(RadiusProgram(2, 1.5, {1, 2, 0}).is_feasible());
}

}  // namespace
}  // namespace medial_vk
