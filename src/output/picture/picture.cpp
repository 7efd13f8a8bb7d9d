#include "output/picture/picture.h"

#include <fmt/format.h>

#include "output/picture/panels/panel.h"
#include "output/picture/panels/scene.h"
#include "output/picture/vulkan/device_painter.h"

namespace medial_vk {
namespace {

using picture::Panel;

/// Error: kNoDevice, with the reason why it cannot draw.
Result<DrawnPicture> draw_on_device(const picture::Scene& scene, const PictureOptions& options,
                                    const DeviceDescription& device) {
  Result<picture::DevicePainter> painter = picture::DevicePainter::open(device);
  if (!painter) return painter.error();
  Picture out = picture::blank(options);
  if (Status drawn = painter.value().draw(scene, picture::panels_of(options.show, out.width), options.view, out);
      !drawn) {
    return drawn.error();
  }
  draw_legend(scene, out);
  const std::uint32_t samples = painter.value().samples();
  return DrawnPicture{std::move(out), fmt::format("{}, {} samples per pixel", device.name, samples * samples)};
}

Picture draw_on_cpu(const picture::Scene& scene, const PictureOptions& options) {
  Picture out = picture::blank(options);
  for (const Panel& panel : picture::panels_of(options.show, out.width)) {
    draw_panel(scene, panel, options.view, out);
  }
  draw_legend(scene, out);
  return out;
}

}  // namespace

Picture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                     const PictureOptions& options) {
  return draw_on_cpu(picture::make_scene(mesh, spheres, voxel_size, options), options);
}

DrawnPicture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                          const PictureOptions& options, const DeviceDescription* device) {
  const picture::Scene scene = picture::make_scene(mesh, spheres, voxel_size, options);
  if (device == nullptr) return {draw_on_cpu(scene, options), "the CPU"};
  Result<DrawnPicture> drawn = draw_on_device(scene, options, *device);
  if (drawn) return std::move(drawn).value();
  return {draw_on_cpu(scene, options), "the CPU: " + drawn.error().message};
}

}  // namespace medial_vk
