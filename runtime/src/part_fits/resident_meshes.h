#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "medial_vk/extraction.h"

namespace medial_vk {

/// Extractors for several meshes in turn, each of which keeps its mesh on the device: a mesh is uploaded once, as long
/// as the memory of the device suffices for all of them. For one thread at a time.
class ResidentMeshes {
 public:
  /// `make` gives an extractor that keeps the last mesh on the device, such as device_extractor().
  explicit ResidentMeshes(std::function<Extractor()> make) : make_(std::move(make)) {}

  /// An extractor for one mesh, which stays on the device until the extractor is destroyed. If memory does not suffice,
  /// all other meshes leave the device, and the extraction is repeated. This object outlives it. Throws std::bad_alloc,
  /// as do calls of the result.
  Extractor extractor();

 private:
  bool release_all_but(const Extractor& kept);

  std::function<Extractor()> make_;
  std::vector<std::weak_ptr<Extractor>> extractors_;  // empty functions: their meshes are not on the device
};

}  // namespace medial_vk
