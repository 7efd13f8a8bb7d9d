// The SPIR-V of all kernels, after optimisation: its size, on which the time depends that drivers take to compile it,
// and the values that leave its loops.
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "device/embedded_shaders.h"
#include "support/device/spirv_walk.h"

namespace medial_vk {
namespace {

using namespace test::spirv;  // the codes of instructions

struct Instruction {
  std::uint32_t opcode = 0;
  std::uint32_t result = 0;        // 0: none
  std::vector<std::uint32_t> ids;  // operands that are values or labels
};

using Block = std::vector<Instruction>;

/// The blocks of all functions; the build inlines nearly everything.
struct Module {
  std::size_t instructions = 0, calls = 0, switches = 0;
  std::map<std::uint32_t, Block> blocks;  // by label
};

spv_result_t add_instruction(void* data, const spv_parsed_instruction_t* parsed) {
  auto& [module, label] = *static_cast<std::pair<Module, std::uint32_t>*>(data);
  ++module.instructions;
  module.calls += parsed->opcode == kFunctionCall ? 1 : 0;
  module.switches += parsed->opcode == kSwitch ? 1 : 0;
  Instruction instruction{parsed->opcode, parsed->result_id, {}};
  for (std::uint16_t i = 0; i < parsed->num_operands; ++i) {
    const spv_parsed_operand_t& operand = parsed->operands[i];
    if (operand.type == SPV_OPERAND_TYPE_ID) instruction.ids.push_back(parsed->words[operand.offset]);
  }
  if (parsed->opcode == kLabel) label = parsed->result_id;
  if (label != 0) module.blocks[label].push_back(std::move(instruction));
  if (parsed->opcode == kFunctionEnd) label = 0;
  return SPV_SUCCESS;
}

Module read_module(const EmbeddedShader& shader) {
  const std::unique_ptr<spv_context_t, decltype(&spvContextDestroy)> context(spvContextCreate(SPV_ENV_VULKAN_1_2),
                                                                             spvContextDestroy);
  std::pair<Module, std::uint32_t> data;
  EXPECT_EQ(
      spvBinaryParse(context.get(), &data, shader.words.data(), shader.words.size(), nullptr, add_instruction, nullptr),
      SPV_SUCCESS);
  return std::move(data.first);
}

/// The labels that a block may go to: the last instruction names them, among values.
std::vector<std::uint32_t> successors(const Module& module, const Block& block) {
  std::vector<std::uint32_t> labels;
  const auto last =
      std::find_if(block.rbegin(), block.rend(), [](const Instruction& i) { return i.opcode != kFunctionEnd; });
  for (const std::uint32_t id : last->ids)
    if (module.blocks.contains(id)) labels.push_back(id);
  return labels;
}

/// The blocks of the loop that this block begins, with those from which its lanes return.
std::set<std::uint32_t> blocks_of_loop(const Module& module, std::uint32_t header, std::uint32_t merge) {
  std::set<std::uint32_t> body;
  std::vector<std::uint32_t> waiting = {header};
  while (!waiting.empty()) {
    const std::uint32_t label = waiting.back();
    waiting.pop_back();
    if (label == merge || !body.insert(label).second) continue;
    for (const std::uint32_t next : successors(module, module.blocks.at(label))) waiting.push_back(next);
  }
  return body;
}

bool depends_on_memory_or_path(std::uint32_t opcode) {
  return opcode == kLoad || opcode == kImageFetch || opcode == kPhi ||
         (opcode >= kFirstAtomic && opcode <= kLastAtomic) || (opcode >= kFirstSubgroup && opcode <= kLastSubgroup);
}

/// The values that leave a loop otherwise than through an OpPhi.
class LoopValues {
 public:
  LoopValues(const Module& module, std::uint32_t header, std::uint32_t merge)
      : module_(module), header_(header), body_(blocks_of_loop(module, header, merge)) {
    for (const std::uint32_t label : body_)
      for (const Instruction& i : module.blocks.at(label))
        if (i.result != 0) made_.emplace(i.result, std::pair(label, &i));
  }

  std::set<std::uint32_t> leaving() const {
    std::set<std::uint32_t> found;
    for (const auto& [label, block] : module_.blocks)
      for (const Instruction& i : block) add_uses(label, i, found);
    return found;
  }

