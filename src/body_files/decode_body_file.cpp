#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "base/host_memory.h"
#include "body_files/body_file.h"
#include "common/file_extension.h"
#include "input/text_scanner.h"
#include "output/numpy_files/npz_reader.h"
#include "platform/files.h"

namespace medial_vk {
namespace {

constexpr double kLargest = 1e18;  // distances are computed up to here
constexpr std::uint64_t kMostBalls = std::uint64_t{1} << 24;

template <class T>
T number_at(const std::string& bytes, std::size_t index) {
  char copy[sizeof(T)];
  std::memcpy(copy, bytes.data() + index * sizeof(T), sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(std::begin(copy), std::end(copy));
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

/// Takes the arrays of a body out of those of a file. The first defect ends it.
class Decoder {
 public:
  Decoder(std::map<std::string, NpyArray> arrays, const std::string& name) : arrays_(std::move(arrays)), name_(name) {}

  Result<BodyFile> decode() {
    if (Status status = read_format(); !status) return status.error();
    BodyFile file;
    if (Status status = text("version", file.version); !status) return status.error();
    std::string unit;
    if (Status status = text("unit", unit); !status) return status.error();
    if (unit != "mesh") return wrong("unit", fmt::format("is {:.20} instead of mesh", unit));
    if (Status status = read_mesh(file.mesh); !status) return status.error();
    if (Status status = read_balls("inside_centre", "inside_radius", file.inside); !status) return status.error();
    if (Status status = read_balls("cover_centre", "cover_radius", file.cover); !status) return status.error();
    if (Status status = read_measures(file.measures); !status) return status.error();
    return file;
  }

 private:
  Error wrong(const char* array, const std::string& what) const {
    return file_error(name_, fmt::format("{} {}", array, what));
  }

  /// The array, if it has this type and as many lengths, of which those above 0 are as given. It remains in the file.
  Result<const NpyArray*> find_array(const char* name, const char* type,
                                     const std::vector<std::uint64_t>& shape) const {
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) return wrong(name, "is missing: this is no body file, or one of another version");
    const NpyArray& array = found->second;
    bool fits = array.type == type && array.shape.size() == shape.size();
    for (std::size_t i = 0; fits && i < shape.size(); ++i) fits = shape[i] == 0 || shape[i] == array.shape[i];
    if (!fits) return wrong(name, fmt::format("has another type than {} or another shape", type));
    return &array;
  }

  Status text(const char* name, std::string& value) const {
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) return wrong(name, "is missing: this is no body file, or one of another version");
    const NpyArray& array = found->second;
    if (!array.type.starts_with("<U") || !array.shape.empty()) return wrong(name, "is no text");
    for (std::size_t i = 0; i < array.bytes.size() / 4; ++i) {
      const auto letter = number_at<std::uint32_t>(array.bytes, i);
      if (letter < ' ' || letter > '~') return wrong(name, "has letters that are not ASCII");
      value += static_cast<char>(letter);
    }
    return {};
  }

  template <class T>
  Status numbers(const char* name, const char* type, const std::vector<std::uint64_t>& shape,
                 std::vector<T>& values) const {
    const Result<const NpyArray*> found = find_array(name, type, shape);
    if (!found) return found.error();
    const std::string& bytes = found.value()->bytes;
    values.resize(bytes.size() / sizeof(T));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = number_at<T>(bytes, i);
    return {};
  }

  Status finite(const char* name, const std::vector<std::uint64_t>& shape, std::vector<double>& values) const {
    if (Status status = numbers(name, "<f8", shape, values); !status) return status;
    const auto bad = std::ranges::find_if(values, [](double x) { return !(std::fabs(x) <= kLargest); });
    if (bad == values.end()) return {};
    return wrong(name, fmt::format("has a number that is not finite or beyond {:g}, the {}th", kLargest,
                                   bad - values.begin() + 1));
  }

  /// Volumes are finite; they may be larger than coordinates.
  Status volume(const char* name, double& value) const {
    std::vector<double> values;
    if (Status status = numbers(name, "<f8", {}, values); !status) return status;
    value = values.front();
    if (!std::isfinite(value)) return wrong(name, "is not finite");
    return {};
  }

  Status read_format() const {
    std::string format;
    if (Status status = text("format", format); !status) return status;
    if (format != "medial-vk body") return wrong("format", "is not that of a body file");
    std::vector<std::uint32_t> version;
    if (Status status = numbers("format_version", "<u4", {}, version); !status) return status;
    if (version.front() == kBodyFileFormat) return {};
    return wrong("format_version", fmt::format("is {}; this program reads {}", version.front(), kBodyFileFormat));
  }

  Status read_mesh(Mesh& mesh) const {
    std::vector<double> vertices;
    std::vector<std::uint32_t> corners;
    if (Status status = finite("vertices", {0, 3}, vertices); !status) return status;
    if (Status status = numbers("triangles", "<u4", {0, 3}, corners); !status) return status;
    if (vertices.size() / 3 > std::numeric_limits<std::uint32_t>::max()) return wrong("vertices", "are too many");
    mesh.vertices.resize(vertices.size() / 3);
    for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices[i / 3][i % 3] = vertices[i];
    mesh.triangles.resize(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] >= mesh.vertices.size()) {
        return wrong("triangles", fmt::format("use vertex {} of {}", corners[i], mesh.vertices.size()));
      }
      mesh.triangles[i / 3][i % 3] = corners[i];
    }
    if (mesh.triangles.empty()) return wrong("triangles", "are none");
    return {};
  }

