#include "page.h"

#include <sstream>

#include "page_text.h"

namespace tumbling {
namespace {

using medial_vk::Point;

/// Numbers as a JavaScript array.
class Numbers {
 public:
  Numbers(std::ostream& out, const char* name) : out_(out) { out_ << '"' << name << "\":["; }
  ~Numbers() { out_ << "],\n"; }
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;

  void add(double x) {
    if (has_begun_) out_ << ',';
    has_begun_ = true;
    out_ << x;
  }
  void add(const Point& p, double scale) {
    for (const double x : p) add(x * scale);
  }

 private:
  std::ostream& out_;
  bool has_begun_ = false;
};

void write_frames(std::ostream& out, const std::vector<Frame>& frames, double scale) {
  {
    Numbers poses(out, "poses");  // by body: three rows of a rotation, a shift
    for (const Frame& frame : frames) {
      for (const medial_vk::Pose& pose : frame.poses) {
        for (const Point& row : pose.rotation) poses.add(row, 1);
        poses.add(pose.shift, scale);
      }
    }
  }
  {
    Numbers points(out, "points");
    for (const Frame& frame : frames) {
      points.add(frame.on_a, scale);
      points.add(frame.on_b, scale);
    }
  }
  Numbers distances(out, "distances");  // lower bound, distance, upper bound
  for (const Frame& frame : frames) {
    for (const double d : {frame.bounds.lower, frame.distance, frame.bounds.upper}) distances.add(d * scale);
  }
}

}  // namespace

std::string page_of(const medial_vk::Mesh& mesh, const medial_vk::Body& body, double side, double half_of_box,
                    const std::vector<Frame>& frames) {
  const double scale = 1 / side;
  std::ostringstream data;
  data.precision(6);
  data << "{\n";
  {
    Numbers vertices(data, "vertices");
    for (const Point& p : mesh.vertices) vertices.add(p, scale);
  }
  {
    Numbers triangles(data, "triangles");
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) triangles.add(corner);
    }
  }
  write_frames(data, frames, scale);
  data << "\"half\":" << half_of_box * scale << ",\"inside\":" << body.inside().size()
       << ",\"cover\":" << body.cover().size() << "\n}";
  std::string page = kPage;
  const std::string mark = "<!--data-->";
  page.replace(page.find(mark), mark.size(), data.str());
  return page;
}

}  // namespace tumbling
