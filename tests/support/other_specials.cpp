#include "support/other_specials.h"

#include <array>
#include <bit>

namespace medial_vk::test {
namespace {

// Numbers from the SPIR-V specification, version 1.5.
enum Code : std::uint32_t {
  kExtInst = 12,
  kTypeBool = 20,
  kTypeInt = 21,
  kTypeFloat = 22,
  kTypeVector = 23,
  kConstant = 43,
  kConstantComposite = 44,
  kFunction = 54,
  kBitcast = 124,
  kFNegate = 127,
  kFAdd = 129,
  kFSub = 131,
  kFMul = 133,
  kFDiv = 136,
  kFRem = 140,
  kFMod = 141,
  kVectorTimesScalar = 142,
  kVectorTimesMatrix = 144,
  kMatrixTimesVector = 145,
  kDot = 148,
  kSelect = 169,
  kIEqual = 170,
  kBitwiseAnd = 199
};
constexpr std::size_t kHeaderWords = 5, kBoundWord = 3;
constexpr std::uint32_t kExponent = 0x7f800000u;  // bits of a float; all set: infinity or NaN, none: zero or denormal

bool is_arithmetic(std::uint32_t code) {
  switch (code) {
    case kExtInst:
    case kFNegate:
    case kFAdd:
    case kFSub:
    case kFMul:
    case kFDiv:
    case kFRem:
    case kFMod:
    case kVectorTimesScalar:
    case kVectorTimesMatrix:
    case kMatrixTimesVector:
    case kDot:
      return true;
    default:
      return false;
  }
}

/// Names of the types, and of the constants, for numbers (0) and for vectors of two to four (by their length less 1).
struct Shape {
  std::uint32_t real = 0, bits = 0, truth = 0;  // types
  std::uint32_t exponent = 0, none = 0, zero = 0, special = 0;
};

class Replacer {
 public:
  Replacer(std::span<const std::uint32_t> words, const OtherSpecials& specials)
      : words_(words), specials_(specials), bound_(words[kBoundWord]) {}

  std::vector<std::uint32_t> run() {
    for (std::size_t at = kHeaderWords; at < words_.size(); at += words_[at] >> 16) note_type(words_.subspan(at));
    out_.assign(words_.begin(), words_.begin() + kHeaderWords);
    for (std::size_t at = kHeaderWords; at < words_.size(); at += words_[at] >> 16)
      rewrite(words_.subspan(at, words_[at] >> 16));
    out_[kBoundWord] = bound_;
    return out_;
  }

 private:
  /// Types may be there once only.
  void note_type(std::span<const std::uint32_t> words) {
    const std::uint32_t code = words[0] & 0xffffu;
    if (code == kTypeFloat) shapes_[0].real = words[1];
    if (code == kTypeBool) shapes_[0].truth = words[1];
    if (code == kTypeInt && words[2] == 32 && words[3] == 0) shapes_[0].bits = words[1];
    if (code != kTypeVector) return;
    Shape& shape = shapes_[words[3] - 1];
    if (words[2] == shapes_[0].real) shape.real = words[1];
    if (words[2] == shapes_[0].bits) shape.bits = words[1];
    if (words[2] == shapes_[0].truth) shape.truth = words[1];
  }

  void rewrite(std::span<const std::uint32_t> instruction) {
    const std::uint32_t code = instruction[0] & 0xffffu;
    if (code == kFunction && !declared_) declare();
    const std::size_t begin = out_.size();
    out_.insert(out_.end(), instruction.begin(), instruction.end());
    if (!is_arithmetic(code)) return;
    for (const Shape& shape : shapes_) {
      if (shape.real == 0 || instruction[1] != shape.real) continue;
      // The result gets a new name, and what replaces it the old one.
      out_[begin + 2] = bound_++;
      replace(shape, out_[begin + 2], instruction[2]);
    }
  }

  void replace(const Shape& shape, std::uint32_t result, std::uint32_t replacement) {
    const std::uint32_t bits = emit(kBitcast, shape.bits, {result});
    const std::uint32_t exponent = emit(kBitwiseAnd, shape.bits, {bits, shape.exponent});
    const std::uint32_t is_zero = emit(kIEqual, shape.truth, {exponent, shape.none});
    const std::uint32_t is_special = emit(kIEqual, shape.truth, {exponent, shape.exponent});
    const std::uint32_t or_zero = emit(kSelect, shape.bits, {is_zero, shape.zero, bits});
    const std::uint32_t chosen = emit(kSelect, shape.bits, {is_special, shape.special, or_zero});
    out_.insert(out_.end(), {4u << 16 | kBitcast, shape.real, replacement, chosen});
  }

  /// The types that are missing and all constants, behind those of the module.
  void declare() {
    declared_ = true;
    if (shapes_[0].real == 0) return;
    Shape& number = shapes_[0];
    if (number.bits == 0) add({number.bits = bound_++, 32, 0}, kTypeInt);
    if (number.truth == 0) add({number.truth = bound_++}, kTypeBool);
    number.exponent = emit(kConstant, number.bits, {kExponent});
    number.none = emit(kConstant, number.bits, {0});
    number.zero = emit(kConstant, number.bits, {std::bit_cast<std::uint32_t>(specials_.zero)});
    number.special = emit(kConstant, number.bits, {std::bit_cast<std::uint32_t>(specials_.special)});
    for (std::uint32_t length = 2; length <= 4; ++length) {
      Shape& shape = shapes_[length - 1];
      if (shape.real == 0) continue;
      if (shape.bits == 0) add({shape.bits = bound_++, number.bits, length}, kTypeVector);
      if (shape.truth == 0) add({shape.truth = bound_++, number.truth, length}, kTypeVector);
      const auto repeat = [&](std::uint32_t constant) {
        return emit(kConstantComposite, shape.bits, std::vector<std::uint32_t>(length, constant));
      };
      shape.exponent = repeat(number.exponent);
      shape.none = repeat(number.none);
      shape.zero = repeat(number.zero);
      shape.special = repeat(number.special);
    }
  }

  void add(const std::vector<std::uint32_t>& operands, std::uint32_t code) {
    out_.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | code);
    out_.insert(out_.end(), operands.begin(), operands.end());
  }

  /// An instruction with a result of that type; returns its name.
  std::uint32_t emit(std::uint32_t code, std::uint32_t type, std::vector<std::uint32_t> operands) {
    const std::uint32_t name = bound_++;
    operands.insert(operands.begin(), {type, name});
    add(operands, code);
    return name;
  }

  std::span<const std::uint32_t> words_;
  OtherSpecials specials_;
  std::uint32_t bound_;
  std::array<Shape, 4> shapes_;
  bool declared_ = false;
  std::vector<std::uint32_t> out_;
};

}  // namespace

std::vector<std::uint32_t> replace_specials(std::span<const std::uint32_t> words, const OtherSpecials& specials) {
  return Replacer(words, specials).run();
}

}  // namespace medial_vk::test