  Status read_balls(const char* centres, const char* radii, std::vector<Ball>& balls) const {
    std::vector<double> centre, radius;
    if (Status status = finite(centres, {0, 3}, centre); !status) return status;
    if (Status status = finite(radii, {0}, radius); !status) return status;
    if (centre.size() != 3 * radius.size() || radius.size() > kMostBalls) {
      return wrong(radii, fmt::format("has {} numbers for {} centres", radius.size(), centre.size() / 3));
    }
    balls.resize(radius.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (radius[i] < 0) return wrong(radii, fmt::format("is negative for ball {}", i));
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::fabs(centre[3 * i + k]) + radius[i] <= kLargest) continue;
        return wrong(radii, fmt::format("reaches beyond {:g} for ball {}", kLargest, i));
      }
      balls[i] = {{centre[3 * i], centre[3 * i + 1], centre[3 * i + 2]}, radius[i]};
    }
    return {};
  }

  Status read_bounds(const char* name, Bounds& bounds) const {
    std::vector<double> both;
    if (Status status = finite(name, {2}, both); !status) return status;
    bounds = {both[0], both[1]};
    if (bounds.lower > bounds.upper) return wrong(name, "is no interval");
    return {};
  }

  Status read_count(const char* name, std::uint64_t& count) const {
    std::vector<std::uint64_t> one;
    if (Status status = numbers(name, "<u8", {}, one); !status) return status;
    count = one.front();
    return {};
  }

  Status read_measures(BodyMeasures& measures) const {
    std::vector<double> excess;
    if (Status status = finite("inside_excess", {}, excess); !status) return status;
    measures.inside_excess = excess.front();
    if (Status status = read_bounds("inside_gap", measures.inside_gap); !status) return status;
    if (Status status = read_bounds("cover_reach_out", measures.cover_reach_out); !status) return status;
    if (Status status = read_count("covered_triangles", measures.covered_triangles); !status) return status;
    if (Status status = read_count("envelope_vertices", measures.envelope_vertices); !status) return status;
    if (Status status = volume("solid_volume", measures.solid_volume); !status) return status;
    if (Status status = volume("inside_volume", measures.inside_volume); !status) return status;
    return volume("cover_volume", measures.cover_volume);
  }

  const std::map<std::string, NpyArray> arrays_;
  const std::string& name_;
};

}  // namespace

bool is_body_file(const std::string& path) { return file_extension(path) == ".npz"; }

Result<BodyFile> decode_body_file(std::string_view bytes, const std::string& name) {
  return catch_out_of_memory("reading a body", [&]() -> Result<BodyFile> {
    Result<std::map<std::string, NpyArray>> arrays = read_npz(bytes, name);
    if (!arrays) return arrays.error();
    return Decoder(std::move(arrays).value(), name).decode();
  });
}

Result<BodyFile> read_body_file(const std::string& path) {
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(platform::open_to_read(path),
                                                             [](std::FILE* open) { return std::fclose(open); });
  std::string bytes;
  if (file) {
    std::array<char, 1 << 16> part;
    for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), file.get())) > 0;) {
      bytes.append(part.data(), count);
    }
  }
  if (!file || std::ferror(file.get())) {
    return file_error(path, fmt::format("cannot be read: {}", std::strerror(errno == 0 ? EIO : errno)));
  }
  return decode_body_file(bytes, path);
}

}  // namespace medial_vk
