// The command line of `medial-vk batch`, one argument per line: options of which every mesh gets files of its own, or a
// clear message.
#include <algorithm>

#include "cli/options/batch/batch_options.h"
#include "fuzz/arguments.h"

namespace medial_vk::fuzz {
namespace {

void require_usable_batch(const cli::BatchOptions& options) {
  require(!options.inputs.empty(), "there is an input");
  require(!options.output.empty() && options.output != "-", "there is a folder");
  require(std::ranges::count(options.inputs, "-") <= 1, "standard input is read once");
  if (options.merge) {
    require(!options.list && options.given.empty(), "results are merged as they are");
    return;
  }
  require(!options.page || !options.each.picture.empty(), "a page has pictures");
  require(!options.each.each && options.each.html.empty(), "a mesh has no parts and no page of its own");
  require(options.each.action == cli::Action::kExtract, "meshes are searched");
  const cli::Options of_mesh = cli::options_of_mesh(options.each, "in/a.obj", "out/a.obj");
  require(of_mesh.mesh == "in/a.obj", "the mesh is named");
  const std::vector<cli::NamedOutput> outputs = cli::outputs_of(of_mesh);
  for (const cli::NamedOutput& output : outputs) {
    if (output.file->empty()) continue;
    require(output.file->starts_with("out/a.obj."), "files begin with the name of the mesh");
    require(output.file->find('/', 4) == std::string::npos, "files lie beside each other");
    const auto same = std::ranges::count_if(outputs, [&](const auto& other) { return *other.file == *output.file; });
    require(same == 1, "results do not replace each other");
  }
}

}  // namespace
}  // namespace medial_vk::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  static cli::BatchOptionParser parser;
  const std::vector<std::string> words = fuzz::arguments(fuzz::as_text(data, size));
  const Result<cli::BatchOptions> options = parser.parse(words);
  if (!options.ok()) {
    fuzz::require(options.error().code == ErrorCode::kUsage, "an error of a command line is an error of usage");
    fuzz::require(!options.error().message.empty(), "an error has a message");
  } else if (!options.value().help) {
    fuzz::require_usable_batch(options.value());
  }
  if (fuzz::is_sample(words)) fuzz::require_no_trace(options, cli::parse_batch_options(words));
  return 0;
}
