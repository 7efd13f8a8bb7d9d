// Opening a device, and the file of compiled pipelines.
#include "medial_vk/context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <type_traits>

#include "device/context_impl.h"
#include "device/pipeline_cache.h"
#include "device/required_limits.h"
#include "support/device/device.h"
#include "write_sequence_spirv.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

static_assert(!std::is_copy_constructible_v<Context> && std::is_nothrow_move_constructible_v<Context>);

constexpr EmbeddedShader kTestShaders[] = {{"write_sequence", kWriteSequenceSpirv}};

ProgramKey test_program() {
  return {.shader = "write_sequence",
          .storage_buffers = 1,
          .texel_buffers = 1,
          .push_constant_bytes = 8,
          .workgroup_size = 32,
          .constants = {2, 0}};
}

class ContextTest : public testing::Test {
 protected:
  void SetUp() override { MEDIAL_VK_SKIP_WITHOUT_DEVICE(); }

  ContextOptions options() const {
    return {.device = "", .validation = false, .cache_folder = folder_.path().string()};
  }

  /// Opens a context, creates a program, closes it; returns the cache file, empty if there is none.
  fs::path use_cache(const ContextOptions& options) {
    Result<Context> context = Context::create(options);
    EXPECT_TRUE(context.ok()) << context.error().message;
    if (!context.ok()) return {};
    ContextImpl& impl = Internals::of(context.value());
    impl.extra_shaders = kTestShaders;
    const auto program = impl.program(test_program());
    EXPECT_TRUE(program.ok()) << program.error().message;
    { const Context closed = std::move(context.value()); }
    return find_cache_file();
  }

  fs::path find_cache_file() const {
    fs::path found;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      EXPECT_EQ(entry.path().extension(), ".bin") << entry.path() << " was left behind";
      found = entry.path();
    }
    return found;
  }

  test::TemporaryFolder folder_;
};

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void overwrite(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

TEST_F(ContextTest, ListsDevices) {
  const auto devices = Context::list_devices();
  ASSERT_TRUE(devices.ok()) << devices.error().message;
  ASSERT_FALSE(devices.value().empty());
  for (std::uint32_t i = 0; i < devices.value().size(); ++i) {
    const DeviceDescription& device = devices.value()[i];
    EXPECT_EQ(device.index, i);
    EXPECT_FALSE(device.name.empty());
    EXPECT_FALSE(device.driver.empty());
    EXPECT_GT(device.memory_bytes, 0u);
    EXPECT_EQ(device.usable, device.why_not.empty());
    EXPECT_THAT(device.type, testing::AnyOf("discrete", "integrated", "virtual", "cpu", "other"));
    EXPECT_EQ(device.limits.size(), required_limits().size());
    for (const DeviceLimit& limit : device.limits) EXPECT_EQ(device.usable, limit.there >= limit.needed) << limit.name;
    const auto is_largest = [&](const DeviceHeap& heap) { return heap.is_local && heap.bytes == device.memory_bytes; };
    EXPECT_TRUE(std::any_of(device.heaps.begin(), device.heaps.end(), is_largest));
    EXPECT_GT(device.subgroups.size, 0u);
    EXPECT_THAT(device.subgroups.operations, testing::Contains("basic"));
  }
}

TEST_F(ContextTest, TheDeviceThatIsChosenIsTheOneThatOpens) {
  const auto devices = Context::list_devices();
  ASSERT_TRUE(devices.ok());
  const Result<std::uint32_t> chosen = Context::choose_device(devices.value());
  ASSERT_TRUE(chosen.ok()) << chosen.error().message;
  EXPECT_EQ(Context::create(options()).value().device().index, chosen.value());
  const test::ScopedEnvironment variable("MEDIAL_VK_DEVICE", "no such device");
  EXPECT_THAT(Context::choose_device(devices.value()).error().message, HasSubstr("MEDIAL_VK_DEVICE"));
  EXPECT_TRUE(Context::choose_device(devices.value(), std::to_string(chosen.value())).ok());
}

TEST_F(ContextTest, OpensByIndexAndByName) {
  const Result<Context> first = Context::create(options());
  ASSERT_TRUE(first.ok()) << first.error().message;
  const DeviceDescription device = first.value().device();
  EXPECT_TRUE(device.usable);
  EXPECT_GE(device.api_version, VK_API_VERSION_1_2);
  EXPECT_EQ(first.value().validation_messages(), 0u);

  ContextOptions by_index = options();
  by_index.device = std::to_string(device.index);
  const Result<Context> second = Context::create(by_index);  // beside the first
  ASSERT_TRUE(second.ok()) << second.error().message;
  EXPECT_EQ(second.value().device().name, device.name);

  ContextOptions by_name = options();
  by_name.device = device.name.substr(0, 4);
  std::transform(by_name.device.begin(), by_name.device.end(), by_name.device.begin(), ::toupper);
  const Result<Context> third = Context::create(by_name);
  ASSERT_TRUE(third.ok()) << third.error().message;
}

TEST_F(ContextTest, OpensByEnvironmentUnlessADeviceIsNamed) {
  const test::ScopedEnvironment variable("MEDIAL_VK_DEVICE", "no such device");
  const Result<Context> refused = Context::create(options());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kNoDevice);
  EXPECT_THAT(refused.error().message, HasSubstr("MEDIAL_VK_DEVICE"));

  const auto devices = Context::list_devices();  // lists all, for any value of the variable
  ASSERT_TRUE(devices.ok());
  const auto usable = std::find_if(devices.value().begin(), devices.value().end(),
                                   [](const DeviceDescription& device) { return device.usable; });
  ASSERT_NE(usable, devices.value().end());
  ContextOptions by_option = options();
  by_option.device = std::to_string(usable->index);
  EXPECT_TRUE(Context::create(by_option).ok());
}

