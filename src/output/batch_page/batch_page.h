// The page of `medial-vk batch --html`: every mesh with its picture and its numbers.
#pragma once

#include <span>
#include <string>

#include "output/batch_files/batch_table.h"

namespace medial_vk {

struct BatchCard {
  const BatchRow* row = nullptr;
  std::string picture;  ///< Its path from the folder of the page; empty: there is none.
  std::string points;   ///< As `picture`: the file of the medial points.
};

/// One HTML file, which loads the pictures beside it as they come into view, and nothing else. Failed meshes come
/// first.
std::string encode_batch_page(std::span<const BatchCard> cards);

}  // namespace medial_vk
