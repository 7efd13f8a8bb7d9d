// SPIR-V modules, read and written instruction by instruction (SPIR-V 1.5, sections 2.3 and 3.37): a header of five
// words, then instructions, the first word of each its length << 16 | its code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace medial_vk::test::spirv {

constexpr std::size_t kHeaderWords = 5, kBoundWord = 3;  // every name is below the bound

enum Code : std::uint32_t {
  kName = 5,
  kMemberName = 6,
  kExtInst = 12,
  kTypeBool = 20,
  kTypeInt = 21,
  kTypeFloat = 22,
  kTypeVector = 23,
  kTypeArray = 28,
  kTypeRuntimeArray = 29,
  kTypeStruct = 30,
  kTypePointer = 32,
  kConstant = 43,
  kConstantComposite = 44,
  kSpecConstant = 50,
  kFunction = 54,
  kFunctionEnd = 56,
  kFunctionCall = 57,
  kVariable = 59,
  kLoad = 61,
  kDecorate = 71,
  kMemberDecorate = 72,
  kImageFetch = 95,
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
  kBitwiseAnd = 199,
  kFirstAtomic = 227,  // atomics and those of subgroups: the first and the last
  kLastAtomic = 242,
  kPhi = 245,
  kLoopMerge = 246,
  kLabel = 248,
  kSwitch = 251,
  kFirstSubgroup = 333,
  kLastSubgroup = 366
};

/// Calls `visit(code, words)` for every instruction, up to one that does not fit into the module; `words` begin with
/// the one that holds the code.
template <class Visit>
void for_each_instruction(std::span<const std::uint32_t> module, const Visit& visit) {
  for (std::size_t at = kHeaderWords; at < module.size();) {
    const std::uint32_t length = module[at] >> 16;
    if (length == 0 || length > module.size() - at) return;
    visit(module[at] & 0xffffu, module.subspan(at, length));
    at += length;
  }
}

/// Writes a module that begins with the header of another one.
class Writer {
 public:
  explicit Writer(std::span<const std::uint32_t> module)
      : words_(module.begin(), module.begin() + static_cast<std::ptrdiff_t>(kHeaderWords)) {}

  std::uint32_t new_name() { return words_[kBoundWord]++; }
  void copy(std::span<const std::uint32_t> instruction) {
    words_.insert(words_.end(), instruction.begin(), instruction.end());
  }
  /// With a new name for its result, which is returned: the next instruction may give the old name to another result.
  std::uint32_t copy_renamed(std::span<const std::uint32_t> instruction) {
    const std::size_t begin = words_.size();
    copy(instruction);
    return words_[begin + 2] = new_name();
  }
  void add(std::uint32_t code, const std::vector<std::uint32_t>& operands) {
    words_.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | code);
    words_.insert(words_.end(), operands.begin(), operands.end());
  }
  /// An instruction with a result of that type; returns its new name.
  std::uint32_t emit(std::uint32_t code, std::uint32_t type, std::vector<std::uint32_t> operands) {
    const std::uint32_t name = new_name();
    operands.insert(operands.begin(), {type, name});
    add(code, operands);
    return name;
  }
  std::vector<std::uint32_t> take() { return std::move(words_); }

 private:
  std::vector<std::uint32_t> words_;
};

}  // namespace medial_vk::test::spirv
