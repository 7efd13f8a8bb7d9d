#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/quoted.h"
#include "input/text_scanner.h"
#include "shape_files/shape_readers.h"

namespace medial_vk {
namespace {

using ShapeJson = nlohmann::json;

struct GeoJsonFault {
  std::string what;
};

class GeoJsonReader {
 public:
  void read(const ShapeJson& object) {
    const std::string type = type_of(object);
    if (type == "FeatureCollection") {
      const ShapeJson& features = list_of(object, "features");
      for (std::size_t i = 0; i < features.size(); ++i) {
        const Within within(*this, fmt::format("features[{}]", i));
        if (type_of(features[i]) != "Feature") throw fault("this is no Feature");
        feature(features[i]);
      }
    } else if (type == "Feature") {
      feature(object);
    } else {
      geometry(object, type, 0);
    }
  }

  GeometrySet& set() { return set_; }
  /// A fault with the path of the member, or the end of a long one.
  std::string where(const std::string& what) const {
    if (path_.empty()) return what;
    constexpr std::size_t kMost = 120;
    if (path_.size() <= kMost) return path_ + ": " + what;
    return "..." + path_.substr(path_.size() - kMost) + ": " + what;
  }

 private:
  /// A part of the path of the member that is read.
  class Within {
   public:
    Within(GeoJsonReader& reader, const std::string& part) : reader_(reader), length_(reader.path_.size()) {
      if (length_ > 0 && part.front() != '[') reader.path_ += '.';
      reader.path_ += part;
    }
    // After a fault the path stays as it is, for the message.
    ~Within() {
      if (!reader_.failed_) reader_.path_.resize(length_);
    }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

   private:
    GeoJsonReader& reader_;
    std::size_t length_;
  };

  GeoJsonFault fault(std::string what) {
    failed_ = true;
    return {std::move(what)};
  }

  std::string type_of(const ShapeJson& object) {
    if (!object.is_object()) throw fault("this is no object");
    const auto type = object.find("type");
    if (type == object.end() || !type->is_string()) throw fault("the object has no type");
    return type->get<std::string>();
  }

  const ShapeJson& list_of(const ShapeJson& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end() || !found->is_array()) throw fault(fmt::format("there is no list of {}", member));
    return *found;
  }

  void feature(const ShapeJson& object) {
    const auto found = object.find("geometry");
    if (found == object.end()) throw fault("the Feature has no geometry");
    if (found->is_null()) return;  // a Feature without a place
    const Within within(*this, "geometry");
    geometry(*found, type_of(*found), 0);
  }

  void geometry(const ShapeJson& object, const std::string& type, int depth) {
    if (type == "GeometryCollection") {
      if (depth == kMostNestedCollections) throw fault("collections are nested too deeply");
      const ShapeJson& parts = list_of(object, "geometries");
      for (std::size_t i = 0; i < parts.size(); ++i) {
        const Within within(*this, fmt::format("geometries[{}]", i));
        geometry(parts[i], type_of(parts[i]), depth + 1);
      }
      return;
    }
    if (type == "Point" || type == "MultiPoint") return set_.add_points();
    if (type != "Polygon" && type != "MultiPolygon" && type != "LineString" && type != "MultiLineString") {
      throw fault(fmt::format("the type {} is unknown", medial_vk::quoted(type)));
    }
    const ShapeJson& coordinates = list_of(object, "coordinates");
    const Within within(*this, "coordinates");
    if (type == "Polygon") return set_.add_polygon(rings_of(coordinates));
    if (type == "LineString") return set_.add_line(positions_of(coordinates));
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      const Within part(*this, fmt::format("[{}]", i));
      if (type == "MultiPolygon") {
        set_.add_polygon(rings_of(coordinates[i]));
      } else {
        set_.add_line(positions_of(coordinates[i]));
      }
    }
  }

  std::vector<PlaneRing> rings_of(const ShapeJson& list) {
    if (!list.is_array()) throw fault("this is no list of rings");
    std::vector<PlaneRing> rings;
    rings.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Within within(*this, fmt::format("[{}]", i));
      rings.push_back(positions_of(list[i]));
    }
    return rings;
  }

  PlaneRing positions_of(const ShapeJson& list) {
    if (!list.is_array()) throw fault("this is no list of positions");
    PlaneRing ring;
    ring.reserve(list.size());
    for (const ShapeJson& position : list) {
      const bool fine =
          position.is_array() && position.size() >= 2 && is_coordinate(position[0]) && is_coordinate(position[1]);
      if (!fine) {
        throw fault(fmt::format("position {} is not two or more numbers of 1e150 at most", ring.size()));
      }
      ring.push_back({position[0].get<double>(), position[1].get<double>()});
    }
    return ring;
  }

  static bool is_coordinate(const ShapeJson& value) {
    return value.is_number() && std::fabs(value.get<double>()) <= kMostPlaneCoordinate;
  }

  GeometrySet set_;
  std::string path_;
  bool failed_ = false;
};

std::uint64_t line_of_byte(std::string_view bytes, std::size_t byte) {
  const std::string_view before = bytes.substr(0, std::min(byte, bytes.size()));
  return 1 + static_cast<std::uint64_t>(std::ranges::count(before, '\n'));
}

}  // namespace

Result<AreasOfFile> read_geojson(std::string_view bytes, const std::string& name) {
  ShapeJson root;
  try {
    root = ShapeJson::parse(bytes.begin(), bytes.end());
  } catch (const ShapeJson::parse_error& error) {
    return line_error(name, line_of_byte(bytes, error.byte == 0 ? 0 : error.byte - 1), "this is no well-formed JSON");
  } catch (const ShapeJson::exception&) {
    return file_error(name, "a number is beyond the range of a double");
  }
  GeoJsonReader reader;
  try {
    reader.read(root);
  } catch (const GeoJsonFault& fault) {
    return file_error(name, reader.where(fault.what));
  }
  AreasOfFile read;
  read.assumptions = reader.set().assumptions();
  read.closed_lines = reader.set().closed_lines();
  read.areas = reader.set().take_areas();
  return read;
}

}  // namespace medial_vk