TEST_F(ContextTest, UnknownDeviceListsWhatExists) {
  ContextOptions unknown = options();
  unknown.device = "no such device";
  const Result<Context> context = Context::create(unknown);
  ASSERT_FALSE(context.ok());
  EXPECT_EQ(context.error().code, ErrorCode::kNoDevice);
  EXPECT_THAT(context.error().message, HasSubstr("no such device"));
  EXPECT_THAT(context.error().message, HasSubstr(Context::list_devices().value()[0].name));
}

TEST_F(ContextTest, MovesKeepTheDevice) {
  Result<Context> created = Context::create(options());
  ASSERT_TRUE(created.ok());
  const VkDevice device = Internals::of(created.value()).device;
  Context moved = std::move(created.value());
  EXPECT_EQ(Internals::of(moved).device, device);
  Result<Context> other = Context::create(options());
  ASSERT_TRUE(other.ok());
  moved = std::move(other.value());  // closes the first
  EXPECT_NE(Internals::of(moved).device, VkDevice{VK_NULL_HANDLE});
}

TEST_F(ContextTest, ProgramsAreMadeOnce) {
  Result<Context> context = Context::create(options());
  ASSERT_TRUE(context.ok());
  ContextImpl& impl = Internals::of(context.value());
  impl.extra_shaders = kTestShaders;
  const auto first = impl.program(test_program());
  ASSERT_TRUE(first.ok()) << first.error().message;
  EXPECT_EQ(impl.program(test_program()).value(), first.value());
  ProgramKey other = test_program();
  other.constants = {3, 0};
  EXPECT_NE(impl.program(other).value(), first.value());
}

TEST_F(ContextTest, ProgramErrorsNameTheShader) {
  Result<Context> context = Context::create(options());
  ASSERT_TRUE(context.ok());
  ContextImpl& impl = Internals::of(context.value());
  impl.extra_shaders = kTestShaders;
  ProgramKey key = test_program();
  key.shader = "no_such_kernel";
  EXPECT_THAT(impl.program(key).error().message, HasSubstr("no_such_kernel"));
  key = test_program();
  key.workgroup_size = 1u << 20;
  EXPECT_THAT(impl.program(key).error().message, HasSubstr("write_sequence"));
  key.workgroup_size = 0;
  EXPECT_FALSE(impl.program(key).ok());
  key = test_program();
  key.storage_buffers = 0xffffffffu;
  EXPECT_FALSE(impl.program(key).ok());
}

/// The data of one program, written at another time: NVIDIA's driver does not always write equally many bytes.
MATCHER_P(IsLike, written, "a cache of about as many bytes") {
  const auto size = static_cast<double>(written.size());
  return std::fabs(static_cast<double>(arg.size()) - size) < 0.01 * size;
}

