// Writes the page of a motion of a solid that balls follow, for the tests of the page and for a look at it.
//   make_motion_page OUTPUT.html [mesh=FILE] [around=N] [balls=N] [frames=N] [motion=twist|bend|squash|limb|ripple]
//     [rule=published|cover] [name=NAME] [up=AXIS] [rate=FRAMES_A_SECOND] [steps=N] [every=N] [raw=FILE] [gap] [open]
// The balls of the rule `cover` are those inside, enlarged until they cover. Without a mesh the solid is a torus of 2
// N^2 vertices, N = 16 by default. The motion goes out and back. `every=N`: only every Nth frame has a mesh, 0: none;
// `gap`: with bounds of the gap; `open`: without the last triangle of the mesh; `raw=FILE`: also writes, as doubles,
// the vertices and then the balls of each frame that has a mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "input/read_mesh.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/prepare.h"
#include "output/motion_page/motion_page.h"
#include "output/page/page.h"
#include "solid/solid.h"
#include "support/indexed.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Arguments = std::map<std::string, std::string>;

std::size_t number(const Arguments& given, const std::string& name, std::size_t otherwise) {
  return given.contains(name) ? std::stoul(given.at(name)) : otherwise;
}

std::string text(const Arguments& given, const std::string& name, const std::string& otherwise) {
  return given.contains(name) ? given.at(name) : otherwise;
}

/// Large balls around random points of the solid, whose centres are not in one another's inner part.
std::vector<Ball> balls_in(const IndexedMesh& mesh, std::size_t count) {
  const Solid solid = Solid::build(mesh).value();
  const MeshReport& report = mesh.prepared().report;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Ball> found;
  while (found.size() < 12 * count) {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = report.lower[k] + unit(random) * (report.upper[k] - report.lower[k]);
    if (!solid.contains(p)) continue;
    found.push_back({p, solid.distance(p) * (1 - 1e-12)});
  }
  std::ranges::sort(found, [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
  std::vector<Ball> chosen, others;
  for (const Ball& ball : found) {
    const auto holds = [&](const Ball& larger) { return length(larger.centre - ball.centre) < larger.radius / 2; };
    (std::ranges::any_of(chosen, holds) ? others : chosen).push_back(ball);
  }
  chosen.insert(chosen.end(), others.begin(), others.end());
  chosen.resize(count);
  return chosen;
}

/// Distances from the boundary to the balls differ by at most the distance of the places on it: every place is as near
/// to a vertex as the longest edge is long.
Bounds gap_of(std::span<const Point> vertices, std::span<const Triangle> triangles, std::span<const Ball> balls) {
  double lower = 0, longest = 0;
  for (const Point& vertex : vertices) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) {
      if (ball.radius > 0) nearest = std::min(nearest, length(vertex - ball.centre) - ball.radius);
    }
    lower = std::max(lower, nearest);
  }
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, length(vertices[t[k]] - vertices[t[(k + 1) % 3]]));
    }
  }
  return {lower, lower + longest};
}

PreparedMesh mesh_of(const Arguments& given) {
  const auto around = static_cast<std::uint32_t>(number(given, "around", 16));
  Mesh mesh =
      given.contains("mesh") ? read_mesh(given.at("mesh")).value() : test::make_torus(1, 0.4, around, 2 * around, 0.8);
  if (given.contains("open")) mesh.triangles.pop_back();
  return prepare_mesh(std::move(mesh)).value();
}

test::Motion motion_of(const std::string& name) {
  const auto* found =
      std::ranges::find_if(test::kMotions, [&](test::Motion motion) { return name == test::name_of(motion); });
  if (found == test::kMotions.end()) throw std::runtime_error("no motion " + name);
  return *found;
}

UpAxis axis_of(const std::string& name) {
  for (const UpAxis up : {UpAxis::kX, UpAxis::kY, UpAxis::kZ, UpAxis::kMinusX, UpAxis::kMinusY, UpAxis::kMinusZ}) {
    if (name == axis_name(up)) return up;
  }
  throw std::runtime_error("no axis " + name);
}

/// Balls that move to the vertices of a frame and describe it.
using Mover = std::function<FollowedFrame(std::span<const Point>)>;

Mover balls_inside(const IndexedMesh& mesh, const Arguments& given, bool published) {
  FollowerOptions options;
  options.rule = published ? FollowRule::kPublished : FollowRule::kTangent;
  options.steps = static_cast<std::uint32_t>(number(given, "steps", 0));
  const auto follower =
      std::make_shared<Follower>(Follower::create(mesh, balls_in(mesh, number(given, "balls", 40)), options).value());
  return [follower](std::span<const Point> vertices) {
    if (!follower->update(vertices)) throw std::runtime_error("a frame was refused");
    FollowedFrame frame;
    frame.balls.assign(follower->balls().begin(), follower->balls().end());
    frame.states.assign(follower->states().begin(), follower->states().end());
    frame.measures = follower->measure().value();
    return frame;
  };
}

