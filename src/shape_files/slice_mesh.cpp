#include "shape_files/slice_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/host_memory.h"
#include "base/quoted.h"
#include "input/text_scanner.h"
#include "shape_files/areas/shape_area.h"

namespace medial_vk {
namespace {

using Corners = std::array<std::uint32_t, 2>;

Error slice_error(std::string what) { return {ErrorCode::kInvalidMesh, std::move(what)}; }

/// A segment of the slice: the edges of a triangle where it begins and ends.
struct SliceStep {
  Corners from, to;
};

class MeshSlicer {
 public:
  MeshSlicer(const Mesh& mesh, std::uint32_t axis, double height)
      : mesh_(mesh), axis_(axis), across_{(axis + 1) % 3, (axis + 2) % 3}, height_(height) {}

  MeshSlice slice() {
    collect_steps();
    unite_equal_corners();
    number_edges();
    MeshSlice slice;
    slice.height = height_;
    trace_open_lines(slice);
    trace_rings(slice);
    return slice;
  }

 private:
  double along(std::uint32_t v) const { return mesh_.vertices[v][axis_]; }
  bool is_above(std::uint32_t v) const { return along(v) >= height_; }

  /// The solid is on the left of a step, seen from the positive end of the axis, if it begins where a side of the
  /// triangle, counter-clockwise from outside, goes down through the plane, and ends where one goes up.
  void collect_steps() {
    for (const Triangle& t : mesh_.triangles) {
      SliceStep step = {};
      bool down = false, up = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (is_above(a) == is_above(b)) continue;
        (is_above(a) ? step.from : step.to) = {a, b};
        (is_above(a) ? down : up) = true;
      }
      if (down && up) steps_.push_back(step);
    }
  }

  /// Corners at the same place get the least of their numbers, and the lower end of an edge comes first.
  void unite_equal_corners() {
    std::vector<std::uint32_t> used;
    used.reserve(4 * steps_.size());
    for (const SliceStep& step : steps_) used.insert(used.end(), {step.from[0], step.from[1], step.to[0], step.to[1]});
    const auto precedes = [&](std::uint32_t a, std::uint32_t b) {
      const Point &p = mesh_.vertices[a], &q = mesh_.vertices[b];
      return p != q ? p < q : a < b;
    };
    std::ranges::sort(used, precedes);
    std::vector<std::uint32_t> first(mesh_.vertices.size(), 0);
    for (std::size_t i = 0; i < used.size(); ++i) {
      const bool same = i > 0 && mesh_.vertices[used[i]] == mesh_.vertices[used[i - 1]];
      first[used[i]] = same ? first[used[i - 1]] : used[i];
    }
    for (SliceStep& step : steps_) {
      for (Corners* edge : {&step.from, &step.to}) {
        for (std::uint32_t& v : *edge) v = first[v];
        if (is_above((*edge)[0])) std::swap((*edge)[0], (*edge)[1]);
      }
    }
  }

  void number_edges() {
    edges_.reserve(2 * steps_.size());
    for (const SliceStep& step : steps_) edges_.insert(edges_.end(), {step.from, step.to});
    std::ranges::sort(edges_);
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    const auto number = [&](const Corners& edge) {
      return static_cast<std::size_t>(std::ranges::lower_bound(edges_, edge) - edges_.begin());
    };
    begin_.assign(edges_.size() + 1, 0);
    incoming_.assign(edges_.size(), 0);
    for (const SliceStep& step : steps_) ++begin_[number(step.from) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    next_.assign(begin_.begin(), begin_.end() - 1);
    targets_.resize(steps_.size());
    for (const SliceStep& step : steps_) {
      const std::size_t to = number(step.to);
      targets_[next_[number(step.from)]++] = to;
      ++incoming_[to];
    }
    next_.assign(begin_.begin(), begin_.end() - 1);
  }

  std::size_t left_at(std::size_t edge) const { return begin_[edge + 1] - next_[edge]; }

  /// Where the edge meets the plane. Between the ends, whatever the rounding; equal for all triangles of the edge.
  PlanePoint crossing(std::size_t edge) const {
    const auto& [below, above] = edges_[edge];
    const Point &a = mesh_.vertices[below], &b = mesh_.vertices[above];
    const double from = a[axis_], to = b[axis_];
    // Halves, since the difference of coordinates may exceed the range.
    const double t = to == height_ ? 1 : (height_ / 2 - from / 2) / (to / 2 - from / 2);
    PlanePoint p;
    for (std::size_t k = 0; k < 2; ++k) {
      const double s = a[across_[k]], e = b[across_[k]];
      p[k] = t == 1 ? e : std::clamp(s + t * (e - s), std::min(s, e), std::max(s, e));
    }
    return p;
  }

  /// From an edge on, while steps lead further.
  PlaneRing trace(std::size_t edge) {
    PlaneRing line = {crossing(edge)};
    while (left_at(edge) > 0) {
      edge = targets_[next_[edge]++];
      const PlanePoint p = crossing(edge);
      if (p != line.back()) line.push_back(p);
    }
    return line;
  }

  /// Lines that begin where more steps begin than end: at the open edges of the mesh.
  void trace_open_lines(MeshSlice& slice) {
    for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
      const std::size_t outgoing = begin_[edge + 1] - begin_[edge];
      for (std::size_t i = incoming_[edge]; i < outgoing; ++i) {
        PlaneRing line = trace(edge);
        if (line.size() > 2 && line.front() != line.back()) ++slice.closed_lines;
        if (line.size() > 1 && line.front() == line.back()) line.pop_back();
        if (line.size() > 2) slice.rings.push_back(std::move(line));
      }
    }
  }

