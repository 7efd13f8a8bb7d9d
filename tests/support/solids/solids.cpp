#include "support/solids/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace medial_vk::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::uint32_t add_vertex(Mesh& mesh, const Point& p) {
  mesh.vertices.push_back(p);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// Two equal rings of vertices, one above the other: the walls between them. `first` is the lower ring, the upper one
/// follows it directly; the ring is counter-clockwise seen from above for an outer wall, clockwise for a hole's.
void add_walls(Mesh& mesh, std::uint32_t first, std::uint32_t count, std::uint32_t lift) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = first + i;
    const std::uint32_t b = first + (i + 1) % count;
    add_quad(mesh, a, b, b + lift, a + lift);
  }
}

/// A profile in the half plane (distance from the z axis, z), turned about the z axis. It starts and ends on the axis
/// and runs so that the solid lies to its left: from the lowest point outwards and up. One vertex on each axis end.
Mesh revolve(const std::vector<std::array<double, 2>>& profile, std::uint32_t segments) {
  Mesh mesh;
  const auto last = static_cast<std::uint32_t>(profile.size() - 1);
  const std::uint32_t start = add_vertex(mesh, {0, 0, profile.front()[1]});
  for (std::uint32_t row = 1; row < last; ++row) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double phi = 2 * kPi * i / segments;
      add_vertex(mesh, {profile[row][0] * std::cos(phi), profile[row][0] * std::sin(phi), profile[row][1]});
    }
  }
  const std::uint32_t end = add_vertex(mesh, {0, 0, profile.back()[1]});
  const auto at = [&](std::uint32_t row, std::uint32_t i) { return 1 + (row - 1) * segments + i % segments; };
  for (std::uint32_t i = 0; i < segments; ++i) {
    mesh.triangles.push_back({start, at(1, i + 1), at(1, i)});
    for (std::uint32_t row = 1; row + 1 < last; ++row) {
      add_quad(mesh, at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row + 1, i));
    }
    mesh.triangles.push_back({end, at(last - 1, i), at(last - 1, i + 1)});
  }
  return mesh;
}