/// Every third ball counts as grown in every other frame, so that there are both states. How far balls reach out is
/// bounded by the greatest radius.
Mover cover_of(const IndexedMesh& mesh, const Arguments& given) {
  const auto follower =
      std::make_shared<CoverFollower>(CoverFollower::create(mesh, balls_in(mesh, number(given, "balls", 40))).value());
  const auto count = std::make_shared<int>(0);
  return [follower, count](std::span<const Point> vertices) {
    if (!follower->update(vertices)) throw std::runtime_error("a frame was refused");
    FollowedFrame frame;
    frame.balls.assign(follower->balls().begin(), follower->balls().end());
    CoveredFrame& cover = frame.cover.emplace();
    cover.proved = follower->state();
    cover.measures = follower->measure().value();
    const bool grows = ++*count % 2 == 0;
    double greatest = 0;
    for (std::size_t i = 0; i < frame.balls.size(); ++i) {
      greatest = std::max(greatest, frame.balls[i].radius);
      cover.states.push_back(frame.balls[i].radius == 0 ? CoverBallState::kUnused
                             : grows && i % 3 == 0      ? CoverBallState::kGrown
                                                        : CoverBallState::kSteady);
    }
    cover.reach_out_bound = greatest;
    return frame;
  };
}

MotionRecord follow(const IndexedMesh& mesh, const Arguments& given) {
  const std::string rule = text(given, "rule", "tangent");
  MotionRecord record;
  record.covers = rule == "cover";
  const Mover move = record.covers ? cover_of(mesh, given) : balls_inside(mesh, given, rule == "published");

  const MeshView view = mesh.view();
  record.version = "of the tests";
  record.name = text(given, "name", "torus");
  record.rule = rule;
  record.frames_per_second = static_cast<double>(number(given, "rate", 24));
  record.has_volume = view.closed;
  record.triangles.assign(view.triangles.begin(), view.triangles.end());
  const std::vector<Point> rest(view.vertices.begin(), view.vertices.end());
  const test::Motion motion = motion_of(text(given, "motion", "bend"));
  const std::size_t frames = number(given, "frames", 24), every = number(given, "every", 1);
  for (std::size_t i = 0; i < frames; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(frames);
    const std::vector<Point> vertices = test::moved_vertices(rest, motion, 0.5 - 0.5 * std::cos(turn));
    FollowedFrame frame = move(vertices);
    frame.name = frame.short_name = i == 0 ? "rest" : "frame " + std::to_string(i);
    frame.time = static_cast<double>(i) / std::max(record.frames_per_second, 1.0);
    if (given.contains("gap")) frame.gap = gap_of(vertices, view.triangles, frame.balls);
    if (every > 0 && i % every == 0) {
      for (const Point& p : vertices) {
        frame.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
      }
    }
    record.frames.push_back(std::move(frame));
  }
  return record;
}

void write_raw(const std::string& path, const MotionRecord& record) {
  std::vector<double> numbers;
  for (const FollowedFrame& frame : record.frames) {
    if (frame.vertices.empty()) continue;
    for (const std::array<float, 3>& vertex : frame.vertices)
      numbers.insert(numbers.end(), vertex.begin(), vertex.end());
    for (const Ball& ball : frame.balls) {
      numbers.insert(numbers.end(), ball.centre.begin(), ball.centre.end());
      numbers.push_back(ball.radius);
    }
  }
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

int run(const std::string& output, const Arguments& given) {
  if (const Status available = check_page_available(); !available) {
    std::fprintf(stderr, "%s\n", available.error().message.c_str());
    return 2;
  }
  const IndexedMesh mesh = test::indexed(mesh_of(given));
  const MotionRecord record = follow(mesh, given);
  std::ofstream(output, std::ios::binary) << encode_motion_page(record, axis_of(text(given, "up", "y")));
  if (given.contains("raw")) write_raw(given.at("raw"), record);
  return 0;
}

}  // namespace
}  // namespace medial_vk

int main(int argc, char** argv) {
  medial_vk::Arguments given;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    given[word.substr(0, equals)] = equals == std::string::npos ? "" : word.substr(equals + 1);
  }
  return argc < 2 ? 2 : medial_vk::run(argv[1], given);
}
