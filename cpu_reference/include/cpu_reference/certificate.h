// `--check`: the certificate of every output ball, recomputed from the written numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cpu_reference/extract.h"

namespace medial_vk::reference {

struct CertificateLine {
  std::string condition;  // a phrase for readers, e.g. "radius <= exact distance"
  std::uint64_t tested = 0;
  std::uint64_t failed = 0;
  double worst = 0;  // largest violation or smallest margin, depending on the unit
  std::string unit;
  std::string first_failure;  // "ball 17 at (x, y, z): ..." or empty
};

struct Certificate {
  std::vector<CertificateLine> lines;
  bool passed() const;
};

/// Tests the spheres of `result` against its grid, epsilon (length), object angle and radius threshold (length, 0:
/// off), all as written to the file.
Certificate check(const Mesh& mesh, const Result& result, double epsilon, double object_angle, double radius);

}  // namespace medial_vk::reference
