// The kernels of the library, rewritten.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "device/embedded_shaders.h"

namespace medial_vk::test {

using Rewrite = std::function<std::vector<std::uint32_t>(std::span<const std::uint32_t>)>;

/// All kernels of the library, rewritten: the `extra_shaders` of a context, which must not outlive them.
class OtherKernels {
 public:
  explicit OtherKernels(const Rewrite& rewrite) {
    for (const EmbeddedShader& shader : embedded_shaders()) words_.push_back(rewrite(shader.words));
    for (std::size_t i = 0; i < words_.size(); ++i) shaders_.push_back({embedded_shaders()[i].name, words_[i]});
  }
  OtherKernels(const OtherKernels&) = delete;
  OtherKernels& operator=(const OtherKernels&) = delete;
  std::span<const EmbeddedShader> shaders() const { return shaders_; }

 private:
  std::vector<std::vector<std::uint32_t>> words_;
  std::vector<EmbeddedShader> shaders_;
};

}  // namespace medial_vk::test
