#include "embree_peer.h"

#ifdef MEDIAL_VK_HAVE_EMBREE
#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

namespace medial_vk::bench {
namespace {

using Vector = std::array<float, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector along(const Vector& a, float v, const Vector& b, float w, const Vector& c) {
  return {a[0] + v * b[0] + w * c[0], a[1] + v * b[1] + w * c[1], a[2] + v * b[2] + w * c[2]};
}

/// The nearest point of a triangle by the regions of Ericson 2005, 5.1.5, as in Embree's tutorial.
Vector nearest_on_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const float d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const float d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return along(a, d1 / (d1 - d3), ab, 0, ac);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return along(a, 0, ab, d2 / (d2 - d6), ac);
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return along(b, (d4 - d3) / ((d4 - d3) + (d5 - d6)), c - b, 0, ac);
  const float inverse = 1 / (va + vb + vc);
  return along(a, vb * inverse, ab, vc * inverse, ac);
}

struct Geometry {
  std::vector<Vector> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Nearest {
  const Geometry* geometry;
  float squared;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
  auto* nearest = static_cast<Nearest*>(arguments->userPtr);
  const auto& t = nearest->geometry->triangles[arguments->primID];
  const auto& v = nearest->geometry->vertices;
  const Vector p = {arguments->query->x, arguments->query->y, arguments->query->z};
  const Vector to = nearest_on_triangle(p, v[t[0]], v[t[1]], v[t[2]]) - p;
  const float squared = dot(to, to);
  if (squared >= nearest->squared) return false;
  nearest->squared = squared;
  arguments->query->radius = std::sqrt(squared);
  return true;
}

}  // namespace

struct EmbreePeer::Impl {
  Geometry geometry;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  unsigned threads = 1;

  void run(std::span<const std::array<float, 3>> queries, std::span<float> out) const {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      RTCPointQuery query{queries[i][0], queries[i][1], queries[i][2], 0, std::numeric_limits<float>::infinity()};
      Nearest nearest{&geometry, std::numeric_limits<float>::infinity()};
      rtcPointQuery(scene, &query, &context, visit, &nearest);
      out[i] = std::sqrt(nearest.squared);
    }
  }
};

EmbreePeer::EmbreePeer(const Mesh& mesh, unsigned threads) : impl_(std::make_unique<Impl>()) {
  Geometry& g = impl_->geometry;
  for (const Point& p : mesh.vertices) {
    g.vertices.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  }
  g.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  impl_->threads = threads;
  impl_->device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree may read 16 bytes at the last vertex.
  void* vertices =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, g.vertices.size());
  std::copy_n(g.vertices.data(), g.vertices.size(), static_cast<Vector*>(vertices));
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, g.triangles.size());
  std::copy_n(g.triangles.data(), g.triangles.size(), static_cast<std::array<std::uint32_t, 3>*>(indices));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetGeometryPointQueryFunction(rtcGetGeometry(impl_->scene, 0), visit);
  rtcCommitScene(impl_->scene);
}

EmbreePeer::~EmbreePeer() {
  rtcReleaseScene(impl_->scene);
  rtcReleaseDevice(impl_->device);
}

void EmbreePeer::distances(std::span<const std::array<float, 3>> queries, std::span<float> out) {
  // Chunks small enough that all threads end at about the same time.
  constexpr std::size_t kPart = 4096;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t first = next.fetch_add(kPart); first < queries.size(); first = next.fetch_add(kPart)) {
      const std::size_t count = std::min(kPart, queries.size() - first);
      impl_->run(queries.subspan(first, count), out.subspan(first, count));
    }
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < impl_->threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& thread : others) thread.join();
}

std::string EmbreePeer::version() { return RTC_VERSION_STRING; }

}  // namespace medial_vk::bench

#else

namespace medial_vk::bench {

struct EmbreePeer::Impl {};
EmbreePeer::EmbreePeer(const Mesh&, unsigned) {}
EmbreePeer::~EmbreePeer() = default;
void EmbreePeer::distances(std::span<const std::array<float, 3>>, std::span<float>) {}
std::string EmbreePeer::version() { return ""; }

}  // namespace medial_vk::bench
#endif
