// The page of `medial-vk batch --html`: every mesh with its picture and its numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "output/batch_files/batch_table.h"

namespace medial_vk {

/// Paths are relative to the folder of the page.
struct BatchCard {
  const BatchRow* row = nullptr;
  std::string picture;             ///< Empty: there is none.
  std::vector<std::string> files;  ///< The name of the mesh, a dot and more.
};

/// One HTML file, which loads the pictures beside it as they come into view, and nothing else. It names the file of the
/// table, and all files of each mesh. Failed meshes come first.
std::string encode_batch_page(std::span<const BatchCard> cards, const std::string& table);

}  // namespace medial_vk
