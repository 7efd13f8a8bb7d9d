// Recording: dispatches of every form, transfers, barriers, time, and errors instead of bad calls.
#include "device_commands/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/memory.h"
#include "device_commands/uploads.h"
#include "support/device/device.h"
#include "write_sequence_spirv.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

constexpr EmbeddedShader kWritingShaders[] = {{"write_sequence", kWriteSequenceSpirv}};

struct Push {
  std::uint32_t count;
  std::uint32_t offset;
};

ProgramKey sequence_program(std::uint32_t workgroup_size, std::uint32_t factor) {
  return {.shader = "write_sequence",
          .storage_buffers = 1,
          .texel_buffers = 1,
          .push_constant_bytes = sizeof(Push),
          .workgroup_size = workgroup_size,
          .constants = {factor, 3}};
}

/// Every test runs under the validation layer if it is installed, and messages are failures.
class RecorderTest : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    validation_ = test::no_validation_reason().empty();
    Result<Context> created = Context::create({.device = "", .validation = validation_, .cache_folder = "/dev/null"});
    ASSERT_TRUE(created.ok()) << created.error().message;
    context_.emplace(std::move(created.value()));
    impl().extra_shaders = kWritingShaders;
    arena_.emplace(impl());
    const float texels[16] = {100, 0, 0, 0, 200, 0, 0, 0, 300, 0, 0, 0, 400, 0, 0, 0};
    const Buffer buffer = create(sizeof(texels), MemoryKind::kDevice);
    ASSERT_TRUE(upload(impl(), buffer, std::as_bytes(std::span(texels))).ok());
    texels_ = arena_->create_texel_view(buffer).value();
  }
  void TearDown() override {
    arena_.reset();
    if (context_) {
      EXPECT_EQ(context_->validation_messages(), expected_messages_);
    }
  }

  ContextImpl& impl() { return Internals::of(*context_); }
  Buffer create(VkDeviceSize bytes, MemoryKind kind) { return arena_->create_buffer(bytes, kind, "a test").value(); }

  std::vector<StageTime> run(const std::function<Status(Recorder&)>& record) {
    auto ran = run_commands(impl(), record);
    EXPECT_TRUE(ran.ok()) << ran.error().message;
    return ran.ok() ? ran.value() : std::vector<StageTime>();
  }

  /// The output of the test shader.
  static std::uint32_t expected(std::uint32_t i, std::uint32_t factor, std::uint32_t offset) {
    return factor * i + offset + 100 * ((i & 3) + 1);
  }

  void expect_sequence(std::uint32_t count, std::uint32_t workgroup_size) {
    const Buffer output = create(VkDeviceSize{count} * 4, MemoryKind::kDevice);
    const Buffer back = create(output.size, MemoryKind::kReadback);
    run([&](Recorder& recorder) {
      recorder.fill(output, 0, output.size, 0xffffffffu);
      recorder.barrier();
      const BufferRange buffers[] = {output.range()};
      recorder.dispatch(sequence_program(workgroup_size, 3), buffers, {&texels_, 1}, bytes_of(Push{count, 7}), count);
      recorder.barrier();
      recorder.copy(output, 0, back, 0, output.size);
      recorder.barrier_to_host();
      return recorder.status();
    });
    const auto* words = static_cast<const std::uint32_t*>(back.mapped);
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(words[i], expected(i, 3, 7)) << "item " << i;
  }

  std::optional<Context> context_;
  std::optional<Arena> arena_;
  VkBufferView texels_ = VK_NULL_HANDLE;
  bool validation_ = false;
  std::uint64_t expected_messages_ = 0;
};

TEST_F(RecorderTest, DispatchReachesEveryItem) {
  for (const std::uint32_t count : {1u, 63u, 64u, 65u, 1000u}) expect_sequence(count, 64);
}

TEST_F(RecorderTest, ManyGroupsGoToASecondRow) { expect_sequence(3 * 32768 + 5, 1); }

