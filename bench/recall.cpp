// How much of the medial surface an extraction finds: independent salient medial points, and the share of them whose
// voxel got a point.
//
// The sampler shares nothing with the extraction. A random point p of the solid has a nearest boundary point A; the
// ball through A with its centre on the ray from A through p grows until it meets the boundary elsewhere, found by
// bisection in double precision. Its centre is a medial point (Lemma 2.3), and the object angle follows from the two
// contacts. It counts if its angle is at least 0.05 above the threshold and it is at least 5 % of a voxel away from the
// faces of its voxel.
#include <fmt/core.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "cpu_reference/queries.h"
#include "medial/extract.h"
#include "mesh/load_mesh.h"

namespace {

using namespace medial_vk;
using Eigen::Vector3d;

struct Sample {
  Vector3d centre;
  double radius, angle;
};

// The medial point that p retracts to along the ray away from its nearest boundary point.
std::optional<Sample> retract(const reference::Tree& tree, const Vector3d& p, double longest) {
  const reference::Closest nearest = tree.closest(p);
  if (nearest.distance < 1e-9 * longest || !reference::is_inside(tree, p)) return std::nullopt;
  const Vector3d away = (p - nearest.point) / nearest.distance;
  const auto meets = [&](double t) {
    const Vector3d m = nearest.point + t * away;
    return tree.closest(m).distance < t - 1e-12 * longest;
  };
  double low = nearest.distance, high = 2 * low;
  while (!meets(high)) {
    low = high;
    high *= 2;
    if (high > 4 * longest) return std::nullopt;
  }
  while (high - low > 1e-11 * longest) (meets(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  const Vector3d m = nearest.point + low * away;
  // The other contact is the nearest point a little beyond.
  const Vector3d beyond = nearest.point + (high + 1e-7 * longest) * away;
  const reference::Closest other = tree.closest(beyond);
  const double angle = reference::half_angle(-away, (other.point - beyond).normalized());
  return Sample{m, low, angle};
}

std::vector<Sample> salient_samples(const reference::Tree& tree, double angle, std::size_t wanted, unsigned seed) {
  const double longest = tree.longest_side();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Sample> samples;
  for (std::size_t tries = 0; samples.size() < wanted && tries < 200 * wanted; ++tries) {
    const Vector3d share(unit(random), unit(random), unit(random));
    const Vector3d p = tree.lower() + share.cwiseProduct(tree.upper() - tree.lower());
    const std::optional<Sample> sample = retract(tree, p, longest);
    if (sample && sample->angle >= angle + 0.05) samples.push_back(*sample);
  }
  return samples;
}

reference::Mesh to_reference(const Mesh& mesh) {
  reference::Mesh result;
  for (const Point& v : mesh.vertices) result.vertices.emplace_back(v[0], v[1], v[2]);
  for (const Triangle& t : mesh.triangles)
    result.triangles.emplace_back(static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]));
  return result;
}

struct Count {
  std::size_t counted = 0, missed = 0;
};

struct Recall {
  Count wide, narrow;  // radius at least, or below, (1 + sqrt(3)/2) voxels
  std::vector<Sample> misses;
};

Recall measure(const std::vector<Sample>& samples, const Extraction& extraction) {
  std::set<std::array<std::uint32_t, 3>> found;
  for (const MedialSphere& s : extraction.spheres) found.insert(s.voxel);
  Recall recall;
  for (const Sample& s : samples) {
    std::array<std::uint32_t, 3> voxel{};
    bool clear = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = (s.centre[axis] - extraction.grid.origin[axis]) / extraction.grid.voxel_size;
      voxel[axis] = static_cast<std::uint32_t>(std::floor(x));
      clear = clear && x - std::floor(x) >= 0.05 && x - std::floor(x) <= 0.95;
    }
    if (!clear) continue;
    Count& count = s.radius >= (1 + std::sqrt(0.75)) * extraction.grid.voxel_size ? recall.wide : recall.narrow;
    ++count.counted;
    if (found.contains(voxel)) continue;
    ++count.missed;
    recall.misses.push_back(s);
  }
  return recall;
}

int fail(const std::string& message) {
  fmt::print(stderr, "recall: {}\n", message);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return fail("usage: bench_recall MESH RESOLUTION OBJECT_ANGLE SAMPLES [thesis|certified] [cpu|vulkan]");
  auto raw = read_mesh(argv[1]);
  if (!raw.ok()) return fail(raw.error().message);
  auto mesh = prepare_mesh(std::move(raw).value());
  if (!mesh.ok()) return fail(mesh.error().message);
  ExtractionParameters parameters;
  parameters.resolution = static_cast<std::uint32_t>(std::atoi(argv[2]));
  parameters.object_angle = std::atof(argv[3]);
  parameters.mode = argc > 5 && std::string(argv[5]) == "thesis" ? Mode::kThesis : Mode::kCertified;
  const bool cpu = argc > 6 && std::string(argv[6]) == "cpu";
  std::optional<Context> context;
  if (!cpu) {
    auto made = Context::create();
    if (!made.ok()) return fail(made.error().message);
    context = std::move(made).value();
  }
  auto result = extract_and_certify(mesh.value(), parameters, cpu ? Backend::kCpu : Backend::kVulkan,
                                    context ? &*context : nullptr);
  if (!result.ok()) return fail(result.error().message);
  const reference::Tree tree(to_reference(mesh.value().mesh));
  const auto wanted = static_cast<std::size_t>(std::atoll(argv[4]));
  std::vector<std::vector<Sample>> parts(2);
  std::vector<std::thread> threads;
  for (unsigned k = 0; k < 2; ++k)
    threads.emplace_back([&, k] { parts[k] = salient_samples(tree, parameters.object_angle, wanted / 2, k + 1); });
  for (std::thread& t : threads) t.join();
  parts[0].insert(parts[0].end(), parts[1].begin(), parts[1].end());
  const Recall recall = measure(parts[0], result.value().extraction);
  const ExtractionCounters& c = result.value().extraction.counters;
  fmt::print("{} resolution {} angle {} points {} undecided {} rejected {} | wide {} missed {} | narrow {} missed {}\n",
             argv[1], parameters.resolution, parameters.object_angle, c.found, c.undecided,
             result.value().certify.rejected, recall.wide.counted, recall.wide.missed, recall.narrow.counted,
             recall.narrow.missed);
  for (std::size_t i = 0; i < std::min<std::size_t>(recall.misses.size(), 5); ++i) {
    const Sample& s = recall.misses[i];
    fmt::print("  missed ({:.6f}, {:.6f}, {:.6f}) radius {:.6f} angle {:.3f}\n", s.centre.x(), s.centre.y(),
               s.centre.z(), s.radius, s.angle);
  }
  return 0;
}