TEST_F(ContextTest, PipelineCacheIsWrittenAndStaysTheSame) {
  const fs::path file = use_cache(options());
  ASSERT_FALSE(file.empty());
  const std::string written = contents(file);
  EXPECT_GT(written.size(), sizeof(VkPipelineCacheHeaderVersionOne));
  EXPECT_EQ(use_cache(options()), file);
  EXPECT_THAT(contents(file), IsLike(written));
}

TEST_F(ContextTest, PipelineCacheIsWrittenWhenProgramsAreClosed) {
  const fs::path file = use_cache(options());
  const std::string written = contents(file);
  fs::remove(file);
  Context context = Context::create(options()).value();
  Internals::of(context).extra_shaders = kTestShaders;
  ASSERT_TRUE(Internals::of(context).program(test_program()).ok());
  context.close_programs();
  EXPECT_EQ(find_cache_file(), file);
  EXPECT_THAT(contents(file), IsLike(written));
  EXPECT_TRUE(Internals::of(context).program(test_program()).ok());
}

TEST_F(ContextTest, DamagedPipelineCacheIsReplaced) {
  const fs::path file = use_cache(options());
  ASSERT_FALSE(file.empty());
  const std::string good = contents(file);
  std::string flipped = good;
  flipped.back() = static_cast<char>(flipped.back() ^ 0x55);
  std::string huge = good;
  huge.replace(8, 8, 8, '\xff');  // claims 2^64 - 1 bytes
  for (const std::string& bad : {std::string(), std::string("nonsense"), std::string(100000, 'x'), flipped, huge,
                                 good.substr(0, good.size() / 2), good.substr(0, 24)}) {
    overwrite(file, bad);
    use_cache(options());
    EXPECT_THAT(contents(file), IsLike(good)) << "after a file of " << bad.size() << " bytes";
  }
}

TEST_F(ContextTest, PipelineCacheOfAnotherDriverIsIgnored) {
  PipelineCacheIdentity ours{.vendor = 1, .device = 2};
  VkPipelineCacheHeaderVersionOne header{sizeof(header), VK_PIPELINE_CACHE_HEADER_VERSION_ONE, 1, 2, {}};
  const std::string file = (folder_.path() / "pipelines.bin").string();
  ASSERT_TRUE(write_pipeline_cache(file, std::as_bytes(std::span(&header, 1))));
  EXPECT_EQ(read_pipeline_cache(file, ours).size(), sizeof(header));
  PipelineCacheIdentity updated = ours;
  updated.cache_uuid[15] = 1;
  EXPECT_TRUE(read_pipeline_cache(file, updated).empty());
  ours.device = 3;
  EXPECT_TRUE(read_pipeline_cache(file, ours).empty());
}

TEST_F(ContextTest, WorksWithoutAFolderForTheCache) {
  const fs::path blocker = folder_.path() / "file.bin";
  overwrite(blocker, "not a folder");
  ContextOptions blocked = options();
  blocked.cache_folder = (blocker / "cache").string();
  use_cache(blocked);
  EXPECT_EQ(contents(blocker), "not a folder");
}

// From 0 to all, one by one; programs that exist are not counted again.
TEST_F(ContextTest, ReportsTheProgramsThatItMakes) {
  std::vector<std::pair<std::size_t, std::size_t>> reports;
  ContextOptions reporting = options();
  reporting.programs_progress = [&](std::size_t made, std::size_t total) { reports.emplace_back(made, total); };
  Result<Context> context = Context::create(reporting);
  ASSERT_TRUE(context.ok());
  ContextImpl& impl = Internals::of(context.value());
  impl.extra_shaders = kTestShaders;
  ProgramKey another = test_program();
  another.constants = {3, 0};
  ASSERT_TRUE(impl.make_programs({test_program(), another}).ok());
  std::vector<std::pair<std::size_t, std::size_t>> expected = {{0, 2}, {1, 2}, {2, 2}};
  EXPECT_EQ(reports, expected);
  ASSERT_TRUE(impl.make_programs({test_program(), another}).ok());
  ASSERT_TRUE(impl.program(another).ok());
  EXPECT_EQ(reports, expected);
  // Queries make their programs one by one.
  another.constants = {5, 0};
  ASSERT_TRUE(impl.program(another).ok());
  expected.insert(expected.end(), {{0, 1}, {1, 1}});
  EXPECT_EQ(reports, expected);
}

}  // namespace
}  // namespace medial_vk
