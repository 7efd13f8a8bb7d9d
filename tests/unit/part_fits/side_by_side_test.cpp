// Parts that are worked on side by side: order, threads, errors.
#include "part_fits/side_by_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <string>

#include "medial_vk/prepare.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class SideBySide : public testing::Test {
 protected:
  /// Parts with 12 triangles each; the one with number `large` has 320.
  static std::vector<Part> parts_with(std::size_t count, std::size_t large) {
    std::vector<Part> parts(count);
    const IndexedMesh box = test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value());
    for (Part& part : parts) part.mesh = box;
    if (large < count) parts[large].mesh = test::indexed(prepare_mesh(test::make_torus(1, 0.4, 16, 10)).value());
    return parts;
  }

  static std::vector<std::size_t> all_of(const std::vector<Part>& parts) {
    std::vector<std::size_t> numbers(parts.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
    return numbers;
  }
};

TEST_F(SideBySide, EachPartOnceWithAThreadOfItsOwn) {
  const std::vector<Part> parts = parts_with(9, 9);
  for (const unsigned threads : {1u, 2u, 4u}) {
    std::mutex mutex;
    std::map<std::size_t, int> calls;
    const Status status = work_side_by_side(parts, all_of(parts), threads, [&](std::size_t number, unsigned own) {
      const std::lock_guard lock(mutex);
      ++calls[number];
      EXPECT_EQ(own, 1u);
      return Status{};
    });
    EXPECT_TRUE(status.ok());
    EXPECT_EQ(calls.size(), 9u);
    for (const auto& [number, count] : calls) EXPECT_EQ(count, 1) << number;
  }
}

TEST_F(SideBySide, ALargePartIsWorkedOnAloneBeforeTheOthers) {
  const std::vector<Part> parts = parts_with(5, 3);
  std::atomic<int> at_work = 0, begun = 0;
  const Status status = work_side_by_side(parts, all_of(parts), 2, [&](std::size_t number, unsigned threads) {
    const int others = at_work++;
    EXPECT_EQ(threads, number == 3 ? 2u : 1u);
    if (begun++ == 0) {
      EXPECT_EQ(number, 3u);
      EXPECT_EQ(others, 0);
    }
    --at_work;
    return Status{};
  });
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(begun, 5);
}

// The large part, number 3, fails first in time.
TEST_F(SideBySide, TheFirstErrorInTheOrderOfPartsIsReturned) {
  const std::vector<Part> parts = parts_with(6, 3);
  for (const unsigned threads : {1u, 2u, 4u}) {
    std::atomic<int> begun = 0;
    const Status status = work_side_by_side(parts, all_of(parts), threads, [&](std::size_t number, unsigned) {
      ++begun;
      return number < 2 ? Status{} : Status{Error{ErrorCode::kInvalidMesh, std::to_string(number)}};
    });
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message, "2") << threads;
    if (threads == 1) {
      EXPECT_EQ(begun, 3);
    }
  }
}

}  // namespace
}  // namespace medial_vk
