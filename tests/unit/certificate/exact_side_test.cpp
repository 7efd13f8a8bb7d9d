// The side of a bisector on which three others meet: against long integers, and the five decisions about five balls
// against each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "ball_unions/triangulation/bisector.h"
#include "support/exact_number.h"

namespace medial_vk {
namespace {

using test::ExactNumber;
using Row = std::array<ExactNumber, 4>;  // normal, offset
using Names = std::array<std::int32_t, 4>;

Row row(const std::vector<Ball>& balls, const std::vector<Wall>& walls, std::uint32_t i, std::int32_t name) {
  if (name < 0) {
    const Wall& wall = walls[static_cast<std::size_t>(-1 - name)];
    return {wall.normal[0], wall.normal[1], wall.normal[2], wall.offset};
  }
  const Ball &a = balls[i], &b = balls[static_cast<std::size_t>(name)];
  Row result;
  result[3] = ExactNumber(a.radius) * a.radius - ExactNumber(b.radius) * b.radius;
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactNumber between = ExactNumber(b.centre[k]) - a.centre[k];
    result[k] = between + between;
    result[3] = result[3] + between * between;
  }
  return result;
}

struct Truth {
  int orientation;  // of the first three normals
  int side;         // 1: kept, 0: a tie
};

Truth truth(const std::vector<Ball>& balls, const std::vector<Wall>& walls, std::uint32_t i, const Names& names) {
  std::array<Row, 4> r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = row(balls, walls, i, names[k]);
  const ExactNumber orientation = test::exact_determinant(r[0], r[1], r[2]);
  const ExactNumber sum = orientation * r[3][3] - test::exact_determinant(r[0], r[1], r[3]) * r[2][3] +
                          test::exact_determinant(r[0], r[2], r[3]) * r[1][3] -
                          test::exact_determinant(r[1], r[2], r[3]) * r[0][3];
  return {orientation.sign(), sum.sign() * orientation.sign()};
}

/// Five balls on a small lattice, where ties are common, some of them moved a little.
std::vector<Ball> five_balls(std::mt19937& random, int size, double noise) {
  std::vector<Ball> balls(5);
  const auto number = [&](int below) { return static_cast<double>(random() % static_cast<unsigned>(below)); };
  for (auto& [c, r] : balls) {
    for (double& x : c) x = number(size) / 8 + noise * (number(9) - 4);
    r = (1 + number(2)) / 4;
  }
  return balls;
}

int orientation(const std::vector<Ball>& balls, const std::array<std::uint32_t, 4>& four) {
  std::array<std::array<ExactNumber, 3>, 3> d;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t x = 0; x < 3; ++x) {
      d[k][x] = ExactNumber(balls[four[k + 1]].centre[x]) - balls[four[0]].centre[x];
    }
  }
  return test::exact_determinant(d[0], d[1], d[2]).sign();
}

constexpr std::array<double, 4> kNoises = {0, 0, 0x1p-55, 0x1p-80};

TEST(ExactSide, AgreesWithLongIntegers) {
  std::mt19937 random(1);
  const std::vector<Wall> no_walls;
  int ties = 0, decided = 0;
  for (int n = 0; n < 2000; ++n) {
    const auto balls = five_balls(random, 2 + n % 3, kNoises[random() % 4]);
    const Names names = {1, 2, 3, 4};
    const Truth expected = truth(balls, no_walls, 0, names);
    if (expected.orientation == 0) continue;
    ExactSide exact(balls, no_walls);
    const bool kept = exact.keeps(0, 1, 2, 3, 4);
    (expected.side == 0 ? ties : decided) += 1;
    if (expected.side != 0) {
      ASSERT_EQ(kept, expected.side > 0) << n;
    }
  }
  EXPECT_GT(ties, 50);
  EXPECT_GT(decided, 500);
}

TEST(ExactSide, AgreesWithLongIntegersOnWalls) {
  std::mt19937 random(2);
  for (int n = 0; n < 1000; ++n) {
    const auto balls = five_balls(random, 4, kNoises[random() % 4]);
    std::vector<Wall> walls(6);
    for (std::size_t k = 0; k < 6; ++k) {
      walls[k].normal[k / 2] = k % 2 == 0 ? -1 : 1;
      walls[k].offset = static_cast<double>(1 + random() % 4) / 8;
    }
    Names names = {1, 2, 3, 4};
    for (std::int32_t& name : names) {
      if (random() % 2 != 0) name = -1 - static_cast<std::int32_t>(random() % 6);
    }
    const Truth expected = truth(balls, walls, 0, names);
    if (expected.orientation == 0 || expected.side == 0) continue;
    ExactSide exact(balls, walls);
    ASSERT_EQ(exact.keeps(0, names[0], names[1], names[2], names[3]), expected.side > 0) << n;
  }
}

/// If plain double is certain, so are the others, with the same result.
TEST(ExactSide, AgreesWithDouble) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> coordinate(-1, 1), radius(0, 1);
  const std::vector<Wall> no_walls;
  int sure = 0;
  for (int n = 0; n < 5000; ++n) {
    std::vector<Ball> balls(5);
    for (auto& [c, r] : balls) c = {coordinate(engine), coordinate(engine), coordinate(engine)}, r = radius(engine);
    std::array<Bisector, 4> b;
    for (std::uint32_t k = 0; k < 4; ++k) b[k] = bisector(balls, 0, k + 1);
    const auto det = [](const Point& u, const Point& v, const Point& w) {
      return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
             u[2] * (v[0] * w[1] - v[1] * w[0]);
    };
    const double own = det(b[0].normal, b[1].normal, b[2].normal);
    const double sum = own * b[3].offset - det(b[0].normal, b[1].normal, b[3].normal) * b[2].offset +
                       det(b[0].normal, b[2].normal, b[3].normal) * b[1].offset -
                       det(b[1].normal, b[2].normal, b[3].normal) * b[0].offset;
    if (std::fabs(own) < 1e-12 || std::fabs(sum) < 1e-12) continue;
    ++sure;
    ExactSide exact(balls, no_walls);
    ASSERT_EQ(exact.keeps(0, 1, 2, 3, 4), sum * own > 0) << n;
  }
  EXPECT_GT(sure, 4900);
}