/// The geodesic sphere of radius 1: every face of an icosahedron cut into frequency^2 triangles and projected onto the
/// sphere. Vertices on shared edges are created once, so that the surface is watertight.
Mesh make_geodesic(std::uint32_t frequency) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Point, 12> corners = {{{-1, g, 0},
                                          {1, g, 0},
                                          {-1, -g, 0},
                                          {1, -g, 0},
                                          {0, -1, g},
                                          {0, 1, g},
                                          {0, -1, -g},
                                          {0, 1, -g},
                                          {g, 0, -1},
                                          {g, 0, 1},
                                          {-g, 0, -1},
                                          {-g, 0, 1}}};
  const std::array<Triangle, 20> faces = {{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                           {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                           {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                           {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
  Mesh mesh;
  const auto add_on_sphere = [&](const Point& p) {
    const double length = std::hypot(p[0], p[1], p[2]);
    return add_vertex(mesh, {p[0] / length, p[1] / length, p[2] / length});
  };
  for (const Point& corner : corners) add_on_sphere(corner);

  // The frequency - 1 vertices inside edge {a, b}, a < b, from a to b; -1 until they are created.
  std::array<std::array<std::int64_t, 12>, 12> edge_start;
  for (auto& row : edge_start) row.fill(-1);
  const auto on_edge = [&](std::uint32_t a, std::uint32_t b, std::uint32_t step) {  // step / frequency from a to b
    if (step == 0) return a;
    if (step == frequency) return b;
    if (a > b) {
      std::swap(a, b);
      step = frequency - step;
    }
    if (edge_start[a][b] < 0) {
      edge_start[a][b] = static_cast<std::int64_t>(mesh.vertices.size());
      for (std::uint32_t s = 1; s < frequency; ++s) {
        Point p;
        for (int k = 0; k < 3; ++k) p[k] = corners[a][k] * (frequency - s) + corners[b][k] * s;
        add_on_sphere(p);
      }
    }
    return static_cast<std::uint32_t>(edge_start[a][b]) + step - 1;
  };
  for (const Triangle& face : faces) {
    // Row r has r + 1 vertices; row 0 is corner 0, row `frequency` runs from corner 1 to corner 2.
    std::vector<std::uint32_t> above, row;
    for (std::uint32_t r = 0; r <= frequency; ++r) {
      row.clear();
      for (std::uint32_t i = 0; i <= r; ++i) {
        if (i == 0) {
          row.push_back(on_edge(face[0], face[1], r));
        } else if (i == r) {
          row.push_back(on_edge(face[0], face[2], r));
        } else if (r == frequency) {
          row.push_back(on_edge(face[1], face[2], i));
        } else {
          Point p;
          for (int k = 0; k < 3; ++k) {
            p[k] = corners[face[0]][k] * (frequency - r) + corners[face[1]][k] * (r - i) + corners[face[2]][k] * i;
          }
          row.push_back(add_on_sphere(p));
        }
      }
      for (std::uint32_t i = 0; i < r; ++i) {
        mesh.triangles.push_back({above[i], row[i], row[i + 1]});
        if (i + 1 < r) mesh.triangles.push_back({above[i], row[i + 1], above[i + 1]});
      }
      above = row;
    }
  }
  return mesh;
}

}  // namespace

Mesh make_box(Point size) {
  Mesh mesh;
  for (const double z : {0.0, size[2]}) {
    for (const auto& [x, y] : {std::array{0.0, 0.0}, {size[0], 0.0}, {size[0], size[1]}, {0.0, size[1]}}) {
      add_vertex(mesh, {x, y, z});
    }
  }
  add_quad(mesh, 0, 3, 2, 1);
  add_quad(mesh, 4, 5, 6, 7);
  add_walls(mesh, 0, 4, 4);
  return mesh;
}

Mesh make_sphere(double radius, std::uint32_t triangles) {
  std::uint32_t frequency = 1;
  while (20ull * frequency * frequency < triangles) ++frequency;
  Mesh mesh = make_geodesic(frequency);
  scale(mesh, radius);
  return mesh;
}

Mesh make_capsule(double radius, double length, std::uint32_t segments) {
  segments = std::max(segments, 3u);
  const std::uint32_t rows = std::max(segments / 4, 1u);  // of each cap: steps as long as those around it
  const double side = 2 * kPi * radius / segments;
  const auto belts = static_cast<std::uint32_t>(std::max(1.0, std::round(length / side)));
  std::vector<std::array<double, 2>> profile;
  const auto add_cap_row = [&](double angle, double z) {
    profile.push_back({radius * std::cos(angle), z + radius * std::sin(angle)});
  };
  for (std::uint32_t i = 0; i <= rows; ++i) add_cap_row(kPi / 2 * (double(i) / rows - 1), -length / 2);
  if (length > 0) {
    for (std::uint32_t i = 1; i < belts; ++i) profile.push_back({radius, length * (double(i) / belts - 0.5)});
    add_cap_row(0, length / 2);
  }
  for (std::uint32_t i = 1; i <= rows; ++i) add_cap_row(kPi / 2 * i / rows, length / 2);
  return revolve(profile, segments);
}

Mesh make_ellipsoid(Point semi_axes, std::uint32_t segments) {
  // A geodesic sphere of frequency f has about 5 f edges around its equator.
  Mesh mesh = make_geodesic(std::max((segments + 4) / 5, 1u));
  for (Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) p[k] *= semi_axes[k];
  }
  return mesh;
}

Mesh make_l_shape(double arm, double thickness, double height) {
  Mesh mesh;
  for (const double z : {0.0, height}) {
    for (const auto& [x, y] :
         {std::array{0.0, 0.0}, {arm, 0.0}, {arm, thickness}, {thickness, thickness}, {thickness, arm}, {0.0, arm}}) {
      add_vertex(mesh, {x, y, z});
    }
  }
  add_quad(mesh, 0, 3, 2, 1);
  add_quad(mesh, 0, 5, 4, 3);
  add_quad(mesh, 6, 7, 8, 9);
  add_quad(mesh, 6, 9, 10, 11);
  add_walls(mesh, 0, 6, 6);
  return mesh;
}

Mesh make_cup(double radius, double wall, double height, std::uint32_t segments) {
  const double inner = radius - wall;
  return revolve({{0, 0}, {radius, 0}, {radius, height}, {inner, height}, {inner, wall}, {0, wall}},
                 std::max(segments, 3u));
}

Mesh make_torus(double major, double minor, std::uint32_t around, std::uint32_t along, double flatten) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < along; ++i) {
    const double u = 2 * kPi * i / along;
    for (std::uint32_t j = 0; j < around; ++j) {
      const double v = 2 * kPi * j / around;
      const double rho = major + minor * std::cos(v);
      add_vertex(mesh, {rho * std::cos(u), rho * std::sin(u), flatten * minor * std::sin(v)});
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % along * around + j % around; };
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  }
  return mesh;
}

Mesh make_plate_with_hole(double side, double thickness, double hole) {
  Mesh mesh;
  const double low = (side - hole) / 2;
  const double high = (side + hole) / 2;
  for (const double z : {0.0, thickness}) {
    for (const auto& [x, y] : {std::array{0.0, 0.0},
                               {side, 0.0},
                               {side, side},
                               {0.0, side},  // counter-clockwise
                               {low, low},
                               {low, high},
                               {high, high},
                               {high, low}}) {  // clockwise
      add_vertex(mesh, {x, y, z});
    }
  }
  constexpr std::array<std::uint32_t, 4> kHoleCorner = {4, 7, 6, 5};  // of the hole, nearest to outer corner i
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    add_quad(mesh, i, kHoleCorner[i], kHoleCorner[next], next);
    add_quad(mesh, i + 8, next + 8, kHoleCorner[next] + 8, kHoleCorner[i] + 8);
  }
  add_walls(mesh, 0, 4, 8);
  add_walls(mesh, 4, 4, 8);
  return mesh;
}

