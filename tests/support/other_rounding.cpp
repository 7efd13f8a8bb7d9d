#include "support/other_rounding.h"

#include <bit>
#include <map>

namespace medial_vk::test {
namespace {

// Numbers from the SPIR-V specification, version 1.5, and from that of GLSL.std.450.
constexpr std::uint32_t kHeaderWords = 5, kBoundWord = 3;
constexpr std::uint32_t kExtInst = 12, kTypeFloat = 22, kTypeVector = 23, kConstant = 43, kFMul = 133, kFDiv = 136,
                        kVectorTimesScalar = 142;
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
      : words_(words), rounding_(rounding), bound_(words[kBoundWord]) {}

  std::vector<std::uint32_t> run() {
    out_.assign(words_.begin(), words_.begin() + kHeaderWords);
    for (std::size_t at = kHeaderWords; at < words_.size(); at += words_[at] >> 16)
      rewrite(words_.subspan(at, words_[at] >> 16));
    out_[kBoundWord] = bound_;
    return out_;
  }

 private:
  void rewrite(std::span<const std::uint32_t> instruction) {
    const std::uint32_t code = instruction[0] & 0xffffu;
    const float share = code == kFDiv      ? rounding_.division
                        : code == kExtInst ? share_of_extended(instruction[4], rounding_)
                                           : 0;
    const std::size_t begin = out_.size();
    out_.insert(out_.end(), instruction.begin(), instruction.end());
    if (code == kTypeFloat) add_factors(instruction[1]);
    if (code == kTypeVector && instruction[2] == float_type_) is_vector_[instruction[1]] = true;
    if (share == 0) return;
    // The result gets a new name, and its product the old one.
    const std::uint32_t type = instruction[1], product = instruction[2], result = bound_++;
    out_[begin + 2] = result;
    const std::uint32_t multiply = is_vector_.contains(type) ? kVectorTimesScalar : kFMul;
    out_.insert(out_.end(), {5u << 16 | multiply, type, product, result, factors_.at(share)});
  }

  // Constants, next to the type that they need.
  void add_factors(std::uint32_t type) {
    float_type_ = type;
    for (const float share : {rounding_.division, rounding_.root, rounding_.trigonometry}) {
      if (share == 0 || factors_.contains(share)) continue;
      factors_[share] = bound_;
      out_.insert(out_.end(), {4u << 16 | kConstant, type, bound_++, std::bit_cast<std::uint32_t>(1 + share)});
    }
  }

  std::span<const std::uint32_t> words_;
  OtherRounding rounding_;
  std::uint32_t bound_, float_type_ = 0;
  std::map<float, std::uint32_t> factors_;  // names of constants
  std::map<std::uint32_t, bool> is_vector_;
  std::vector<std::uint32_t> out_;
};

}  // namespace

std::vector<std::uint32_t> round_otherwise(std::span<const std::uint32_t> words, const OtherRounding& rounding) {
  return Rewriter(words, rounding).run();
}

}  // namespace medial_vk::test