TEST_F(RecorderTest, IndirectDispatchReadsItsCountsFromTheDevice) {
  const Buffer counts = create(32, MemoryKind::kDevice);
  const Buffer output = create(4 * 128, MemoryKind::kDevice);
  const Buffer back = create(output.size, MemoryKind::kReadback);
  run([&](Recorder& recorder) {
    recorder.fill(output, 0, VK_WHOLE_SIZE, 0);
    recorder.fill(counts, 0, 32, 1);
    recorder.barrier();
    recorder.fill(counts, 4, 4, 3);  // 3 groups of 32
    recorder.barrier();
    const BufferRange buffers[] = {output.range()};
    recorder.dispatch_indirect(sequence_program(32, 1), buffers, {&texels_, 1}, bytes_of(Push{128, 0}), counts, 4);
    recorder.barrier();
    recorder.fill(counts, 0, 32, 0);  // after the counts were read
    recorder.copy(output, 0, back, 0, output.size);
    recorder.barrier_to_host();
    return recorder.status();
  });
  const auto* words = static_cast<const std::uint32_t*>(back.mapped);
  for (std::uint32_t i = 0; i < 128; ++i) ASSERT_EQ(words[i], i < 96 ? expected(i, 1, 0) : 0) << "item " << i;
}

TEST_F(RecorderTest, BindsARangeOfABuffer) {
  const VkDeviceSize offset = impl().limits.minStorageBufferOffsetAlignment * 4;
  const Buffer output = create(offset + 64, MemoryKind::kReadback);
  run([&](Recorder& recorder) {
    recorder.fill(output, 0, VK_WHOLE_SIZE, 5);
    recorder.barrier();
    const BufferRange buffers[] = {output.range(offset, 64)};
    recorder.dispatch(sequence_program(16, 1), buffers, {&texels_, 1}, bytes_of(Push{16, 0}), 16);
    recorder.barrier_to_host();
    return recorder.status();
  });
  const auto* words = static_cast<const std::uint32_t*>(output.mapped);
  EXPECT_EQ(words[offset / 4 - 1], 5u);
  EXPECT_EQ(words[offset / 4], expected(0, 1, 0));
  EXPECT_EQ(words[offset / 4 + 15], expected(15, 1, 0));
}

TEST_F(RecorderTest, DescriptorPoolsGrow) {
  const Buffer output = create(16, MemoryKind::kReadback);
  run([&](Recorder& recorder) {
    const BufferRange buffers[] = {output.range()};
    for (std::uint32_t i = 0; i < 2500; ++i) {
      recorder.dispatch(sequence_program(1, 1), buffers, {&texels_, 1}, bytes_of(Push{1, i}), 1);
      recorder.barrier();
    }
    recorder.barrier_to_host();
    return recorder.status();
  });
  EXPECT_EQ(*static_cast<const std::uint32_t*>(output.mapped), expected(0, 1, 2499));
}

TEST_F(RecorderTest, NothingToDoIsFine) {
  const Buffer buffer = create(16, MemoryKind::kDevice);
  run([&](Recorder& recorder) {
    const BufferRange buffers[] = {buffer.range()};
    recorder.dispatch(sequence_program(64, 1), buffers, {&texels_, 1}, bytes_of(Push{0, 0}), 0);
    recorder.fill(buffer, 16, 0, 1);
    recorder.copy(buffer, 0, buffer, 16, 0);
    return recorder.status();
  });
}

TEST_F(RecorderTest, StageTimesAddUpByName) {
  if (impl().timestamp_valid_bits == 0) GTEST_SKIP() << "the queue has no timestamps";
  const Buffer buffer = create(1 << 20, MemoryKind::kDevice);
  const std::vector<StageTime> times = run([&](Recorder& recorder) {
    for (std::uint32_t i = 0; i < 100; ++i) {  // more than one query pool holds
      recorder.begin_stage(i % 2 == 0 ? "even" : "odd");
      recorder.fill(buffer, 0, buffer.size, i);
      recorder.barrier();
    }
    return recorder.status();
  });
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].stage, "even");
  EXPECT_EQ(times[1].stage, "odd");
  for (const StageTime& time : times) {
    EXPECT_GE(time.seconds, 0.0);
    EXPECT_LT(time.seconds, 60.0);
  }
}

