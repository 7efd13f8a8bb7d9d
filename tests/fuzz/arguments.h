// Shared definitions of the targets of the command lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fuzz/require.h"

namespace medial_vk::fuzz {

/// The arguments, one per line, as main() receives them: of any bytes but 0, which also ends an argument.
std::vector<std::string> arguments(std::string_view text);

/// True for one in 64 lines, and always for the same lines, so that findings can be reproduced.
bool is_sample(const std::vector<std::string>& arguments);

/// Compares the `options` of a parser that has parsed other lines with those of a `fresh` one, since the state that one
/// line leaves could change the next.
template <class Options>
void require_no_trace(const Result<Options>& options, const Result<Options>& fresh) {
  require(fresh.ok() == options.ok(), "earlier lines do not decide about this one");
  if (fresh.ok()) {
    require(fresh.value() == options.value(), "earlier lines do not change the options of this one");
  } else {
    require(fresh.error().message == options.error().message, "earlier lines do not change the message for this one");
  }
}

}  // namespace medial_vk::fuzz
