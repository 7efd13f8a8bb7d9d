// Makes a closed mesh for experiments with medial-vk: a turtle, as a Wavefront OBJ.
//   make_model FILE.obj [CELLS]
// The solid is a smooth union of ellipsoids, given by an implicit function; naive surface nets (Gibson 1998) turn its
// zero set on a grid of CELLS cells along the longest side into quadrilaterals, and Newton steps move the vertices onto
// it. Flat parts (shell, flippers) have broad medial sheets, round ones (head, tail) thin ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using Vector = std::array<double, 3>;

Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// An ellipsoid: semi-axes `size`, turned by `yaw` about the z axis.
struct Part {
  Vector centre;
  Vector size;
  double yaw;
};

// x forward, z up. A part with y != 0 stands for two, left and right.
constexpr std::array<Part, 6> kParts = {{
    {{0.00, 0.00, 0.00}, {0.62, 0.48, 0.22}, 0.0},     // shell
    {{0.78, 0.00, 0.03}, {0.19, 0.14, 0.13}, 0.0},     // head
    {{0.58, 0.00, 0.00}, {0.20, 0.10, 0.09}, 0.0},     // neck
    {{0.38, 0.62, -0.06}, {0.44, 0.15, 0.05}, 1.8},    // front flipper
    {{-0.60, 0.42, -0.06}, {0.27, 0.12, 0.05}, 2.45},  // hind flipper
    {{-0.68, 0.00, -0.02}, {0.16, 0.06, 0.05}, 0.0},   // tail
}};
constexpr Vector kLower = {-1.0, -1.1, -0.4};
constexpr Vector kUpper = {1.1, 1.1, 0.4};

/// The approximate signed distance to a part, negative inside.
double part_value(const Part& part, const Vector& p) {
  const Vector d = p - part.centre;
  const double c = std::cos(part.yaw), s = std::sin(part.yaw);
  const Vector local = {c * d[0] + s * d[1], -s * d[0] + c * d[1], d[2]};
  const Vector unit = {local[0] / part.size[0], local[1] / part.size[1], local[2] / part.size[2]};
  const Vector slope = {unit[0] / part.size[0], unit[1] / part.size[1], unit[2] / part.size[2]};
  const double k = std::sqrt(dot(unit, unit)), g = std::sqrt(dot(slope, slope));
  return g > 0 ? k * (k - 1) / g : -*std::min_element(part.size.begin(), part.size.end());
}

/// The smaller of a and b, rounded off where they differ by less than `width`.
double smooth_minimum(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4;
}

double value(Vector p) {
  p[1] = std::abs(p[1]);  // mirror symmetry; smooth, since the parts that cross the plane are symmetric
  double result = part_value(kParts[0], p);
  for (std::size_t i = 1; i < kParts.size(); ++i) result = smooth_minimum(result, part_value(kParts[i], p), 0.08);
  return result;
}

Vector gradient(const Vector& p) {
  constexpr double kStep = 1e-5;
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    Vector step = {0, 0, 0};
    step[i] = kStep;
    result[i] = (value(p + step) - value(p - step)) / (2 * kStep);
  }
  return result;
}

struct Mesh {
  std::vector<Vector> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Naive surface nets: one vertex in every cell with corners on both sides, a quadrilateral for every crossed edge.
class SurfaceNets {
 public:
  explicit SurfaceNets(int cells) {
    const Vector extent = kUpper - kLower;
    side_ = *std::max_element(extent.begin(), extent.end()) / cells;
    // One more cell on every side keeps the surface clear of the border. The half keeps the plane y = 0 between two
    // rows of grid points.
    for (std::size_t i = 0; i < 3; ++i) size_[i] = static_cast<int>(std::ceil(extent[i] / side_)) + 2;
    size_[1] += size_[1] % 2 == 0 ? 1 : 0;
    origin_ = 0.5 * (kLower + kUpper) - 0.5 * side_ * Vector{1.0 * size_[0], 1.0 * size_[1], 1.0 * size_[2]};
    values_.reserve(static_cast<std::size_t>(size_[0] + 1) * (size_[1] + 1) * (size_[2] + 1));
    for (int z = 0; z <= size_[2]; ++z)
      for (int y = 0; y <= size_[1]; ++y)
        for (int x = 0; x <= size_[0]; ++x) values_.push_back(value(position(x, y, z)));
  }

  Mesh polygonise() {
    for (int z = 1; z < size_[2]; ++z)
      for (int y = 1; y < size_[1]; ++y)
        for (int x = 1; x < size_[0]; ++x) {
          add_quad({x, y, z}, 0);
          add_quad({x, y, z}, 1);
          add_quad({x, y, z}, 2);
        }
    return std::move(mesh_);
  }

