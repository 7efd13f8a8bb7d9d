// Buffers from an arena: sizes, alignment, limits, upload.
#include "device_commands/memory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>
#include <optional>
#include <type_traits>

#include "device/context_impl.h"
#include "device_commands/commands.h"
#include "device_commands/recorder.h"
#include "device_commands/uploads.h"
#include "support/device/device.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

static_assert(!std::is_copy_constructible_v<Arena> && std::is_nothrow_move_constructible_v<Arena>);

class MemoryTest : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    const bool validation = test::no_validation_reason().empty();
    Result<Context> created = Context::create({.device = "", .validation = validation, .cache_folder = "/dev/null"});
    ASSERT_TRUE(created.ok());
    context_.emplace(std::move(created.value()));
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(context_->validation_messages(), 0u);
    }
  }
  ContextImpl& impl() { return Internals::of(*context_); }

  std::optional<Context> context_;
};

TEST_F(MemoryTest, SizesAreRoundedUpToWholeTexels) {
  Arena arena(impl());
  for (const auto& [bytes, size] : {std::pair{0, 16}, {1, 16}, {16, 16}, {17, 32}, {1000, 1008}}) {
    const auto buffer = arena.create_buffer(static_cast<VkDeviceSize>(bytes), MemoryKind::kDevice, "a test");
    ASSERT_TRUE(buffer.ok()) << buffer.error().message;
    EXPECT_EQ(buffer.value().size, static_cast<VkDeviceSize>(size));
    EXPECT_EQ(buffer.value().range().size, buffer.value().size);
  }
}

TEST_F(MemoryTest, HostBuffersAreMappedAlignedAndDisjoint) {
  Arena arena(impl());
  std::vector<Buffer> buffers;
  for (std::size_t i = 0; i < 200; ++i) {
    const MemoryKind kind = i % 2 == 0 ? MemoryKind::kUpload : MemoryKind::kReadback;
    const auto buffer = arena.create_buffer(i % 37 * 5 + 1, kind, "a test");
    ASSERT_TRUE(buffer.ok()) << buffer.error().message;
    ASSERT_NE(buffer.value().mapped, nullptr);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.value().mapped) % 16, 0u);
    std::memset(buffer.value().mapped, static_cast<int>(i), buffer.value().size);
    buffers.push_back(buffer.value());
  }
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const auto* bytes = static_cast<const unsigned char*>(buffers[i].mapped);
    for (VkDeviceSize k = 0; k < buffers[i].size; ++k) ASSERT_EQ(bytes[k], i) << "buffer " << i << " byte " << k;
  }
}

TEST_F(MemoryTest, SmallBuffersShareAllocations) {
  Arena arena(impl());
  EXPECT_EQ(arena.bytes(), 0u);
  ASSERT_TRUE(arena.create_buffer(1000, MemoryKind::kDevice, "a test").ok());
  const VkDeviceSize first = arena.bytes();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(arena.create_buffer(1000, MemoryKind::kDevice, "a test").ok());
  EXPECT_EQ(arena.bytes(), first);
  const VkDeviceSize big = 100 << 20;
  ASSERT_TRUE(arena.create_buffer(big, MemoryKind::kDevice, "a big buffer").ok());
  EXPECT_GE(arena.bytes(), first + big);
}

TEST_F(MemoryTest, MovesTakeTheBuffersAlong) {
  Arena arena(impl());
  ASSERT_TRUE(arena.create_buffer(64, MemoryKind::kUpload, "a test").ok());
  const VkDeviceSize bytes = arena.bytes();
  Arena moved = std::move(arena);
  EXPECT_EQ(moved.bytes(), bytes);
  Arena target(impl());
  ASSERT_TRUE(target.create_buffer(64, MemoryKind::kDevice, "a test").ok());
  target = std::move(moved);
  EXPECT_EQ(target.bytes(), bytes);
  EXPECT_TRUE(target.create_buffer(64, MemoryKind::kUpload, "a test").ok());
}

TEST_F(MemoryTest, TooMuchIsAnErrorThatNamesBytesAndPurpose) {
  Arena arena(impl());
  const VkDeviceSize beyond_binding = VkDeviceSize{impl().limits.maxStorageBufferRange} + 1;
  for (const VkDeviceSize bytes : {beyond_binding, VkDeviceSize{1} << 50, ~VkDeviceSize{0}}) {
    const auto buffer = arena.create_buffer(bytes, MemoryKind::kDevice, "the contact lists");
    ASSERT_FALSE(buffer.ok());
    EXPECT_EQ(buffer.error().code, ErrorCode::kOutOfMemory);
    EXPECT_THAT(buffer.error().message, HasSubstr(std::to_string(bytes) + " bytes"));
    EXPECT_THAT(buffer.error().message, HasSubstr("the contact lists"));
  }
  EXPECT_EQ(arena.bytes(), 0u);
}

TEST_F(MemoryTest, TexelViewsCoverAWholeBuffer) {
  Arena arena(impl());
  const auto buffer = arena.create_buffer(160, MemoryKind::kDevice, "a test");
  ASSERT_TRUE(buffer.ok());
  const auto view = arena.create_texel_view(buffer.value());
  ASSERT_TRUE(view.ok()) << view.error().message;
  Buffer beyond = buffer.value();
  beyond.size = (VkDeviceSize{impl().limits.maxTexelBufferElements} + 1) * 16;
  const auto refused = arena.create_texel_view(beyond);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
}

/// Bytes are uploaded, copied between two buffers of the device, and downloaded.
void expect_round_trip(ContextImpl& impl, bool through_staging) {
  Arena arena(impl);
  std::vector<std::uint32_t> words(100'003);
  std::iota(words.begin(), words.end(), 7u);
  const VkDeviceSize bytes = words.size() * sizeof(std::uint32_t);
  Buffer first = arena.create_buffer(bytes, MemoryKind::kDevice, "a test").value();
  const Buffer second = arena.create_buffer(bytes, MemoryKind::kDevice, "a test").value();
  const Buffer back = arena.create_buffer(bytes, MemoryKind::kReadback, "a test").value();
  if (through_staging) first.mapped = nullptr;
  const Status uploaded = upload(impl, first, std::as_bytes(std::span(words)));
  ASSERT_TRUE(uploaded.ok()) << uploaded.error().message;
  const auto ran = run_commands(impl, [&](Recorder& recorder) {
    recorder.copy(first, 0, second, 0, bytes);
    recorder.barrier();
    recorder.copy(second, 0, back, 0, bytes);
    recorder.barrier_to_host();
    return recorder.status();
  });
  ASSERT_TRUE(ran.ok()) << ran.error().message;
  EXPECT_EQ(std::memcmp(back.mapped, words.data(), bytes), 0);
}

TEST_F(MemoryTest, UploadCopyAndReadback) { expect_round_trip(impl(), false); }
TEST_F(MemoryTest, UploadThroughStaging) { expect_round_trip(impl(), true); }

TEST_F(MemoryTest, UploadBeyondTheBufferIsRefused) {
  Arena arena(impl());
  const Buffer buffer = arena.create_buffer(16, MemoryKind::kDevice, "a test").value();
  const std::vector<std::byte> bytes(17);
  EXPECT_FALSE(upload(impl(), buffer, bytes).ok());
  EXPECT_TRUE(upload(impl(), buffer, {}).ok());
}

}  // namespace
}  // namespace medial_vk