/// Does ball m take the point where the cells of four others meet? All four cells agree, in any order of planes; and
/// the five decisions for five balls are those of one of the two triangulations that five points have: the sign of one
/// determinant, by the orientation of the four and the parity of the fifth.
void expect_one_triangulation(const std::vector<Ball>& balls, int n) {
  const std::vector<Wall> no_walls;
  ExactSide exact(balls, no_walls);
  int common = 0;
  for (std::uint32_t m = 0; m < 5; ++m) {
    std::array<std::uint32_t, 4> four;
    for (std::uint32_t k = 0, at = 0; k < 5; ++k) {
      if (k != m) four[at++] = k;
    }
    const int turn = orientation(balls, four);
    if (turn == 0) continue;
    const int sign = (m % 2 == 0 ? turn : -turn);
    do {
      const bool kept = exact.keeps(four[0], static_cast<std::int32_t>(four[1]), static_cast<std::int32_t>(four[2]),
                                    static_cast<std::int32_t>(four[3]), static_cast<std::int32_t>(m));
      const int found = kept ? sign : -sign;
      if (common == 0) common = found;
      ASSERT_EQ(found, common) << "set " << n << ", ball " << m;
    } while (std::next_permutation(four.begin(), four.end()));
  }
}

TEST(ExactSide, DecidesTheSameForAllCells) {
  std::mt19937 random(4);
  for (int n = 0; n < 1000; ++n) expect_one_triangulation(five_balls(random, 2 + n % 4, kNoises[random() % 4]), n);
}

TEST(ExactSide, DecidesTheSameForAllCellsOfCosphericalBalls) {
  // Corners of a cube, equal radii: all are ties.
  std::mt19937 random(5);
  std::array<std::uint32_t, 8> corners = {0, 1, 2, 3, 4, 5, 6, 7};
  for (int n = 0; n < 300; ++n) {
    std::shuffle(corners.begin(), corners.end(), random);
    std::vector<Ball> balls;
    for (std::size_t k = 0; k < 5; ++k) {
      const std::uint32_t c = corners[k];
      balls.push_back({{c & 1 ? 0.5 : 0.0, c & 2 ? 0.5 : 0.0, c & 4 ? 0.5 : 0.0}, 0.75});
    }
    expect_one_triangulation(balls, n);
  }
}

TEST(ExactSide, DecidesTheSameForAllCellsOfFourCoplanarBalls) {
  // Four corners of a square or points of a plane, and an apex.
  std::mt19937 random(6);
  for (int n = 0; n < 500; ++n) {
    std::vector<Ball> balls = five_balls(random, 3, 0);
    for (std::size_t k = 0; k < 5; ++k) balls[k].centre[2] = k == static_cast<std::size_t>(n) % 5 ? 0.5 : 0.25;
    expect_one_triangulation(balls, n);
  }
}

/// For any flat corner, its computed position is accurate to a few units in the last place: the residual in the planes'
/// equations, multiplied out exactly, is within its slack.
TEST(ExactSide, MeetsWithinItsSlack) {
  std::mt19937 random(7);
  const std::vector<Wall> no_walls;
  int flat = 0;
  for (int n = 0; n < 500; ++n) {
    const auto balls = five_balls(random, 4, kNoises[random() % 4]);
    std::array<Row, 3> r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = row(balls, no_walls, 0, static_cast<std::int32_t>(k + 1));
    const ExactNumber determinant = test::exact_determinant(r[0], r[1], r[2]);
    if (determinant.sign() == 0) continue;
    ExactSide exact(balls, no_walls);
    const auto [at, slack] = exact.meet(0, 1, 2, 3);
    const double size = std::hypot(at[0], at[1], at[2]);
    EXPECT_LE(slack, 0x1p-46 * balls[0].radius + 0x1p-48 * size);
    for (std::size_t k = 0; k < 3; ++k) {
      // Cramer: coordinate k times the determinant is the one with the offsets as column k.
      std::array<Row, 3> with_offsets = r;
      for (Row& w : with_offsets) w[k] = w[3];
      const ExactNumber rest =
          ExactNumber(at[k]) * determinant - test::exact_determinant(with_offsets[0], with_offsets[1], with_offsets[2]);
      const ExactNumber allowed = ExactNumber(slack) * determinant;
      EXPECT_LE((rest * rest - allowed * allowed).sign(), 0) << n;
    }
    flat += (determinant * determinant - ExactNumber(0x1p-60)).sign() < 0;
  }
  EXPECT_GT(flat, 20);
}

TEST(ExactSide, OfEqualBallsTheFirstKeepsAll) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 0.5}, {{0, 0, 0}, 0.5}, {{0, 0, 0}, 0.75}};
  const std::vector<Wall> no_walls;
  const ExactSide exact(balls, no_walls);
  EXPECT_TRUE(exact.keeps_concentric(0, 1));
  EXPECT_FALSE(exact.keeps_concentric(1, 0));
  EXPECT_TRUE(exact.keeps_concentric(2, 0));
  EXPECT_FALSE(exact.keeps_concentric(0, 2));
}

}  // namespace
}  // namespace medial_vk
