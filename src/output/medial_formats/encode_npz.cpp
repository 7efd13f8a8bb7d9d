#include "output/medial_formats/encode_npz.h"

#include <fmt/format.h>

#include <vector>

#include "output/atomic_files/little_endian.h"
#include "output/medial_formats/zip_archive.h"

namespace medial_vk {
namespace {

template <class T>
constexpr const char* kDescription = nullptr;
template <>
constexpr const char* kDescription<double> = "<f8";
template <>
constexpr const char* kDescription<float> = "<f4";
template <>
constexpr const char* kDescription<std::int32_t> = "<i4";
template <>
constexpr const char* kDescription<std::uint32_t> = "<u4";

/// Format version 1.0 of NumPy's NEP 1: a dictionary in the notation of Python, padded so that the numbers are aligned.
std::string npy_header(const std::string& description, const std::string& shape) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kPrefix = 10;
  std::string words = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", description, shape);
  words.append(kAlignment - (kPrefix + words.size() + 1) % kAlignment, ' ');
  words += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  append_little_endian(out, static_cast<std::uint16_t>(words.size()));
  return out + words;
}

class Arrays {
 public:
  explicit Arrays(std::span<const MedialSphere> spheres) : spheres_(spheres) {}

  void scalar(const char* name, double value) {
    std::string bytes = npy_header(kDescription<double>, "()");
    append_little_endian(bytes, value);
    add(name, std::move(bytes));
  }

  void point(const char* name, const Point& value) {
    std::string bytes = npy_header(kDescription<double>, "(3,)");
    for (const double x : value) append_little_endian(bytes, x);
    add(name, std::move(bytes));
  }

  /// ASCII only, which NumPy stores as four bytes per letter.
  void text(const char* name, const std::string& value) {
    std::string bytes = npy_header(fmt::format("<U{}", value.size()), "()");
    for (const char letter : value) append_little_endian(bytes, static_cast<std::uint32_t>(letter));
    add(name, std::move(bytes));
  }

  /// One number per point.
  template <class T>
  void column(const char* name, T MedialSphere::*member) {
    std::string bytes = npy_header(kDescription<T>, fmt::format("({},)", spheres_.size()));
    bytes.reserve(bytes.size() + spheres_.size() * sizeof(T));
    for (const MedialSphere& sphere : spheres_) append_little_endian(bytes, sphere.*member);
    add(name, std::move(bytes));
  }

  /// Three numbers per point.
  template <class T>
  void column(const char* name, std::array<T, 3> MedialSphere::*member) {
    std::string bytes = npy_header(kDescription<T>, fmt::format("({}, 3)", spheres_.size()));
    bytes.reserve(bytes.size() + spheres_.size() * 3 * sizeof(T));
    for (const MedialSphere& sphere : spheres_) {
      for (const T x : sphere.*member) append_little_endian(bytes, x);
    }
    add(name, std::move(bytes));
  }

  /// A truth value per point: whether it has the mark.
  void flags(const char* name, std::span<const std::uint8_t> marks, PointMark mark) {
    std::string bytes = npy_header("|b1", fmt::format("({},)", marks.size()));
    for (const std::uint8_t marked : marks) bytes += marked & mark ? '\1' : '\0';
    add(name, std::move(bytes));
  }

  const std::vector<ZipMember>& members() const { return members_; }

 private:
  void add(const char* name, std::string bytes) { members_.push_back({fmt::format("{}.npy", name), std::move(bytes)}); }

  std::span<const MedialSphere> spheres_;
  std::vector<ZipMember> members_;
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
  arrays.text("version", header.version);
  arrays.point("grid_origin", header.grid_origin);
  arrays.scalar("voxel_size", header.voxel_size);
  arrays.scalar("epsilon", header.epsilon);
  arrays.scalar("object_angle_threshold", header.object_angle);
  arrays.scalar("radius_threshold", header.radius_threshold);
  return make_zip(arrays.members());
}

}  // namespace medial_vk
