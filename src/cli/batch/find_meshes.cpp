#include "cli/batch/find_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "cli/options/output_names.h"
#include "common/file_extension.h"
#include "input/csv_lines.h"
#include "scene_files/scene_formats.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

std::string name_of_path(const fs::path& given, const fs::path& file) {
  const fs::path normal = given.lexically_normal();
  if (normal.is_relative() && *normal.begin() != "..") return normal.string();
  return fs::absolute(file).lexically_normal().relative_path().string();
}

/// Whether `folder` is `output` or in it.
bool lies_in(const fs::path& folder, const fs::path& output) {
  const fs::path inner = fs::weakly_canonical(folder), outer = fs::weakly_canonical(output);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

class MeshSearch {
 public:
  MeshSearch(const std::vector<std::string>& inputs, fs::path output)
      : output_(std::move(output)), is_single_(inputs.size() == 1) {}

  Status add_input(const std::string& input) {
    std::error_code error;
    if (input != "-" && fs::is_directory(input, error)) return add_folder(input);
    if (input == "-" || file_extension(input) == ".txt") return add_list(input);
    return add_mesh(input, input);
  }

  std::vector<BatchMesh> take() { return std::move(meshes_); }

 private:
  Status add_folder(const std::string& folder) {
    std::vector<fs::path> found;
    try {
      if (lies_in(folder, output_)) {
        return Error{ErrorCode::kUsage,
                     fmt::format("results in {} would be among the meshes of {}: name another folder", output_.string(),
                                 folder)};
      }
      for (fs::recursive_directory_iterator at(folder), end; at != end; ++at) {
        std::error_code error;
        if (at->is_directory()) {
          if (fs::equivalent(at->path(), output_, error)) at.disable_recursion_pending();
          continue;
        }
        // A link that leads nowhere is recorded as a failure; pipes and devices are no meshes.
        const bool may_be_mesh = at->is_regular_file(error) || (at->is_symlink() && !fs::exists(at->path(), error));
        if (may_be_mesh && is_name_of_mesh(at->path().string())) found.push_back(at->path());
      }
    } catch (const fs::filesystem_error& error) {
      return Error{ErrorCode::kInvalidMesh, fmt::format("{}: {}", folder, error.code().message())};
    }
    std::sort(found.begin(), found.end());
    for (const fs::path& file : found) {
      const fs::path named = is_single_ ? file.lexically_relative(folder) : file;
      if (Status status = add_mesh(named, file.string()); !status) return status;
    }
    return {};
  }

  Status add_list(const std::string& list) {
    const Result<std::string> text = read_table(list);
    if (!text) return text.error();
    const fs::path folder = list == "-" ? fs::path() : fs::path(list).parent_path();
    for (CsvLines lines(text.value()); lines.next();) {
      const fs::path given(lines.line());
      if (Status status = add_mesh(given, (folder / given).string()); !status) return status;
    }
    return {};
  }

  Status add_mesh(const fs::path& given, const std::string& file) {
    const std::string name = name_of_path(given, file);
    if (name.find_first_of("\r\n") != std::string::npos) {
      return Error{ErrorCode::kUsage, fmt::format("the name of a mesh has several lines: {}", name)};
    }
    const auto [at, is_new] = of_name_.try_emplace(name, meshes_.size());
    if (is_new) {
      meshes_.push_back({file, name});
    } else if (!same_file(meshes_[at->second].file, file)) {
      return Error{ErrorCode::kUsage, fmt::format("the results of {} and {} would have one name, {}",
                                                  meshes_[at->second].file, file, name)};
    }
    return {};
  }

  fs::path output_;
  bool is_single_;
  std::vector<BatchMesh> meshes_;
  std::unordered_map<std::string, std::size_t> of_name_;
};

}  // namespace

Result<std::vector<BatchMesh>> find_meshes(const std::vector<std::string>& inputs, const std::string& output) {
  MeshSearch search(inputs, output);
  for (const std::string& input : inputs) {
    if (Status status = search.add_input(input); !status) return status.error();
  }
  std::vector<BatchMesh> meshes = search.take();
  if (meshes.empty())
    return Error{ErrorCode::kInvalidMesh, fmt::format("there is no mesh in {}", fmt::join(inputs, ", "))};
  return meshes;
}

}  // namespace medial_vk::cli
