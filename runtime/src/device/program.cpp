#include "device/program.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "device/context_impl.h"

namespace medial_vk {
namespace {

const EmbeddedShader* find_shader(std::span<const EmbeddedShader> shaders, const std::string& name) {
  const auto found = std::find_if(shaders.begin(), shaders.end(),
                                  [&name](const EmbeddedShader& shader) { return shader.name == name; });
  return found != shaders.end() ? &*found : nullptr;
}

Error shader_error(const ProgramKey& key, const std::string& what) {
  return {ErrorCode::kInternal, "shader " + key.shader + " " + what};
}

Error at_most(const ProgramKey& key, const std::string& what, std::uint64_t wanted, std::uint64_t limit) {
  return shader_error(
      key, "needs " + std::to_string(wanted) + " " + what + ", the device has at most " + std::to_string(limit));
}

Status check_limits(const VkPhysicalDeviceLimits& limits, const ProgramKey& key) {
  if (key.storage_buffers > limits.maxPerStageDescriptorStorageBuffers) {
    return at_most(key, "storage buffers", key.storage_buffers, limits.maxPerStageDescriptorStorageBuffers);
  }
  if (key.texel_buffers > limits.maxPerStageDescriptorSampledImages) {
    return at_most(key, "texel buffers", key.texel_buffers, limits.maxPerStageDescriptorSampledImages);
  }
  if (key.storage_buffers + key.texel_buffers > limits.maxPerStageResources) {
    return at_most(key, "buffers in all", key.storage_buffers + key.texel_buffers, limits.maxPerStageResources);
  }
  if (key.push_constant_bytes > limits.maxPushConstantsSize) {
    return at_most(key, "bytes of push constants", key.push_constant_bytes, limits.maxPushConstantsSize);
  }
  const std::uint32_t group = std::min(limits.maxComputeWorkGroupSize[0], limits.maxComputeWorkGroupInvocations);
  if (key.workgroup_size > group) return at_most(key, "invocations in a workgroup", key.workgroup_size, group);
  if (key.workgroup_size == 0) return shader_error(key, "has a workgroup size of 0");
  if (key.push_constant_bytes % 4 != 0) return shader_error(key, "has push constants that are not whole words");
  return {};
}

VkResult create_set_layout(const ContextImpl& context, Program& program) {
  std::vector<VkDescriptorSetLayoutBinding> bindings(program.key.storage_buffers + program.key.texel_buffers);
  for (std::uint32_t i = 0; i < bindings.size(); ++i) {
    bindings[i].binding = i;
    bindings[i].descriptorType =
        i < program.key.storage_buffers ? VK_DESCRIPTOR_TYPE_STORAGE_BUFFER : VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    bindings[i].descriptorCount = 1;
    bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
  }
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  return context.vk.vkCreateDescriptorSetLayout(context.device, &info, context.allocation_callbacks,
                                                &program.set_layout);
}

VkResult create_layout(const ContextImpl& context, Program& program) {
  VkPushConstantRange range{};
  range.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
  range.size = program.key.push_constant_bytes;
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &program.set_layout;
  info.pushConstantRangeCount = range.size > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  return context.vk.vkCreatePipelineLayout(context.device, &info, context.allocation_callbacks, &program.layout);
}

VkResult create_pipeline(const ContextImpl& context, VkPipelineCache cache, VkShaderModule module, Program& program) {
  // Constant 0 is the workgroup size, the caller's follow. Those that a shader does not declare are ignored.
  std::vector<std::uint32_t> values = {program.key.workgroup_size};
  values.insert(values.end(), program.key.constants.begin(), program.key.constants.end());
  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < values.size(); ++i) entries.push_back({i, i * 4u, 4u});
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<std::uint32_t>(entries.size());
  specialization.pMapEntries = entries.data();
  specialization.dataSize = values.size() * sizeof(std::uint32_t);
  specialization.pData = values.data();

  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = program.layout;
  return context.vk.vkCreateComputePipelines(context.device, cache, 1, &info, context.allocation_callbacks,
                                             &program.pipeline);
}

/// Fills the handles of `program`; on error some of them may be set.
Status make_program(const ContextImpl& context, VkPipelineCache cache, const EmbeddedShader& shader, Program& program) {
  const auto failed = [&program](const char* call, VkResult result) {
    Error error = vulkan_error(call, result);
    error.message = "shader " + program.key.shader + ": " + error.message;
    return error;
  };
  VkResult result = create_set_layout(context, program);
  if (result != VK_SUCCESS) return failed("vkCreateDescriptorSetLayout", result);
  result = create_layout(context, program);
  if (result != VK_SUCCESS) return failed("vkCreatePipelineLayout", result);

  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = shader.words.size_bytes();
  module_info.pCode = shader.words.data();
  VkShaderModule module = VK_NULL_HANDLE;
  result = context.vk.vkCreateShaderModule(context.device, &module_info, context.allocation_callbacks, &module);
  if (result != VK_SUCCESS) return failed("vkCreateShaderModule", result);
  const auto destroy = [&context](VkShaderModule* made) {  // also without host memory for the pipeline's tables
    context.vk.vkDestroyShaderModule(context.device, *made, context.allocation_callbacks);
  };
  const std::unique_ptr<VkShaderModule, decltype(destroy)> owner(&module, destroy);
  result = create_pipeline(context, cache, module, program);
  if (result != VK_SUCCESS) return failed("vkCreateComputePipelines", result);
  return {};
}

/// Reports the programs of a call one by one, whether or not they succeed; the last report is of all, even if the call
/// ends by an exception.
class ProgramsReport {
 public:
  ProgramsReport(const ProgramsProgress& progress, std::size_t total) : progress_(progress), total_(total) {
    if (progress_) progress_(0, total_);
  }
  ProgramsReport(const ProgramsReport&) = delete;
  ProgramsReport& operator=(const ProgramsReport&) = delete;
  ~ProgramsReport() {
    if (progress_ && made_ < total_) progress_(total_, total_);
  }
  void add_one() {
    const std::scoped_lock lock(mutex_);
    ++made_;
    if (progress_) progress_(made_, total_);
  }

