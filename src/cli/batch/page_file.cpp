#include "cli/batch/page_file.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cli/batch/result_files.h"
#include "output/atomic_files/atomic_file.h"
#include "output/batch_page/batch_page.h"
#include "platform/paths.h"

namespace medial_vk::cli {

Status write_page(const BatchFolder& folder, std::span<const BatchRow> rows) {
  std::vector<BatchCard> cards;
  cards.reserve(rows.size());
  for (const BatchRow& row : rows) {
    const std::string& name = row[BatchColumn::kName];
    BatchCard card = {&row, "", paths_of_results(name, row[BatchColumn::kFiles])};
    const auto picture = std::ranges::find_if(
        card.files, [&](const std::string& file) { return file.compare(name.size(), 9, ".picture.") == 0; });
    if (picture != card.files.end()) card.picture = *picture;
    cards.push_back(std::move(card));
  }
  const std::string table = platform::file_name_of(folder.table_path());
  const OutputFile page = {folder.page_path(), encode_batch_page(cards, table)};
  return write_files({&page, 1});
}

}  // namespace medial_vk::cli
