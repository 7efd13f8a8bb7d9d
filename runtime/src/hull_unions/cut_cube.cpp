#include "hull_unions/cut_cube.h"

#include <algorithm>
#include <utility>

namespace medial_vk {
namespace {

/// Corner k of the cube is at -1 or 1 along axis i by bit i of k.
constexpr std::array<std::array<std::uint16_t, 4>, 6> kCubeFaces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

}  // namespace

CutCube::CutCube() {
  for (std::size_t k = 0; k < 8; ++k) {
    points_[k] = {(k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0};
  }
  point_count_ = 8;
  face_count_ = 6;
  for (std::size_t f = 0; f < 6; ++f) {
    faces_[f].count = 4;
    std::copy(kCubeFaces[f].begin(), kCubeFaces[f].end(), faces_[f].corners.begin());
  }
}

/// The point of the plane on the edge, the same for both of its faces.
std::uint16_t CutCube::crossing(std::uint16_t a, std::uint16_t b) {
  if (b < a) std::swap(a, b);
  for (std::size_t i = 0; i < cut_edge_count_; ++i) {
    if (cut_edges_[i].a == a && cut_edges_[i].b == b) return cut_edges_[i].point;
  }
  const double share = height_[a] / (height_[a] - height_[b]);
  const auto point = static_cast<std::uint16_t>(point_count_++);
  points_[point] = points_[a] + share * (points_[b] - points_[a]);
  cut_edges_[cut_edge_count_++] = {a, b, point};
  return point;
}

/// False if the border of the face crosses the plane more than twice.
bool CutCube::cut_face(const Face& face, Face& kept) {
  kept.count = 0;
  std::size_t crossings = 0;
  CutFace cut = {0, 0};
  for (std::size_t i = 0; i < face.count; ++i) {
    const std::uint16_t a = face.corners[i], b = face.corners[i + 1 == face.count ? 0 : i + 1];
    const bool a_stays = height_[a] >= 0, b_stays = height_[b] >= 0;
    if (a_stays) kept.corners[kept.count++] = a;
    if (a_stays == b_stays) continue;
    if (++crossings > 2) return false;
    const std::uint16_t point = crossing(a, b);
    kept.corners[kept.count++] = point;
    (a_stays ? cut.exit : cut.entry) = point;
  }
  if (crossings == 2) cut_faces_[cut_face_count_++] = cut;
  return true;
}

/// The new face: it runs along the cut of each face against the direction of that face.
bool CutCube::close(Face& cap) const {
  cap.count = 0;
  std::uint16_t at = cut_faces_[0].entry;
  for (std::size_t step = 0; step < cut_face_count_; ++step) {
    cap.corners[cap.count++] = at;
    const auto* const end = cut_faces_.data() + cut_face_count_;
    const auto* const next =
        std::find_if(cut_faces_.data(), end, [at](const CutFace& face) { return face.entry == at; });
    if (next == end) return false;
    at = next->exit;
    if (at == cut_faces_[0].entry) return step + 1 == cut_face_count_;
  }
  return false;
}

bool CutCube::cut(const Point& normal, double offset) {
  std::size_t above = 0, below = 0;
  for (std::size_t f = 0; f < face_count_; ++f) {
    for (std::size_t i = 0; i < faces_[f].count; ++i) {
      const std::uint16_t k = faces_[f].corners[i];
      height_[k] = dot(normal, points_[k]) - offset;
      ++(height_[k] >= 0 ? above : below);
    }
  }
  if (below == 0) return true;
  if (above == 0) {
    face_count_ = 0;
    return true;
  }
  const std::size_t points_before = point_count_;
  std::array<Face, kMostFaces> faces;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled up to `count`
  std::size_t count = 0;
  cut_edge_count_ = cut_face_count_ = 0;
  bool consistent = true;
  for (std::size_t f = 0; f < face_count_ && consistent; ++f) {
    consistent = cut_face(faces_[f], faces[count]);
    if (faces[count].count > 0) ++count;
  }
  if (!consistent || cut_face_count_ < 3 || !close(faces[count])) {
    point_count_ = points_before;
    return false;
  }
  ++count;
  for (std::size_t f = 0; f < count; ++f) {
    faces_[f].count = faces[f].count;
    std::copy_n(faces[f].corners.begin(), faces[f].count, faces_[f].corners.begin());
  }
  face_count_ = count;
  return true;
}

double CutCube::volume() const {
  double sum = 0;
  for (std::size_t f = 0; f < face_count_; ++f) {
    const Face& face = faces_[f];
    const Point& first = points_[face.corners[0]];
    for (std::size_t i = 2; i < face.count; ++i) {
      sum += dot(first, cross(points_[face.corners[i - 1]], points_[face.corners[i]]));
    }
  }
  return sum / 6;
}

}  // namespace medial_vk