 private:
  const ProgramsProgress progress_;
  std::mutex mutex_;
  std::size_t total_, made_ = 0;
};

}  // namespace

void ProgramDeleter::operator()(Program* program) const {
  vk->vkDestroyPipeline(device, program->pipeline, allocation_callbacks);
  vk->vkDestroyPipelineLayout(device, program->layout, allocation_callbacks);
  vk->vkDestroyDescriptorSetLayout(device, program->set_layout, allocation_callbacks);
  delete program;
}

const EmbeddedShader* Context::Impl::shader(const ProgramKey& key) const {
  // With its constants set by the build, or to be set by the driver.
  std::string frozen = key.shader + "_with_" + std::to_string(key.workgroup_size);
  for (const std::uint32_t value : key.constants) frozen += "_" + std::to_string(value);
  for (const std::span<const EmbeddedShader> shaders : {extra_shaders, embedded_shaders()}) {
    for (const std::string& name : {frozen, key.shader}) {
      if (const EmbeddedShader* found = find_shader(shaders, name); found != nullptr) return found;
    }
  }
  return nullptr;
}

Result<OwnedProgram> Context::Impl::build_program(const ProgramKey& key) const {
  const EmbeddedShader* found = shader(key);
  if (found == nullptr) return Error{ErrorCode::kInternal, "there is no shader named \"" + key.shader + "\""};
  if (const Status fits = check_limits(limits, key); !fits.ok()) return fits.error();

  OwnedProgram made(new Program, ProgramDeleter{&vk, device, allocation_callbacks});
  made->key = key;
  if (const Status status = make_program(*this, pipeline_cache_, *found, *made); !status.ok()) return status.error();
  return made;
}

Result<const Program*> Context::Impl::program(const ProgramKey& key) {
  if (const auto found = programs_.find(key); found != programs_.end()) return found->second.get();
  ProgramsReport report(programs_progress, 1);
  Result<OwnedProgram> made = build_program(key);
  report.add_one();
  if (!made.ok()) return made.error();
  return programs_.emplace(key, std::move(made.value())).first->second.get();
}

// Vulkan lets any thread create pipelines of one device and one cache.
void Context::Impl::close_programs() noexcept {
  save_pipeline_cache();
  programs_.clear();
}

Status Context::Impl::make_programs(const std::set<ProgramKey>& keys) {
  std::vector<const ProgramKey*> missing;
  for (const ProgramKey& key : keys)
    if (!programs_.contains(key)) missing.push_back(&key);
  // The largest first: they take the longest.
  const auto size = [this](const ProgramKey* key) {
    const EmbeddedShader* found = shader(*key);
    return found != nullptr ? found->words.size() : 0;
  };
  std::ranges::stable_sort(missing, std::greater<>{}, size);
  ProgramsReport report(missing.empty() ? nullptr : programs_progress, missing.size());
  std::vector<OwnedProgram> made(missing.size());
  std::vector<Status> status(missing.size());
  parallel_blocks(missing.size(), 1, host_threads, [&](std::size_t i, std::size_t) {
    Result<OwnedProgram> program = build_program(*missing[i]);
    if (program.ok())
      made[i] = std::move(program.value());
    else
      status[i] = program.error();
    report.add_one();
  });
  for (std::size_t i = 0; i < missing.size(); ++i)
    if (made[i]) programs_.emplace(*missing[i], std::move(made[i]));
  const auto failed = std::find_if(status.begin(), status.end(), [](const Status& s) { return !s.ok(); });
  return failed == status.end() ? Status{} : *failed;
}

}  // namespace medial_vk
