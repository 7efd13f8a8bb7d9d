// Analyses as bytes, for pickling. Fields follow each other as the structures have them; a structure with another
// number of fields does not compile here.
#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "medial_vk/version.h"
#include "native/analyses/analysis_handle.h"

namespace medial_vk::python {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are those of little-endian machines");

template <class T, class Structure>
concept Of = std::same_as<std::remove_const_t<T>, Structure>;
template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class Archive, Of<VoxelGrid> S>
void each_field(Archive& all, S& of) {
  auto& [origin, voxel_size, size] = of;
  all(origin, voxel_size, size);
}
template <class Archive, Of<MedialSphere> S>
void each_field(Archive& all, S& of) {
  auto& [centre, radius, spoke_a, spoke_b, object_angle, flux, sheet, voxel] = of;
  all(centre, radius, spoke_a, spoke_b, object_angle, flux, sheet, voxel);
}
template <class Archive, Of<UndecidedVoxel> S>
void each_field(Archive& all, S& of) {
  auto& [voxel, kind, width] = of;
  all(voxel, kind, width);
}
template <class Archive, Of<CertificateReport> S>
void each_field(Archive& all, S& of) {
  auto& [passed, rejected] = of;
  all(passed, rejected);
}
template <class Archive, Of<Sheet> S>
void each_field(Archive& all, S& of) {
  auto& [points, area, mean_radius, mean_object_angle, significance] = of;
  all(points, area, mean_radius, mean_object_angle, significance);
}
template <class Archive, Of<Sheets> S>
void each_field(Archive& all, S& of) {
  auto& [of_point, marks, areas, sheets, components, absorbed_components, absorbed_points, fragments, fragment_points,
         seam_points, rim_points] = of;
  all(of_point, marks, areas, sheets, components, absorbed_components, absorbed_points, fragments, fragment_points,
      seam_points, rim_points);
}
template <class Archive, Of<BettiNumbers> S>
void each_field(Archive& all, S& of) {
  auto& [components, tunnels, cavities] = of;
  all(components, tunnels, cavities);
}
template <class Archive, Of<Significance> S>
void each_field(Archive& all, S& of) {
  auto& [volume, area, topology, of_component, of_ball, of_sheet, areas] = of;
  all(volume, area, topology, of_component, of_ball, of_sheet, areas);
}
template <class Archive, Of<SheetRemoval> S>
void each_field(Archive& all, S& of) {
  auto& [sheets, volume_left, kept] = of;
  all(sheets, volume_left, kept);
}
template <class Archive, Of<MedialTopology> S>
void each_field(Archive& all, S& of) {
  auto& [betti, euler_characteristic, boundary_edges, non_manifold_edges, bare_edges, hosted_points] = of;
  all(betti, euler_characteristic, boundary_edges, non_manifold_edges, bare_edges, hosted_points);
}
template <class Archive, Of<MedialMesh> S>
void each_field(Archive& all, S& of) {
  auto& [triangles, edges, edge_marks, topology] = of;
  all(triangles, edges, edge_marks, topology);
}
template <class Archive, Of<ExtractionCounters::Level> S>
void each_field(Archive& all, S& of) {
  auto& [cell_size, visited, kept, contacts, found, lines, triangle_tests, cluster_tests, node_tests] = of;
  all(cell_size, visited, kept, contacts, found, lines, triangle_tests, cluster_tests, node_tests);
}
template <class Archive, Of<ExtractionCounters> S>
void each_field(Archive& all, S& of) {
  auto& [levels, found, undecided, proved_empty, queries, narrowing_steps, retries] = of;
  all(levels, found, undecided, proved_empty, queries, narrowing_steps, retries);
}
template <class Archive, Of<StageTime> S>
void each_field(Archive& all, S& of) {
  auto& [stage, seconds] = of;
  all(stage, seconds);
}
template <class Archive, Of<ExtractionMeasurements> S>
void each_field(Archive& all, S& of) {
  auto& [counters, device_times, host_times] = of;
  all(counters, device_times, host_times);
}
template <class Archive, Of<Analysis> S>
void each_field(Archive& all, S& of) {
  auto& [grid, spheres, undecided, certificate, simplified, sheets, significance, by_significance, keeping_topology,
         removal, medial_mesh, euler_characteristic, measurements] = of;
  all(grid, spheres, undecided, certificate, simplified, sheets, significance, by_significance, keeping_topology,
      removal, medial_mesh, euler_characteristic, measurements);
}
template <class Archive, Of<ThesisOptions> S>
void each_field(Archive& all, S& of) {
  auto& [narrow_features, samples] = of;
  all(narrow_features, samples);
}
template <class Archive, Of<MeasurementOptions> S>
void each_field(Archive& all, S& of) {
  auto& [kernel_times] = of;
  all(kernel_times);
}
template <class Archive, Of<ExtractionOptions> S>
void each_field(Archive& all, S& of) {
  auto& [mode, resolution, object_angle, radius, deep_angle, epsilon, extra_levels, thesis, memory_budget, threads,
         measurements] = of;
  all(mode, resolution, object_angle, radius, deep_angle, epsilon, extra_levels, thesis, memory_budget, threads,
      measurements);
}
template <class Archive, Of<SheetOptions> S>
void each_field(Archive& all, S& of) {
  auto& [angle, crease, border, width, absorb_fragments, areas, threads] = of;
  all(angle, crease, border, width, absorb_fragments, areas, threads);
}
template <class Archive, Of<AnalysisOptions> S>
void each_field(Archive& all, S& of) {
  auto& [extraction, sheets, simplify, volumes, keep_volume, keep_topology, removal_orders, medial_mesh, threads] = of;
  all(extraction, sheets, simplify, volumes, keep_volume, keep_topology, removal_orders, medial_mesh, threads);
}
template <class Archive, Of<DeviceLimit> S>
void each_field(Archive& all, S& of) {
  auto& [name, needed, there] = of;
  all(name, needed, there);
}
template <class Archive, Of<DeviceHeap> S>
void each_field(Archive& all, S& of) {
  auto& [bytes, is_local] = of;
  all(bytes, is_local);
}
template <class Archive, Of<DeviceSubgroups> S>
void each_field(Archive& all, S& of) {
  auto& [size, operations, in_compute] = of;
  all(size, operations, in_compute);
}
template <class Archive, Of<DeviceDescription> S>
void each_field(Archive& all, S& of) {
  auto& [index, name, type, driver, api_version, memory_bytes, usable, why_not, limits, heaps, subgroups] = of;
  all(index, name, type, driver, api_version, memory_bytes, usable, why_not, limits, heaps, subgroups);
}

/// Appends fields to bytes.
class StateWriter {
 public:
  template <class... Fields>
  void operator()(const Fields&... fields) {
    (write(fields), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <Plain T>
  void write(const T& value) {
    const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes_.append(bytes.data(), bytes.size());
  }
  void write(const std::string& text) {
    write(std::uint64_t{text.size()});
    bytes_ += text;
  }
  template <class T, std::size_t n>
  void write(const std::array<T, n>& row) {
    for (const T& value : row) write(value);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(std::uint64_t{values.size()});
    for (const T& value : values) write(value);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write(value.has_value());
    if (value) write(*value);
  }
  template <class T>
  requires(std::is_class_v<T>) void write(const T& structure) { each_field(*this, structure); }

  std::string bytes_;
};

/// Takes fields from bytes, as long as there are any.
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : left_(bytes) {}

  template <class... Fields>
  void operator()(Fields&... fields) {
    (read(fields), ...);
  }
  /// All bytes have been taken, and no more were wanted.
  bool is_complete() const { return is_whole_ && left_.empty(); }

 private:
  std::string_view next(std::size_t size) {
    if (size > left_.size()) {
      is_whole_ = false;
      left_ = {};
      return {};
    }
    const std::string_view bytes = left_.substr(0, size);
    left_.remove_prefix(size);
    return bytes;
  }
  template <Plain T>
  void read(T& value) {
    const std::string_view bytes = next(sizeof(T));
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof(T));
  }
  void read(bool& value) {
    std::uint8_t byte = 0;
    read(byte);
    value = byte != 0;
  }
  /// Of a text or a list, whose elements have a byte each at least.
  std::size_t read_size() {
    std::uint64_t size = 0;
    read(size);
    if (size <= left_.size()) return static_cast<std::size_t>(size);
    is_whole_ = false;
    left_ = {};
    return 0;
  }
  void read(std::string& text) { text = next(read_size()); }
  template <class T, std::size_t n>
  void read(std::array<T, n>& row) {
    for (T& value : row) read(value);
  }
  template <class T>
  void read(std::vector<T>& values) {
    const std::size_t size = read_size();
    values.clear();
    for (std::size_t i = 0; i < size && is_whole_; ++i) read(values.emplace_back());
  }
  template <class T>
  void read(std::optional<T>& value) {
    bool is_there = false;
    read(is_there);
    value.reset();
    if (!is_there) return;
    T made{};
    read(made);
    value = std::move(made);
  }
  template <class T>
  requires(std::is_class_v<T>) void read(T& structure) { each_field(*this, structure); }

  std::string_view left_;
  bool is_whole_ = true;
};

std::string version() {
  return "medial-vk " + std::to_string(MEDIAL_VK_VERSION_MAJOR) + "." + std::to_string(MEDIAL_VK_VERSION_MINOR) + "." +
         std::to_string(MEDIAL_VK_VERSION_PATCH);
}

}  // namespace

std::string encode_analysis(const AnalysisHandle& handle) {
  StateWriter writer;
  writer(version(), handle.options, handle.device, handle.result);
  return writer.take();
}

Result<std::shared_ptr<AnalysisHandle>> decode_analysis(const IndexedMesh& mesh, std::string_view bytes) {
  auto handle = std::make_shared<AnalysisHandle>(AnalysisHandle{mesh, {}, {}, {}});
  StateReader reader(bytes);
  std::string made_by;
  reader(made_by);
  if (made_by != version()) {
    return Error{ErrorCode::kUsage, "the analysis was not pickled by " + version() + ", of which this package is"};
  }
  reader(handle->options, handle->device, handle->result);
  if (!reader.is_complete()) return Error{ErrorCode::kUsage, "the bytes of a pickled analysis are damaged"};
  return handle;
}

}  // namespace medial_vk::python