 private:
  using Cell = std::array<int, 3>;

  Vector position(int x, int y, int z) const { return origin_ + side_ * Vector{1.0 * x, 1.0 * y, 1.0 * z}; }
  std::size_t index(const Cell& c) const {
    return (static_cast<std::size_t>(c[2]) * (size_[1] + 1) + c[1]) * (size_[0] + 1) + c[0];
  }

  /// Adds the four cells around the edge from grid point `from` along `axis`, if the surface crosses it.
  void add_quad(const Cell& from, std::size_t axis) {
    Cell to = from;
    ++to[axis];
    const bool from_inside = values_[index(from)] < 0;
    if (from_inside == (values_[index(to)] < 0)) return;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<std::uint32_t, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) {  // counter-clockwise seen from the tip of the axis
      Cell cell = from;
      cell[u] -= i == 0 || i == 3 ? 1 : 0;
      cell[v] -= i < 2 ? 1 : 0;
      corner[i] = vertex(cell);
    }
    if (!from_inside) std::swap(corner[1], corner[3]);
    // The quadrilateral is cut along the shorter diagonal.
    const auto& p = mesh_.vertices;
    const Vector a = p[corner[2]] - p[corner[0]], b = p[corner[3]] - p[corner[1]];
    const std::size_t first = dot(a, a) <= dot(b, b) ? 0 : 1;
    mesh_.triangles.push_back({corner[first], corner[first + 1], corner[first + 2]});
    mesh_.triangles.push_back({corner[first], corner[first + 2], corner[(first + 3) % 4]});
  }

  /// The vertex of a cell: the mean of the crossings on its edges, moved onto the surface.
  std::uint32_t vertex(const Cell& cell) {
    const auto [entry, is_new] = vertex_of_cell_.try_emplace(cell, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (!is_new) return entry->second;
    Vector sum = {0, 0, 0};
    int crossings = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 4; ++i) {
        Cell a = cell;
        a[(axis + 1) % 3] += i % 2;
        a[(axis + 2) % 3] += i / 2;
        Cell b = a;
        ++b[axis];
        const double va = values_[index(a)], vb = values_[index(b)];
        if ((va < 0) == (vb < 0)) continue;
        const Vector pa = position(a[0], a[1], a[2]), pb = position(b[0], b[1], b[2]);
        sum = sum + pa + (va / (va - vb)) * (pb - pa);
        ++crossings;
      }
    Vector p = (1.0 / crossings) * sum;
    for (int i = 0; i < 4; ++i) {
      const Vector g = gradient(p);
      p = p - (value(p) / std::max(dot(g, g), 0.1)) * g;
    }
    mesh_.vertices.push_back(p);
    return entry->second;
  }

  double side_ = 0;
  std::array<int, 3> size_ = {};
  Vector origin_ = {};
  std::vector<double> values_;
  std::map<Cell, std::uint32_t> vertex_of_cell_;
  Mesh mesh_;
};

/// True if every edge is traversed exactly once in each direction.
bool is_closed_manifold(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
    const auto opposite = uses.find({use.first.second, use.first.first});
    return use.second == 1 && opposite != uses.end() && opposite->second == 1;
  });
}

bool write_obj(const Mesh& mesh, const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) return false;
  for (const Vector& p : mesh.vertices) std::fprintf(file, "v %.7f %.7f %.7f\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles) std::fprintf(file, "f %u %u %u\n", t[0] + 1, t[1] + 1, t[2] + 1);
  const bool written = std::ferror(file) == 0;
  return std::fclose(file) == 0 && written;
}

}  // namespace

int main(int argc, char** argv) {
  const int cells = argc > 2 ? std::atoi(argv[2]) : 72;
  if (argc < 2 || argc > 3 || argv[1][0] == '-' || cells < 52 || cells > 1024) {
    std::fprintf(stderr, "usage: make_model FILE.obj [CELLS]   (CELLS 52 to 1024, default 72)\n");
    return 2;
  }
  const Mesh mesh = SurfaceNets(cells).polygonise();
  if (!is_closed_manifold(mesh)) {
    std::fprintf(stderr, "make_model: the surface is not closed at this resolution\n");
    return 1;
  }
  if (!write_obj(mesh, argv[1])) {
    std::fprintf(stderr, "make_model: cannot write %s\n", argv[1]);
    return 6;
  }
  std::printf("%s: a turtle of %zu triangles\n", argv[1], mesh.triangles.size());
  return 0;
}