 private:
  // An OpPhi uses its values in the blocks that they come from.
  void add_uses(std::uint32_t label, const Instruction& i, std::set<std::uint32_t>& found) const {
    for (std::size_t k = 0; k < i.ids.size(); ++k) {
      const std::uint32_t used_in = i.opcode == kPhi && k + 1 < i.ids.size() ? i.ids[k + 1] : label;
      if (!body_.contains(used_in) && is_lost(i.ids[k])) found.insert(i.ids[k]);
      k += i.opcode == kPhi ? 1 : 0;
    }
  }

  // Lanes that have left keep what the loop carries, and what is the same in every turn.
  bool is_lost(std::uint32_t id) const {
    const auto found = made_.find(id);
    if (found == made_.end()) return false;
    const auto& [label, instruction] = found->second;
    if (instruction->opcode == kLabel || (instruction->opcode == kPhi && label == header_)) return false;
    return !is_same_in_every_turn(id);
  }

  bool is_same_in_every_turn(std::uint32_t id) const {
    const auto found = made_.find(id);
    if (found == made_.end()) return true;
    const Instruction& i = *found->second.second;
    return !depends_on_memory_or_path(i.opcode) &&
           std::ranges::all_of(i.ids, [this](std::uint32_t operand) { return is_same_in_every_turn(operand); });
  }

  const Module& module_;
  std::uint32_t header_;
  std::set<std::uint32_t> body_;
  std::map<std::uint32_t, std::pair<std::uint32_t, const Instruction*>> made_;
};

// Software drivers run invocations as lanes of a vector, until the last one leaves a loop. Of a lane that has left
// before, they keep what an OpPhi of the loop's start or end holds (docs/reliability.md, "Values that leave a loop").
TEST(Programs, ValuesLeaveLoopsThroughPhis) {
  for (const EmbeddedShader& shader : embedded_shaders()) {
    // Lanes of a team leave together, and so do the eight of a subgroup.
    if (shader.name.starts_with("find_closest_in_packets") || shader.name.starts_with("follow_balls_lockstep") ||
        shader.name.starts_with("follow_again_lockstep")) {
      continue;
    }
    const Module module = read_module(shader);
    for (const auto& [label, block] : module.blocks) {
      for (const Instruction& i : block) {
        if (i.opcode != kLoopMerge) continue;
        const std::set<std::uint32_t> leaving = LoopValues(module, label, i.ids[0]).leaving();
        EXPECT_TRUE(leaving.empty()) << shader.name << ": " << leaving.size() << " values of the loop %" << label
                                     << ", the first %" << *leaving.begin();
      }
    }
  }
}

struct Budget {
  std::size_t bytes, instructions, longest_block;
};

// For a program; the first entry whose beginning its name has counts. Compilers take more than proportional time for
// long programs, and SwiftShader's for long blocks: minutes for mark_contacts with all loops unrolled.
Budget budget_of(std::string_view name) {
  static const std::pair<std::string_view, Budget> kBudgets[] = {
      {"judge_pairs_lockstep_with", {84'000, 4'700, 120}},
      {"judge_pairs", {134'000, 7'600, 120}},
      {"mark_contacts_lockstep", {88'000, 4'500, 310}},  // unrolled for lavapipe
      {"measure_balls", {88'000, 5'000, 150}},
      {"mark_samples", {30'000, 1'500, 610}},
      {"", {49'000, 2'550, 310}}};
  return std::ranges::find_if(kBudgets, [name](const auto& entry) { return name.starts_with(entry.first); })->second;
}

TEST(Programs, AreSmall) {
  for (const EmbeddedShader& shader : embedded_shaders()) {
    const Module module = read_module(shader);
    const Budget budget = budget_of(shader.name);
    std::size_t longest = 0;
    for (const auto& [label, block] : module.blocks) longest = std::max(longest, block.size());
    EXPECT_LE(shader.words.size_bytes(), budget.bytes) << shader.name;
    EXPECT_LE(module.instructions, budget.instructions) << shader.name;
    EXPECT_LE(longest, budget.longest_block) << shader.name;
  }
}

// NVIDIA's compiler crashes on the switches that merge returns in this program (docs/decisions.md, "Early returns").
TEST(Programs, ReturnsInPairsAreNotMergedForGpus) {
  std::size_t tested = 0;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (!shader.name.starts_with("judge_pairs") || shader.name.starts_with("judge_pairs_lockstep")) continue;
    const Module module = read_module(shader);
    EXPECT_GT(module.calls, 0u) << shader.name;
    EXPECT_EQ(module.switches, 0u) << shader.name;
    ++tested;
  }
  EXPECT_EQ(tested, 2u);
}

}  // namespace
}  // namespace medial_vk