TEST_F(RecorderTest, NoStagesNoTimes) {
  EXPECT_TRUE(run([](Recorder& recorder) { return recorder.status(); }).empty());
}

TEST_F(RecorderTest, BadArgumentsAreErrorsAndNeverReachTheDriver) {
  const Buffer buffer = create(64, MemoryKind::kDevice);
  const BufferRange whole[] = {buffer.range()};
  const BufferRange misaligned[] = {{buffer.handle, 1, 16}};
  const BufferRange missing[] = {{}};
  const Push push{1, 0};
  const ProgramKey key = sequence_program(1, 1);
  ProgramKey unknown = key;
  unknown.shader = "no_such_kernel";
  const VkBufferView no_view = VK_NULL_HANDLE;
  using Record = std::function<void(Recorder&)>;
  const std::pair<const char*, Record> cases[] = {
      {"storage buffers",
       [&](Recorder& r) {
         r.dispatch(key, {}, {&texels_, 1}, bytes_of(push), 1);
       }},
      {"texel buffers", [&](Recorder& r) { r.dispatch(key, whole, {}, bytes_of(push), 1); }},
      {"push constants",
       [&](Recorder& r) {
         r.dispatch(key, whole, {&texels_, 1}, {}, 1);
       }},
      {"binding 0",
       [&](Recorder& r) {
         r.dispatch(key, misaligned, {&texels_, 1}, bytes_of(push), 1);
       }},
      {"binding 0",
       [&](Recorder& r) {
         r.dispatch(key, missing, {&texels_, 1}, bytes_of(push), 1);
       }},
      {"texel buffer",
       [&](Recorder& r) {
         r.dispatch(key, whole, {&no_view, 1}, bytes_of(push), 1);
       }},
      {"items",
       [&](Recorder& r) {
         r.dispatch(key, whole, {&texels_, 1}, bytes_of(push), ~0ull);
       }},
      {"no_such_kernel",
       [&](Recorder& r) {
         r.dispatch(unknown, whole, {&texels_, 1}, bytes_of(push), 1);
       }},
      {"group counts",
       [&](Recorder& r) {
         r.dispatch_indirect(key, whole, {&texels_, 1}, bytes_of(push), buffer, 56);
       }},
      {"a fill", [&](Recorder& r) { r.fill(buffer, 60, 8, 0); }},
      {"a fill", [&](Recorder& r) { r.fill(buffer, 2, 4, 0); }},
      {"a copy", [&](Recorder& r) { r.copy(buffer, 0, buffer, 32, 40); }},
  };
  for (const auto& [name, bad_call] : cases) {
    const Record& record = bad_call;  // a structured binding cannot be captured
    const auto ran = run_commands(impl(), [&record](Recorder& recorder) {
      record(recorder);
      recorder.barrier();  // recording continues after an error
      return recorder.status();
    });
    ASSERT_FALSE(ran.ok()) << name;
    EXPECT_EQ(ran.error().code, ErrorCode::kInternal);
    EXPECT_THAT(ran.error().message, HasSubstr(name));
  }
}

TEST_F(RecorderTest, ErrorsOfTheCallerComeBack) {
  const auto ran = run_commands(impl(), [](Recorder&) -> Status { return Error{ErrorCode::kInterrupted, "enough"}; });
  ASSERT_FALSE(ran.ok());
  EXPECT_EQ(ran.error().code, ErrorCode::kInterrupted);
}

TEST_F(RecorderTest, ValidationHearsAMissingBarrier) {
  if (!validation_) GTEST_SKIP() << test::no_validation_reason();
  const Buffer buffer = create(1024, MemoryKind::kDevice);
  const Buffer back = create(1024, MemoryKind::kReadback);
  testing::internal::CaptureStderr();
  run([&](Recorder& recorder) {
    recorder.fill(buffer, 0, buffer.size, 1);
    recorder.copy(buffer, 0, back, 0, buffer.size);  // may read bytes before they are written
    return recorder.status();
  });
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("Vulkan validation error"));
  EXPECT_GT(context_->validation_messages(), 0u);
  expected_messages_ = context_->validation_messages();
}

}  // namespace
}  // namespace medial_vk
