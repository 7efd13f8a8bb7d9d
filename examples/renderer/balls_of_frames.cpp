#include "balls_of_frames.h"

#include <medial_vk/analysis.h>

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kResolution = 200;  // voxels along the longest side: some 20,000 spheres
constexpr std::uint32_t kCorners = 4;       // a ball is drawn as a strip of two triangles

medial_vk::ExtractionOptions extraction() {
  medial_vk::ExtractionOptions options;
  options.resolution = kResolution;
  return options;
}

// Certified, so that they are inside up to the rounding of double precision, as the follower requires.
std::vector<medial_vk::MedialSphere> spheres_of(const medial_vk::IndexedMesh& mesh, medial_vk::Context& context) {
  medial_vk::AnalysisOptions options;
  options.extraction = extraction();
  return take(medial_vk::analyse(mesh, options, context)).spheres;
}

medial_vk::FollowerJob follower(const std::vector<medial_vk::MedialSphere>& spheres, const medial_vk::IndexedMesh& rest,
                                medial_vk::Context& context, std::uint32_t frames) {
  std::vector<medial_vk::Ball> balls;
  balls.reserve(spheres.size());
  for (const medial_vk::MedialSphere& sphere : spheres) balls.push_back({sphere.centre, sphere.radius});
  medial_vk::FollowerJobOptions options;
  options.frames = frames;
  return take(medial_vk::FollowerJob::create(context, rest, balls, options));
}

}  // namespace

void check(const medial_vk::Status& status) {
  if (!status) fail(status.error().message.c_str());
}

SearchedBalls::SearchedBalls(medial_vk::Context& context, const medial_vk::IndexedMesh& mesh,
                             std::uint32_t frames_in_flight)
    : mesh_(mesh),
      job_(take(medial_vk::ExtractionJob::create(context, mesh, extraction(), {frames_in_flight, kCorners}))) {}

void SearchedBalls::record(VkCommandBuffer commands, std::span<const medial_vk::Point> vertices) {
  const auto start = Clock::now();
  check(mesh_.move_vertices(vertices));
  check(job_.update(mesh_));
  const auto moved = Clock::now();
  check(job_.record(commands));
  times_.moving += moved - start;
  times_.recording += Clock::now() - moved;
}

void SearchedBalls::count() {
  const medial_vk::RecordedCounts counts = job_.counts();
  if (counts.complete == 0) fail("the job's memory is too small for the spheres");
  spheres_ = counts.spheres;
}

FollowedBalls::FollowedBalls(const VulkanHost& host, medial_vk::Context& context, const medial_vk::IndexedMesh& rest,
                             std::uint32_t frames_in_flight)
    : host_(host),
      at_rest_(spheres_of(rest, context)),
      job_(follower(at_rest_, rest, context, frames_in_flight)),
      angles_(host.create_buffer(sizeof(float) * at_rest_.size(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)) {
  float* angle = static_cast<float*>(angles_.mapped);
  for (const medial_vk::MedialSphere& sphere : at_rest_) *angle++ = sphere.object_angle;
}

FollowedBalls::~FollowedBalls() { host_.destroy(angles_); }

void FollowedBalls::record(VkCommandBuffer commands, std::span<const medial_vk::Point> vertices) {
  const auto start = Clock::now();
  check(job_.set_vertices(vertices));
  const auto moved = Clock::now();
  check(job_.record(commands));
  times_.moving += moved - start;
  times_.recording += Clock::now() - moved;
}
