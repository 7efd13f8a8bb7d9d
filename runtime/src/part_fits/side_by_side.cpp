#include "part_fits/side_by_side.h"

#include <vector>

#include "base/first_error.h"
#include "base/parallel.h"

namespace medial_vk {
namespace {

std::size_t triangles_of(const Part& part) { return part.mesh ? part.mesh->prepared().mesh.triangles.size() : 0; }

}  // namespace

Status work_side_by_side(std::span<const Part> parts, std::span<const std::size_t> numbers, unsigned threads,
                         const std::function<Status(std::size_t, unsigned)>& work) {
  threads = thread_count(threads);
  std::size_t all = 0;
  for (const std::size_t number : numbers) all += triangles_of(parts[number]);
  FirstError error;
  std::vector<std::size_t> others;
  for (const std::size_t number : numbers) {
    if (threads > 1 && triangles_of(parts[number]) <= all / threads) {
      others.push_back(number);
    } else if (error.concerns(number)) {
      error.add(number, work(number, threads));
    }
  }
  parallel_for(others.size(), 1, threads, [&](std::size_t i) {
    if (error.concerns(others[i])) error.add(others[i], work(others[i], 1));
  });
  return error.status();
}

}  // namespace medial_vk
