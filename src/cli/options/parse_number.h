// Strict numbers for the command line: the whole text must be a number and lie in its range.
#pragma once

#include <cstdint>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// An allowed range with its unit, for messages: "between 1 and 4096 voxels".
struct RealRange {
  double least = 0;
  double greatest = 0;
  bool ends_included = true;
};

/// "2.5", in units of the input, or "3%", of its longest side.
struct Length {
  double value = 0;  ///< A length, or a share: 0.03.
  bool is_share = false;

  double of(double longest_side) const { return is_share ? value * longest_side : value; }
  bool operator==(const Length&) const = default;
};

/// Errors of all functions: kUsage with the text and the range.
Result<double> parse_real(const std::string& text, const RealRange& range, const char* unit);
/// Lengths up to `greatest`, or up to 1000 %. `unit`: " (units of the mesh)".
Result<Length> parse_length(const std::string& text, double greatest, const char* unit);
Result<std::uint64_t> parse_whole(const std::string& text, std::uint64_t least, std::uint64_t greatest,
                                  const char* unit);
/// MiB, or with one of the suffixes K, M, G, T (powers of 1024; "MiB" and "MB" count as M). The result is in bytes.
Result<std::uint64_t> parse_memory(const std::string& text);

}  // namespace medial_vk::cli
