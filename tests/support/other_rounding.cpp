#include "support/other_rounding.h"

#include <bit>
#include <map>

#include "support/device/spirv_walk.h"

namespace medial_vk::test {
namespace {

// Numbers from the specification of GLSL.std.450.
enum Extended : std::uint32_t {
  kSin = 13,
  kCos = 14,
  kAsin = 16,
  kAcos = 17,
  kAtan = 18,
  kAtan2 = 25,
  kSqrt = 31,
  kInverseSqrt = 32,
  kLength = 66,
  kDistance = 67,
  kNormalize = 69
};

float share_of_extended(std::uint32_t instruction, const OtherRounding& rounding) {
  switch (instruction) {
    case kSin:
    case kCos:
    case kAsin:
    case kAcos:
    case kAtan:
    case kAtan2:
      return rounding.trigonometry;
    case kSqrt:
    case kInverseSqrt:
    case kLength:
    case kDistance:
    case kNormalize:
      return rounding.root;
    default:
      return 0;
  }
}

class Rewriter {
 public:
  Rewriter(std::span<const std::uint32_t> words, const OtherRounding& rounding)
      : words_(words), rounding_(rounding), out_(words) {}

  std::vector<std::uint32_t> run() {
    spirv::for_each_instruction(words_, [this](std::uint32_t code, auto instruction) { rewrite(code, instruction); });
    return out_.take();
  }

 private:
  void rewrite(std::uint32_t code, std::span<const std::uint32_t> instruction) {
    const float share = code == spirv::kFDiv      ? rounding_.division
                        : code == spirv::kExtInst ? share_of_extended(instruction[4], rounding_)
                                                  : 0;
    if (share != 0) return multiply(instruction, factors_.at(share));
    out_.copy(instruction);
    if (code == spirv::kTypeFloat) add_factors(instruction[1]);
    if (code == spirv::kTypeVector && instruction[2] == float_type_) is_vector_[instruction[1]] = true;
  }

  /// The result gets a new name, and its product the old one.
  void multiply(std::span<const std::uint32_t> instruction, std::uint32_t factor) {
    const std::uint32_t type = instruction[1], product = instruction[2], result = out_.copy_renamed(instruction);
    out_.add(is_vector_.contains(type) ? spirv::kVectorTimesScalar : spirv::kFMul, {type, product, result, factor});
  }

  // Constants, next to the type that they need.
  void add_factors(std::uint32_t type) {
    float_type_ = type;
    for (const float share : {rounding_.division, rounding_.root, rounding_.trigonometry}) {
      if (share == 0 || factors_.contains(share)) continue;
      factors_[share] = out_.emit(spirv::kConstant, type, {std::bit_cast<std::uint32_t>(1 + share)});
    }
  }

  std::span<const std::uint32_t> words_;
  OtherRounding rounding_;
  std::uint32_t float_type_ = 0;
  std::map<float, std::uint32_t> factors_;  // names of constants
  std::map<std::uint32_t, bool> is_vector_;
  spirv::Writer out_;
};

}  // namespace

std::vector<std::uint32_t> round_otherwise(std::span<const std::uint32_t> words, const OtherRounding& rounding) {
  return Rewriter(words, rounding).run();
}

}  // namespace medial_vk::test
