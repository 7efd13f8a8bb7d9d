#include "output/medial_formats/encode_npz.h"

#include "output/numpy_files/npz_writer.h"

namespace medial_vk {
namespace {

class Arrays {
 public:
  explicit Arrays(std::span<const MedialSphere> spheres) : spheres_(spheres) {}

  /// One number per point.
  template <class T>
  void column(const char* name, T MedialSphere::*member) {
    std::string bytes;
    bytes.reserve(spheres_.size() * sizeof(T));
    for (const MedialSphere& sphere : spheres_) append_little_endian(bytes, sphere.*member);
    out.add(name, kNumpyType<T>, {spheres_.size()}, bytes);
  }

  /// Three numbers per point.
  template <class T>
  void column(const char* name, std::array<T, 3> MedialSphere::*member) {
    std::string bytes;
    bytes.reserve(spheres_.size() * 3 * sizeof(T));
    for (const MedialSphere& sphere : spheres_) {
      for (const T x : sphere.*member) append_little_endian(bytes, x);
    }
    out.add(name, kNumpyType<T>, {spheres_.size(), 3}, bytes);
  }

  /// A truth value per point: whether it has the mark.
  void flags(const char* name, std::span<const std::uint8_t> marks, PointMark mark) {
    std::string bytes;
    for (const std::uint8_t marked : marks) bytes += marked & mark ? '\1' : '\0';
    out.add(name, "|b1", {marks.size()}, bytes);
  }

  /// 0 is inside, 1 outside.
  void sides(const MedialHeader& header) {
    std::string bytes;
    for (std::size_t i = 0; i < spheres_.size(); ++i) bytes += header.side_of(i) == MeshSide::kInside ? '\0' : '\1';
    out.add("side", "|u1", {spheres_.size()}, bytes);
  }

  NpzWriter out;

 private:
  std::span<const MedialSphere> spheres_;
};

}  // namespace

Result<std::string> encode_npz(const MedialHeader& header, std::span<const MedialSphere> spheres,
                               std::span<const std::uint8_t> marks) {
  Arrays arrays(spheres);
  arrays.column("centre", &MedialSphere::centre);
  arrays.column("radius", &MedialSphere::radius);
  arrays.column("spoke_a", &MedialSphere::spoke_a);
  arrays.column("spoke_b", &MedialSphere::spoke_b);
  arrays.column("object_angle", &MedialSphere::object_angle);
  arrays.column("flux", &MedialSphere::flux);
  arrays.column("sheet", &MedialSphere::sheet);
  arrays.flags("seam", marks, kSeam);
  arrays.flags("rim", marks, kRim);
  arrays.column("voxel", &MedialSphere::voxel);
  if (header.inside_count) arrays.sides(header);
  NpzWriter& out = arrays.out;
  out.text("version", header.version);
  out.numbers<double>("grid_origin", {3}, header.grid_origin);
  out.number("voxel_size", header.voxel_size);
  out.number("epsilon", header.epsilon);
  out.number("object_angle_threshold", header.object_angle);
  out.number("radius_threshold", header.radius_threshold);
  return out.finish();
}

}  // namespace medial_vk
