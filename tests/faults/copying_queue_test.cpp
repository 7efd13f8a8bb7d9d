// Devices with a queue for copies: copies run beside the kernels, and nothing is read before it has arrived, even if
// either queue is late.
#include <gmock/gmock.h>

#include <numeric>
#include <set>

#include "echo_queries.h"
#include "fault_test.h"
#include "lent_device.h"
#include "support/indexed.h"

namespace medial_vk::test {
namespace {

class CopyingQueue : public FaultTest, public testing::WithParamInterface<LateQueue> {
 protected:
  /// A device like a discrete one: memory of its own, and a queue that only copies.
  Result<Context> open_discrete() {
    DeviceProfile profile;
    profile.split_memory = true;
    profile.copying_queue = GetParam();
    vulkan().set_profile(profile);
    return open();
  }

  /// Expects the same result as on the unmodified device.
  void expect_same(const Job& job) {
    std::string expected;
    vulkan().set_profile({});
    {
      Result<Context> plain = open();
      ASSERT_TRUE(plain.ok()) << plain.error().message;
      EXPECT_EQ(Internals::of(plain.value()).transfer_queue, VkQueue{VK_NULL_HANDLE});
      expected = job(plain.value()).value();
    }
    Result<Context> discrete = open_discrete();
    ASSERT_TRUE(discrete.ok()) << discrete.error().message;
    EXPECT_EQ(Internals::of(discrete.value()).transfer_queue, TwoQueues::copying_queue());
    const Answer answer = job(discrete.value());
    ASSERT_TRUE(answer.ok()) << answer.error().message;
    EXPECT_TRUE(answer.value() == expected);
    EXPECT_THAT(vulkan().violations(), testing::IsEmpty());  // the next profile clears them
  }
};

TEST_P(CopyingQueue, AnswersQueriesAlike) {
  const PreparedMesh mesh = small_box();
  expect_same([&](Context& context) { return make_scene_and_query(context, mesh); });
}

TEST_P(CopyingQueue, FollowsAMeshThatMoves) {
  const PreparedMesh mesh = small_box(), moved = sheared(mesh);
  expect_same([&](Context& context) -> Answer {
    IndexedMesh indexed = test::indexed(mesh);
    Scene scene = Scene::create(context, indexed).value();
    const std::string before = query_everything(scene).value();
    EXPECT_TRUE(indexed.move_vertices(moved.mesh.vertices).ok());
    EXPECT_TRUE(scene.update(indexed).ok());
    return before + query_everything(scene).value();
  });
}

TEST_P(CopyingQueue, ExtractsAlike) {
  const PreparedMesh mesh = small_box();
  expect_same([&](Context& context) { return extract(context, mesh, Mode::kCertified); });
  expect_same([&](Context& context) { return extract(context, mesh, Mode::kThesis); });
}

// Points of one chunk are downloaded while the next is computed, finally into the same buffer.
TEST_P(CopyingQueue, ExtractsChunkByChunk) {
  const PreparedMesh mesh = small_box();
  const ExtractionOptions options = job_of_many_chunks();
  expect_same([&](Context& context) -> Answer {
    std::set<double> seen;
    const auto extraction =
        test::extract_spheres(context, mesh.view(), options, [&](double done) { seen.insert(done); });
    if (!extraction.ok()) return extraction.error();
    EXPECT_GT(seen.size(), 4u);  // chunks
    return answer_of(extraction.value());
  });
}

TEST_P(CopyingQueue, AnswersManyBatches) {
  Context context = open_discrete().value();
  QueryBatches batches(Internals::of(context), 64, false);
  for (const std::size_t count : {0u, 1u, 60u, 61u, 120u, 121u, 995u}) {
    std::vector<float> values(count), answers;
    std::iota(values.begin(), values.end(), 1.0f);
    ASSERT_TRUE(batches.run(echo(values, answers)).ok());
    EXPECT_EQ(answers, values) << count;
  }
}

TEST_P(CopyingQueue, RefusesBatchesThatDoNotFit) {
  Context context = open_discrete().value();
  QueryBatches batches(Internals::of(context), 64, false);
  std::vector<float> values(200), answers;
  const auto refuses = [&](const std::function<void(QuerySet&)>& change) {
    QuerySet set = echo(values, answers);
    change(set);
    const Status status = batches.run(set);
    return !status.ok() && status.error().code == ErrorCode::kInternal;
  };
  EXPECT_TRUE(refuses([](QuerySet& set) { set.batch = 0; }));
  EXPECT_TRUE(refuses([](QuerySet& set) { set.batch = 50; }));  // groups of 20
  EXPECT_TRUE(refuses([](QuerySet& set) { set.batch = 80; }));
  EXPECT_TRUE(refuses([](QuerySet& set) { set.item_bytes[0] = 20; }));
  EXPECT_FALSE(refuses([](QuerySet& set) { set.batch = 40; }));
}

TEST_P(CopyingQueue, StartsOverAfterAQueryThatCannotBeWritten) {
  Context context = open_discrete().value();
  QueryBatches batches(Internals::of(context), 64, false);
  std::vector<float> values(500), answers;
  std::iota(values.begin(), values.end(), 1.0f);
  for (const std::size_t bad : {0u, 60u, 130u, 499u}) {
    QuerySet set = echo(values, answers);
    const auto write = set.write;
    set.write = [&](std::size_t first, std::span<Texel> out) -> Status {
      if (bad >= first && bad < first + out.size()) return Error{ErrorCode::kUsage, "not this one"};
      return write(first, out);
    };
    const Status status = batches.run(set);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "not this one");
    ASSERT_TRUE(batches.run(echo(values, answers)).ok());
    EXPECT_EQ(answers, values);
  }
}

INSTANTIATE_TEST_SUITE_P(, CopyingQueue, testing::Values(LateQueue::kCopies, LateQueue::kKernels),
                         [](const auto& test) {
                           return test.param == LateQueue::kCopies ? "CopiesAreLate" : "KernelsAreLate";
                         });

}  // namespace
}  // namespace medial_vk::test