// A chequerboard of 5 x 3 squares without the two that are holes.
Mesh make_plate_with_two_holes(double a, double thickness) {
  Mesh mesh;
  const auto is_solid = [](int x, int y) {
    return x >= 0 && x < 5 && y >= 0 && y < 3 && !(y == 1 && (x == 1 || x == 3));
  };
  const auto corner = [](int x, int y, int top) { return static_cast<std::uint32_t>((top * 4 + y) * 6 + x); };
  for (int i = 0; i < 48; ++i) add_vertex(mesh, {a * (i % 6), a * (i / 6 % 4), thickness * (i / 24)});
  // Counter-clockwise around the square: the corner where each of its sides begins, and the square beyond it.
  constexpr std::array<std::array<int, 4>, 4> kSides = {{{0, 0, 0, -1}, {1, 0, 1, 0}, {1, 1, 0, 1}, {0, 1, -1, 0}}};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      if (!is_solid(x, y)) continue;
      add_quad(mesh, corner(x, y, 0), corner(x, y + 1, 0), corner(x + 1, y + 1, 0), corner(x + 1, y, 0));
      add_quad(mesh, corner(x, y, 1), corner(x + 1, y, 1), corner(x + 1, y + 1, 1), corner(x, y + 1, 1));
      for (std::size_t side = 0; side < 4; ++side) {
        const auto& [u, v, beyond_x, beyond_y] = kSides[side];
        const auto& end = kSides[(side + 1) % 4];
        if (is_solid(x + beyond_x, y + beyond_y)) continue;
        add_quad(mesh, corner(x + u, y + v, 0), corner(x + end[0], y + end[1], 0), corner(x + end[0], y + end[1], 1),
                 corner(x + u, y + v, 1));
      }
    }
  }
  return mesh;
}

void rotate(Mesh& mesh, Point axis, double angle) {
  // Rodrigues' formula.
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  for (double& x : axis) x /= length;
  const double c = std::cos(angle), s = std::sin(angle);
  for (Point& p : mesh.vertices) {
    const double along = axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
    const Point cross = {axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2],
                         axis[0] * p[1] - axis[1] * p[0]};
    for (int k = 0; k < 3; ++k) p[k] = c * p[k] + s * cross[k] + (1 - c) * along * axis[k];
  }
}

Mesh make_tetrahedron(const std::array<Point, 4>& corners) {
  Mesh mesh;
  mesh.vertices.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

Mesh make_sliver() { return make_tetrahedron({{{0, 0, 0}, {2, 0, 1e-7}, {1, 1e-6, 0}, {1, 1e-3, 1e-3}}}); }

Mesh make_shell(std::uint32_t triangles, std::uint32_t of_cavity) {
  Mesh mesh = make_sphere(1, triangles), cavity = make_sphere(0.7, of_cavity);
  turn_over(cavity);
  append(mesh, cavity);
  return mesh;
}

Mesh make_two_parts(std::uint32_t triangles) {
  Mesh mesh = make_sphere(0.3, triangles);
  append(mesh, moved(make_box({0.4, 0.5, 0.6}), {0.8, 0.1, 0}));
  return mesh;
}

Mesh make_turned_torus(std::uint32_t around, std::uint32_t along) {
  Mesh mesh = make_torus(1.0, 0.4, around, along);
  rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

MeshView view_of(const Mesh& mesh, bool closed) { return {mesh.vertices, mesh.triangles, {}, closed}; }

Mesh bent(Mesh mesh) {
  for (Point& p : mesh.vertices) {
    const double bend = 0.4 * p[0];
    p = {7 + 1.7 * p[0], p[1] * std::cos(bend) - p[2] * std::sin(bend), p[1] * std::sin(bend) + p[2] * std::cos(bend)};
  }
  return mesh;
}

void translate(Mesh& mesh, Point offset) {
  for (Point& p : mesh.vertices) {
    for (int k = 0; k < 3; ++k) p[k] += offset[k];
  }
}

Mesh moved(Mesh mesh, const Point& offset) {
  translate(mesh, offset);
  return mesh;
}

void scale(Mesh& mesh, double factor) {
  for (Point& p : mesh.vertices) {
    for (double& x : p) x *= factor;
  }
}

void append(Mesh& mesh, const Mesh& other) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

void turn_over(Mesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

double signed_volume(const Mesh& mesh) {
  double six_volumes = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    six_volumes +=
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six_volumes / 6;
}

}  // namespace medial_vk::test
