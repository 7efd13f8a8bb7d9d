#include "cli/run.h"

#include <fmt/format.h>

#include <exception>
#include <new>

#include "cli/batch/run_batch.h"
#include "cli/clearance/run_clearance.h"
#include "cli/curvature/run_curvature.h"
#include "cli/distance/run_distance.h"
#include "cli/doctor/run_doctor.h"
#include "cli/extract/run_extract.h"
#include "cli/fit/run_fit.h"
#include "cli/follow/run_follow.h"
#include "cli/help/help_texts.h"
#include "cli/options/fit/fit_options.h"
#include "cli/options/options.h"
#include "cli/plane/run_plane.h"
#include "cli/spheres/run_spheres.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/tables.h"
#include "cli/voronoi/run_voronoi.h"
#include "common/absent_parts.h"
#include "medial_vk/context.h"
#include "medial_vk/version.h"

namespace medial_vk::cli {
namespace {

Status list_devices() {
  const Result<std::vector<DeviceDescription>> devices = Context::list_devices();
  if (!devices) return with_hint(devices.error());
  if (devices.value().empty()) return with_hint({ErrorCode::kNoDevice, "Vulkan lists no device"});
  return print_result(device_table(devices.value()));
}

std::string version_text() {
  std::string text = fmt::format("medial-vk {}\n", version());
  for (const std::string& part : absent_parts()) text += fmt::format("without {}\n", part);
  return text;
}

Status run_action(const Options& options) {
  switch (options.action) {
    case Action::kHelp:
      return print_result(help_text());
    case Action::kVersion:
      return print_result(version_text());
    case Action::kListDevices:
      return list_devices();
    case Action::kExtract:
      break;
  }
  return run_extract(options);
}

/// By the first argument.
Command command_of(const std::vector<std::string>& arguments) {
  if (arguments.empty()) return Command::kExtract;
  if (arguments[0] == "batch") return Command::kBatch;
  if (arguments[0] == "spheres") return has_primitives(arguments) ? Command::kFit : Command::kSpheres;
  if (arguments[0] == "fit") return Command::kFit;
  if (arguments[0] == "distance") return Command::kDistance;
  if (arguments[0] == "clearance") return Command::kClearance;
  if (arguments[0] == "follow") return Command::kFollow;
  if (arguments[0] == "curvature") return Command::kCurvature;
  if (arguments[0] == "plane") return Command::kPlane;
  if (arguments[0] == "voronoi") return Command::kVoronoi;
  return arguments[0] == "doctor" ? Command::kDoctor : Command::kExtract;
}

Status parse_and_run(Command command, const std::vector<std::string>& arguments) {
  if (command == Command::kBatch) return run_batch({arguments.begin() + 1, arguments.end()});
  if (command == Command::kSpheres) return run_spheres({arguments.begin() + 1, arguments.end()});
  if (command == Command::kFit) return run_fit({arguments.begin() + 1, arguments.end()});
  if (command == Command::kDistance) return run_distance({arguments.begin() + 1, arguments.end()});
  if (command == Command::kClearance) return run_clearance({arguments.begin() + 1, arguments.end()});
  if (command == Command::kFollow) return run_follow({arguments.begin() + 1, arguments.end()});
  if (command == Command::kCurvature) return run_curvature({arguments.begin() + 1, arguments.end()});
  if (command == Command::kPlane) return run_plane({arguments.begin() + 1, arguments.end()});
  if (command == Command::kVoronoi) return run_voronoi({arguments.begin() + 1, arguments.end()});
  if (command == Command::kDoctor) return run_doctor({arguments.begin() + 1, arguments.end()});
  const Result<Options> options = parse_options(arguments);
  if (!options) return options.error();
  return run_action(options.value());
}

}  // namespace

int run(const std::vector<std::string>& arguments) {
  install_interrupt_handlers();
  const Command command = command_of(arguments);
  try {
    const Status status = parse_and_run(command, arguments);
    return status ? 0 : report_error(status.error(), command);
  } catch (const std::bad_alloc&) {
    return report_error({ErrorCode::kOutOfMemory, "out of memory; try a lower --resolution"}, command);
  } catch (const std::exception& error) {
    return report_error({ErrorCode::kInternal, fmt::format("internal error: {}", error.what())}, command);
  }
}

}  // namespace medial_vk::cli
