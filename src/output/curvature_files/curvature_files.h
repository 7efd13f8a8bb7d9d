// Curvatures at the tips of balls as bytes of files (docs/formats.md, "Curvatures").
#pragma once

#include <span>
#include <string>

#include "medial_vk/ball.h"
#include "medial_vk/curvature.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What is written: the balls and what is known of them, of equal numbers.
struct CurvatureTable {
  std::span<const Ball> balls;
  const BoundaryCurvature& curvature;
  CurvatureMethod method = CurvatureMethod::kFits;
};

/// "fits" or "source".
const char* name_of(CurvatureMethod method);

/// The end of the spoke; the centre where the spoke is not known.
Point tip_position(const Ball& ball, const TipCurvature& tip);

/// A line for each tip: two for each ball.
std::string encode_curvature_csv(const CurvatureTable& table);
/// A vertex for each tip.
std::string encode_curvature_ply(const CurvatureTable& table);
/// Error: kOutOfMemory.
Result<std::string> encode_curvature_npz(const CurvatureTable& table);
/// A point for each tip, with attributes; what is not known is 0. Error: kCannotWrite (too large for the format).
Result<std::string> encode_curvature_glb(const CurvatureTable& table);
/// An object for each ball; what is not known is null.
std::string encode_curvature_json(const CurvatureTable& table);

}  // namespace medial_vk
