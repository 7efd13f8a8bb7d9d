// Draws the panels of a picture on a Vulkan device: layers of samples (the wall in front, the wall behind, the marks
// between them), then one pass that lights and averages them. Tiles keep memory independent of the size of the picture.
#pragma once

#include <cstdint>
#include <memory>

#include "medial_vk/context.h"
#include "medial_vk/result.h"
#include "output/picture/panels/panel.h"
#include "output/picture/vulkan/functions.h"

namespace medial_vk::picture {

struct PainterOptions {
  std::uint32_t samples = 0;                   ///< Per pixel and side; 0: 2 on a CPU device, else 4.
  bool validation = false;                     ///< With the validation layer; its messages are printed and counted.
  PFN_vkGetInstanceProcAddr loader = nullptr;  ///< Null: that of libvulkan.so.1.
};

class DevicePainter {
 public:
  /// Error: kNoDevice, with the reason why the device cannot draw.
  static Result<DevicePainter> open(const DeviceDescription& device, const PainterOptions& options = {});
  DevicePainter(DevicePainter&&) noexcept;
  ~DevicePainter();

  /// Draws all panels, without the legend. Error: kNoDevice.
  Status draw(const Scene& scene, std::span<const Panel> panels, const PictureView& view, Picture& picture);

  std::uint32_t samples() const;  ///< Per pixel and side.
  std::uint64_t validation_messages() const;

 private:
  class Impl;
  explicit DevicePainter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk::picture
