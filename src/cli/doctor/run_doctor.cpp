#include "cli/doctor/run_doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <utility>

#include "cli/doctor/advice.h"
#include "cli/doctor/doctor_text.h"
#include "cli/doctor/driver_manifest.h"
#include "cli/doctor/driver_search.h"
#include "cli/doctor/examine_vulkan.h"
#include "cli/doctor/machine.h"
#include "cli/doctor/trial.h"
#include "cli/help/help_texts.h"
#include "cli/options/doctor_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/progress.h"
#include "common/tool_errors.h"
#include "medial_vk/context.h"
#include "output/atomic_files/atomic_file.h"
#include "output/doctor_report/doctor_report.h"
#include "platform/machine.h"

namespace medial_vk::cli {
namespace {

/// Nothing here starts a thread: processes are copied from this one.
class DoctorRun {
 public:
  explicit DoctorRun(const DoctorOptions& options)
      : options_(options), progress_(!options.quiet), limit_(std::chrono::seconds(options.time_limit)) {}

  Status run() {
    if (!options_.report.empty()) {
      if (Status status = check_writable(options_.report); !status) return status;
    }
    if (Status status = examine(); !status) return status;
    progress_.clear();
    if (interrupted()) return stopped();
    return conclude();
  }

 private:
  /// Until something is written a signal may end the program.
  Status examine() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    examine_surroundings();
    if (record_.loader.problem.empty()) {
      examine_drivers();
      list_devices(limit_, record_);
      if (Status status = try_devices(); !status) return status;
    }
    choose_default();
    record_.advice = advice_on(record_);
    return {};
  }

  void examine_surroundings() {
    const Environment environment = process_environment();
    record_.machine = examine_machine(environment);
    record_.cache = examine_cache(Context::default_cache_folder());
    record_.loader = examine_loader(limit_);
    SearchRules rules;
    rules.is_elevated = platform::has_more_rights();
    rules.has_filters = has_driver_filters(record_.loader.version);
    record_.variables = relevant_variables(environment, rules);
    DriverSearch search = search_drivers(environment, rules);
    record_.driver_override = std::move(search.driver_override);
    record_.places = std::move(search.places);
    record_.drivers = std::move(search.drivers);
    for (DriverRecord& driver : record_.drivers) read_manifest(driver);
  }

  void examine_drivers() {
    for (std::size_t i = 0; i < record_.drivers.size(); ++i) {
      DriverRecord& driver = record_.drivers[i];
      progress_.update_count("drivers", i, record_.drivers.size());
      if (driver.problem.empty() && driver.excluded.empty()) examine_driver(limit_, driver);
    }
  }

  Status try_devices() {
    const auto is_usable = [](const ExaminedDevice& device) { return device.description.usable; };
    if (std::ranges::none_of(record_.devices, is_usable)) return {};
    progress_.update_count("devices", 0, record_.devices.size());
    const Result<TrialTask> task = make_trial_task();
    if (!task) return task.error();
    record_.reference_seconds = task.value().reference_seconds;
    for (std::size_t i = 0; i < record_.devices.size(); ++i) {
      ExaminedDevice& device = record_.devices[i];
      progress_.update_count("devices", i, record_.devices.size());
      if (is_usable(device))
        device.trial = try_device(task.value(), device.description.index, record_.cache.folder, limit_);
    }
    return {};
  }

  void choose_default() {
    if (!record_.loader.problem.empty()) {
      record_.default_reason = "there is no Vulkan loader that can be used: " + record_.loader.problem;
      return;
    }
    if (!record_.listing_problem.empty()) {
      record_.default_reason = record_.listing_problem;
      return;
    }
    std::vector<DeviceDescription> devices;
    for (const ExaminedDevice& device : record_.devices) devices.push_back(device.description);
    const Result<std::uint32_t> chosen = Context::choose_device(devices, options_.device);
    if (chosen) record_.default_device = chosen.value();
    record_.default_reason =
        chosen ? reason_for_choice(devices) : in_words_of_options(chosen.error().message, Command::kDoctor);
  }

  std::string reason_for_choice(const std::vector<DeviceDescription>& devices) const {
    if (!options_.device.empty()) return fmt::format("chosen by --device {}", options_.device);
    const std::string by_variable = process_environment()("MEDIAL_VK_DEVICE").value_or("");
    if (!by_variable.empty()) return fmt::format("chosen by MEDIAL_VK_DEVICE={}", by_variable);
    const auto is_usable = [](const DeviceDescription& device) { return device.usable; };
    if (std::ranges::count_if(devices, is_usable) == 1) return "the only usable one";
    return "the first usable one of the best type: discrete, then integrated, virtual, cpu, other";
  }

  Status verdict() const {
    if (!record_.default_device) return Error{ErrorCode::kNoDevice, record_.default_reason};
    const TrialRecord* const trial = default_trial(record_);
    if (trial == nullptr) return Error{ErrorCode::kNoDevice, "the default device was not tried"};
    if (trial->end == TrialEnd::kAgrees) return {};
    const DeviceDescription& device = record_.devices[*record_.default_device].description;
    return Error{
        trial->end == TrialEnd::kDiffers ? kCheckFailed : ErrorCode::kNoDevice,
        fmt::format("the default device, {}, {}, does not work: {}", device.index, device.name, trial->problem)};
  }

  Status conclude() const {
    Status works = verdict();
    if (!options_.report.empty()) {
      const OutputFile file = {options_.report, doctor_report_json(record_, works)};
      if (Status status = write_files({&file, 1}); !status) return status;
    }
    if (options_.quiet) return works;
    const std::string text = doctor_text(record_, works, options_.verbose);
    if (options_.report == "-") {
      print_message(text);
    } else if (Status status = print_result(text); !status) {
      return status;
    }
    return works;
  }

  const DoctorOptions& options_;
  Progress progress_;
  std::chrono::milliseconds limit_;
  DoctorRecord record_;
};

}  // namespace

Status run_doctor(const std::vector<std::string>& arguments) {
  const Result<DoctorOptions> options = parse_doctor_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(doctor_help_text());
  return DoctorRun(options.value()).run();
}

}  // namespace medial_vk::cli
