#include "support/other_specials.h"

#include <algorithm>
#include <array>
#include <bit>

#include "support/device/spirv_walk.h"

namespace medial_vk::test {
namespace {

constexpr std::uint32_t kExponent = 0x7f800000u;  // bits of a float; all set: infinity or NaN, none: zero or denormal

bool is_arithmetic(std::uint32_t code) {
  switch (code) {
    case spirv::kExtInst:
    case spirv::kFNegate:
    case spirv::kFAdd:
    case spirv::kFSub:
    case spirv::kFMul:
    case spirv::kFDiv:
    case spirv::kFRem:
    case spirv::kFMod:
    case spirv::kVectorTimesScalar:
    case spirv::kVectorTimesMatrix:
    case spirv::kMatrixTimesVector:
    case spirv::kDot:
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
      : words_(words), specials_(specials), out_(words) {}

  std::vector<std::uint32_t> run() {
    spirv::for_each_instruction(words_, [this](std::uint32_t code, auto words) { note_type(code, words); });
    spirv::for_each_instruction(words_, [this](std::uint32_t code, auto instruction) { rewrite(code, instruction); });
    return out_.take();
  }

 private:
  /// A type may be declared only once.
  void note_type(std::uint32_t code, std::span<const std::uint32_t> words) {
    if (code == spirv::kTypeFloat) shapes_[0].real = words[1];
    if (code == spirv::kTypeBool) shapes_[0].truth = words[1];
    if (code == spirv::kTypeInt && words[2] == 32 && words[3] == 0) shapes_[0].bits = words[1];
    if (code != spirv::kTypeVector) return;
    Shape& shape = shapes_[words[3] - 1];
    if (words[2] == shapes_[0].real) shape.real = words[1];
    if (words[2] == shapes_[0].bits) shape.bits = words[1];
    if (words[2] == shapes_[0].truth) shape.truth = words[1];
  }

  void rewrite(std::uint32_t code, std::span<const std::uint32_t> instruction) {
    if (code == spirv::kFunction && !declared_) declare();
    const Shape* shape = is_arithmetic(code) ? shape_of(instruction[1]) : nullptr;
    if (shape == nullptr) return out_.copy(instruction);
    // The result gets a new name, and its replacement the old one.
    replace(*shape, out_.copy_renamed(instruction), instruction[2]);
  }

  /// The names for numbers or vectors of that type; null for other types.
  const Shape* shape_of(std::uint32_t type) const {
    const auto found = std::ranges::find(shapes_, type, &Shape::real);
    return found == shapes_.end() ? nullptr : &*found;
  }

  void replace(const Shape& shape, std::uint32_t result, std::uint32_t replacement) {
    const std::uint32_t bits = out_.emit(spirv::kBitcast, shape.bits, {result});
    const std::uint32_t exponent = out_.emit(spirv::kBitwiseAnd, shape.bits, {bits, shape.exponent});
    const std::uint32_t is_zero = out_.emit(spirv::kIEqual, shape.truth, {exponent, shape.none});
    const std::uint32_t is_special = out_.emit(spirv::kIEqual, shape.truth, {exponent, shape.exponent});
    const std::uint32_t or_zero = out_.emit(spirv::kSelect, shape.bits, {is_zero, shape.zero, bits});
    const std::uint32_t chosen = out_.emit(spirv::kSelect, shape.bits, {is_special, shape.special, or_zero});
    out_.add(spirv::kBitcast, {shape.real, replacement, chosen});
  }

  /// The types that are missing and all constants, behind those of the module.
  void declare() {
    declared_ = true;
    if (shapes_[0].real == 0) return;
    Shape& number = shapes_[0];
    if (number.bits == 0) out_.add(spirv::kTypeInt, {number.bits = out_.new_name(), 32, 0});
    if (number.truth == 0) out_.add(spirv::kTypeBool, {number.truth = out_.new_name()});
    number.exponent = out_.emit(spirv::kConstant, number.bits, {kExponent});
    number.none = out_.emit(spirv::kConstant, number.bits, {0});
    number.zero = out_.emit(spirv::kConstant, number.bits, {std::bit_cast<std::uint32_t>(specials_.zero)});
    number.special = out_.emit(spirv::kConstant, number.bits, {std::bit_cast<std::uint32_t>(specials_.special)});
    for (std::uint32_t length = 2; length <= 4; ++length) {
      Shape& shape = shapes_[length - 1];
      if (shape.real == 0) continue;
      if (shape.bits == 0) out_.add(spirv::kTypeVector, {shape.bits = out_.new_name(), number.bits, length});
      if (shape.truth == 0) out_.add(spirv::kTypeVector, {shape.truth = out_.new_name(), number.truth, length});
      const auto repeat = [&](std::uint32_t constant) {
        return out_.emit(spirv::kConstantComposite, shape.bits, std::vector<std::uint32_t>(length, constant));
      };
      shape.exponent = repeat(number.exponent);
      shape.none = repeat(number.none);
      shape.zero = repeat(number.zero);
      shape.special = repeat(number.special);
    }
  }

  std::span<const std::uint32_t> words_;
  OtherSpecials specials_;
  std::array<Shape, 4> shapes_;
  bool declared_ = false;
  spirv::Writer out_;
};

}  // namespace

std::vector<std::uint32_t> replace_specials(std::span<const std::uint32_t> words, const OtherSpecials& specials) {
  return Replacer(words, specials).run();
}

}  // namespace medial_vk::test
