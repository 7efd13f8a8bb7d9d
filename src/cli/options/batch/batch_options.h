// The command line of `medial-vk batch` as a struct (docs/command-line.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/options/options.h"
#include "medial_vk/result.h"

namespace medial_vk::cli {

struct BatchOptions {
  bool help = false;
  std::vector<std::string> inputs;  ///< Folders, lists and meshes; "-": a list from standard input.
  std::string output;               ///< A folder.
  bool page = false;                ///< A page with a picture of each mesh.
  bool list = false;                ///< Print the meshes, and do nothing else.
  bool merge = false;               ///< Inputs are folders with results, or lists of them: they become one folder.
  Options each;                     ///< Of a mesh with the name kMeshWord: its files are named after it.
  std::string given;  ///< The options that can change results, as they were given, in the order of their declaration.

  bool operator==(const BatchOptions&) const = default;
};

/// Stands for the name of a mesh in BatchOptions::each, and in messages about its files.
inline constexpr const char* kMeshWord = "MESH";

/// `arguments` without the program's name and without "batch". Errors: kUsage with a message that names the option.
Result<BatchOptions> parse_batch_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class BatchOptionParser {
 public:
  BatchOptionParser();
  ~BatchOptionParser();
  BatchOptionParser(const BatchOptionParser&) = delete;
  BatchOptionParser& operator=(const BatchOptionParser&) = delete;

  Result<BatchOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

/// The options of the mesh in the file `mesh`, whose files begin with the path `stem`.
Options options_of_mesh(const Options& each, const std::string& mesh, const std::string& stem);

}  // namespace medial_vk::cli
