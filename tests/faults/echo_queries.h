// Queries whose kernel is a copy: every result equals its query.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "queries/query_batches.h"

namespace medial_vk::test {

/// The queries run in batches of 60 and groups of 20. `answers` must outlive them.
inline QuerySet echo(std::span<const float> values, std::vector<float>& answers) {
  answers.assign(values.size(), -1.0f);
  QuerySet set;
  set.count = values.size();
  set.batch = 60;
  set.group_size = 20;
  set.item_bytes = {16, 0};
  set.write = [values](std::size_t first, std::span<Texel> out) -> Status {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = {values[first + i], 0, 0, 0};
    return {};
  };
  set.record = [](Recorder& r, std::uint32_t count, const Buffer& queries, std::span<const Buffer, 2> items) {
    EXPECT_EQ(count % 20, 0u);
    r.copy(queries, 0, items[0], 0, count * sizeof(Texel));
    r.barrier();
  };
  set.read = [&answers](std::size_t first, std::size_t count, std::span<const std::byte* const, 2> items) -> Status {
    const auto* texels = reinterpret_cast<const Texel*>(items[0]);
    for (std::size_t i = 0; i < count; ++i) answers[first + i] = texels[i][0];
    return {};
  };
  return set;
}

}  // namespace medial_vk::test
