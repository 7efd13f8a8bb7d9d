// Closest points by Embree 3 (rtcPointQuery), the peer of bench/queries/queries.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

class EmbreePeer {
 public:
  EmbreePeer(const Mesh& mesh, unsigned threads);
  ~EmbreePeer();
  EmbreePeer(const EmbreePeer&) = delete;
  EmbreePeer& operator=(const EmbreePeer&) = delete;

  /// Distances to the nearest point of the mesh; queries are xyz in float.
  void distances(std::span<const std::array<float, 3>> queries, std::span<float> out);

  /// Empty if the program was built without Embree.
  static std::string version();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk::bench
