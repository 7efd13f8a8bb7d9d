#include "cli/batch/find_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "common/file_extension.h"
#include "input/csv_lines.h"
#include "platform/files.h"
#include "platform/paths.h"
#include "scene_files/scene_formats.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;
using platform::path_of;
using platform::text_of;

struct NamedPath {
  std::string root;  ///< Of BatchMesh.
  std::string name;
};

NamedPath name_of_path(const fs::path& given, const fs::path& file) {
  const fs::path normal = given.lexically_normal();
  if (!normal.has_root_path() && !normal.empty() && *normal.begin() != "..") return {{}, text_of(normal)};
  std::error_code error;
  const fs::path whole = fs::absolute(file, error).lexically_normal();
  return {text_of(whole.root_path()), text_of(whole.relative_path())};
}

std::string in_one_line(const std::string& name) {
  std::string line;
  for (const char c : name) line += c == '\n' ? std::string("\\n") : c == '\r' ? std::string("\\r") : std::string(1, c);
  return line;
}

/// Whether `folder` is `output` or in it.
bool lies_in(const fs::path& folder, const fs::path& output) {
  const fs::path inner = path_of(real_path(text_of(folder))), outer = path_of(real_path(text_of(output)));
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// Whether this command has written its table there, of whatever version.
bool holds_table(const fs::path& folder) {
  constexpr std::string_view kStart = "name,state,error,";
  std::ifstream file(folder / "batch.csv", std::ios::binary);
  std::string start(kStart.size(), ' ');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return file && start == kStart;
}

Error folder_error(const fs::path& folder, const std::error_code& error) {
  return {ErrorCode::kInvalidMesh, fmt::format("{}: {}", text_of(folder), error.default_error_condition().message())};
}

/// Of paths with one key: folders may be set to tell apart names by case.
bool is_one_file(const std::string& one, const std::string& other) {
  std::error_code error;
  return one == other || fs::equivalent(path_of(one), path_of(other), error);
}

class MeshSearch {
 public:
  MeshSearch(const std::vector<std::string>& inputs, fs::path output)
      : output_(std::move(output)), is_single_(inputs.size() == 1) {}

  Status add_input(const std::string& input) {
    if (input == "-") return add_list(input);
    std::error_code error;
    const fs::file_status status = fs::status(path_of(input), error);
    if (!fs::exists(status) || status.type() == fs::file_type::unknown) return folder_error(path_of(input), error);
    if (fs::is_directory(status)) return add_folder(input);
    return file_extension(input) == ".txt" ? add_list(input) : add_mesh(path_of(input), input);
  }

  std::vector<BatchMesh> take() { return std::move(meshes_); }

 private:
  Status add_folder(const std::string& folder) {
    const fs::path root = path_of(folder);
    if (lies_in(root, output_)) {
      return Error{ErrorCode::kUsage, fmt::format("results in {} would be among the meshes of {}: name another folder",
                                                  text_of(output_), folder)};
    }
    std::vector<fs::path> found;
    std::vector<fs::path> folders = {root};
    while (!folders.empty()) {
      const fs::path next = std::move(folders.back());
      folders.pop_back();
      if (Status status = look_into(next, folders, found); !status) return status;
    }
    std::sort(found.begin(), found.end());
    for (const fs::path& file : found) {
      const fs::path named = is_single_ ? file.lexically_relative(root) : file;
      if (Status status = add_mesh(named, text_of(file)); !status) return status;
    }
    return {};
  }

  Status look_into(const fs::path& folder, std::vector<fs::path>& folders, std::vector<fs::path>& found) const {
    std::error_code error;
    fs::directory_iterator at(folder, error);
    for (const fs::directory_iterator end; !error && at != end; at.increment(error)) {
      const fs::path& path = at->path();
      const std::string name = text_of(path.filename());
      if (name.starts_with('.')) continue;
      std::error_code unknown;
      if (fs::is_directory(at->symlink_status(unknown))) {
        if (!fs::equivalent(path, output_, unknown) && !holds_table(path)) folders.push_back(path);
      } else if (may_be_mesh(*at) && is_name_of_mesh(name) && !name.ends_with(".medial.ply")) {
        found.push_back(path);
      }
    }
    if (error) return folder_error(folder, error);
    return {};
  }

  /// A link that leads nowhere, or in a circle, is recorded as a failure; pipes, devices and links to folders are no
  /// meshes.
  static bool may_be_mesh(const fs::directory_entry& entry) {
    std::error_code unknown;
    const fs::file_status behind = entry.status(unknown);
    if (fs::is_regular_file(behind)) return true;
    const bool is_reached = fs::exists(behind) && behind.type() != fs::file_type::unknown;
    return !is_reached && fs::is_symlink(entry.symlink_status(unknown));
  }

  Status add_list(const std::string& list) {
    const Result<std::string> text = [&]() -> Result<std::string> {
      const EndAtOnce guard;  // a pipe may wait
      if (interrupted()) return stopped();
      return read_table(list);
    }();
    if (!text) return text.error();
    const fs::path folder = list == "-" ? fs::path() : path_of(list).parent_path();
    for (CsvLines lines(text.value()); lines.next();) {
      const fs::path given = path_of(lines.line());
      const fs::path file = folder / given;
      const std::string line = fmt::format("{}:{}", list == "-" ? "stdin" : list, lines.number());
      if (given == "-") {
        return Error{ErrorCode::kUsage,
                     fmt::format("{}: - is no path; a list from standard input is an input of its own", line)};
      }
      std::error_code unknown;
      if (fs::is_directory(file, unknown)) {
        return Error{ErrorCode::kUsage, fmt::format("{}: {} is a folder; lists hold meshes, and folders are inputs of "
                                                    "their own",
                                                    line, text_of(file))};
      }
      if (Status status = add_mesh(given, text_of(file)); !status) return status;
    }
    return {};
  }

  Status add_mesh(const fs::path& given, const std::string& file) {
    std::string real = real_path(file);
    const auto same = of_file_.try_emplace(platform::file_key(real), meshes_.size()).first;
    if (same->second < meshes_.size() && is_one_file(meshes_[same->second].real, real)) return {};
    const auto [root, path] = name_of_path(given, path_of(file));
    const std::string name = in_one_line(path);
    const auto [at, is_new] = of_name_.try_emplace(platform::file_key(name), meshes_.size());
    if (!is_new) {
      return Error{ErrorCode::kUsage, fmt::format("the results of {} and {} would have one name, {}",
                                                  meshes_[at->second].file, file, name)};
    }
    meshes_.push_back({file, name, std::move(real), name == path ? "" : "its name has several lines", root});
    return {};
  }

  fs::path output_;
  bool is_single_;
  std::vector<BatchMesh> meshes_;
  std::unordered_map<std::string, std::size_t> of_file_;  ///< By the key of the real path; in meshes_.
  std::unordered_map<std::string, std::size_t> of_name_;  ///< By the key of the name.
};

}  // namespace

std::string line_of_list(const BatchMesh& mesh) { return mesh.root + mesh.name; }

std::string real_path(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path_of(path), error);
  const fs::path real = fs::weakly_canonical(whole, error);
  return error ? text_of(whole.lexically_normal()) : text_of(real);
}

Result<std::vector<BatchMesh>> find_meshes(const std::vector<std::string>& inputs, const std::string& output) {
  MeshSearch search(inputs, path_of(output));
  for (const std::string& input : inputs) {
    if (Status status = search.add_input(input); !status) return status.error();
  }
  std::vector<BatchMesh> meshes = search.take();
  if (meshes.empty())
    return Error{ErrorCode::kInvalidMesh, fmt::format("there is no mesh in {}", fmt::join(inputs, ", "))};
  return meshes;
}

}  // namespace medial_vk::cli
