#include "output/medial_formats/encode_points.h"

#include "output/medial_formats/ball_mesh.h"
#include "output/medial_formats/encode_glb.h"
#include "output/medial_formats/encode_json.h"
#include "output/medial_formats/encode_npz.h"

namespace medial_vk {
namespace {

GlbLayout layout_of(const PointsEncoding& encoding) {
  if (encoding.mesh_spheres) return GlbLayout::kOneMesh;
  return encoding.gpu_instancing ? GlbLayout::kGpuInstances : GlbLayout::kNodes;
}

}  // namespace

Result<std::string> encode_points(const PointsEncoding& encoding, const MedialHeader& header,
                                  std::span<const MedialSphere> spheres, std::span<const std::uint8_t> marks) {
  switch (encoding.format) {
    case MedialFormat::kCsv:
      return encode_csv(header, spheres);
    case MedialFormat::kNpz:
      return encode_npz(header, spheres, marks);
    case MedialFormat::kJson:
      return encode_json(header, spheres, marks);
    case MedialFormat::kGlb:
      return encode_glb(header, spheres, layout_of(encoding), encoding.sphere_detail);
    case MedialFormat::kPly:
      break;
  }
  if (encoding.mesh_spheres) return encode_ball_mesh_ply(header, spheres, encoding.ascii, encoding.sphere_detail);
  return encode_ply(header, spheres, encoding.ascii);
}

}  // namespace medial_vk