  void trace_rings(MeshSlice& slice) {
    for (std::size_t edge = 0; edge < edges_.size(); ++edge) {
      while (left_at(edge) > 0) {
        PlaneRing ring = trace(edge);
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        if (ring.size() > 2) slice.rings.push_back(std::move(ring));
      }
    }
  }

  const Mesh& mesh_;
  std::uint32_t axis_;
  std::array<std::uint32_t, 2> across_;
  double height_;
  std::vector<SliceStep> steps_;
  std::vector<Corners> edges_;                       // the end below the plane first; sorted
  std::vector<std::size_t> begin_, next_, targets_;  // of the steps that begin at each edge
  std::vector<std::size_t> incoming_;
};

Status check_mesh(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto is_fine = [](double x) { return std::fabs(x) <= kMostPlaneCoordinate; };
    if (std::ranges::all_of(mesh.vertices[i], is_fine)) continue;
    return slice_error(fmt::format("vertex {} has a coordinate that is not finite or beyond 1e150", i));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i]) {
      if (v < mesh.vertices.size()) continue;
      return slice_error(fmt::format("face {} uses vertex {} of {}", i, v, mesh.vertices.size()));
    }
  }
  return {};
}

Result<MeshSlice> slice_checked(const Mesh& mesh, const SlicePlane& plane) {
  if (plane.axis > 2) return Error{ErrorCode::kUsage, "`plane` has an axis beyond 2"};
  if (const Status status = check_mesh(mesh); !status) return status.error();
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      lower = std::min(lower, mesh.vertices[v][plane.axis]);
      upper = std::max(upper, mesh.vertices[v][plane.axis]);
    }
  }
  const double share = plane.height / 100;
  const double height = plane.is_share ? lower + share * (upper - lower) : plane.height;
  const char axis = "xyz"[plane.axis];
  if (mesh.triangles.empty()) return slice_error("the mesh has no faces");
  if (!(height > lower && height <= upper)) {
    return slice_error(fmt::format("the plane {}={:.9g} does not meet the mesh, which is between {:.9g} and {:.9g}",
                                   axis, height, lower, upper));
  }
  MeshSlice slice = MeshSlicer(mesh, plane.axis, height).slice();
  add_sentence(slice.assumptions, slice.closed_lines, "open line of the slice is closed by a straight segment.",
               "open lines of the slice are closed by a straight segment.");
  return slice;
}

}  // namespace

Result<SlicePlane> parse_slice_plane(std::string_view text) {
  const auto wrong = [&](std::string_view why) {
    return Error{ErrorCode::kUsage, fmt::format("the plane {} {}; planes are as z=0.3 or x=50%", quoted(text), why)};
  };
  SlicePlane plane;
  const std::size_t axis = text.empty() ? std::string_view::npos : std::string_view("xyz").find(text[0]);
  if (axis == std::string_view::npos || text.size() < 2 || text[1] != '=') return wrong("does not begin with an axis");
  plane.axis = static_cast<std::uint32_t>(axis);
  std::string_view number = text.substr(2);
  plane.is_share = number.ends_with('%');
  if (plane.is_share) number.remove_suffix(1);
  std::string_view why;
  if (!parse_coordinate(number, plane.height, why)) return wrong("has no number after the axis");
  if (plane.is_share && !(plane.height >= 0 && plane.height <= 100)) return wrong("is not between 0% and 100%");
  if (std::fabs(plane.height) > kMostPlaneCoordinate) return wrong("is beyond 1e150");
  return plane;
}

Result<MeshSlice> slice_mesh(const Mesh& mesh, const SlicePlane& plane) {
  return catch_out_of_memory("slicing a mesh", [&] { return slice_checked(mesh, plane); });
}

}  // namespace medial_vk
