#include "cli/options/doctor_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/declarations.h"

namespace medial_vk::cli {
namespace {

constexpr std::uint64_t kLongestLimit = 86400;  // a day

void declare_doctor(CLI::App& app, DoctorOptions& options) {
  Declarations add(app);
  add.text("--device", "index or name", options.device);
  add.text("--report", "file", options.report);
  add.whole("--time-limit", 1, kLongestLimit, " seconds", options.time_limit);
  add.flag("-q,--quiet", options.quiet);
  add.flag("-v,--verbose", options.verbose);
  add.flag("-h,--help", options.help);
}

}  // namespace

/// The application writes to the options, so both stay together and do not move.
struct DoctorOptionParser::Declared {
  ReusableApp app;
  DoctorOptions options;
};

DoctorOptionParser::DoctorOptionParser() : declared_(std::make_unique<Declared>()) {
  declared_->app.set_help_flag();  // The text of --help is written by hand.
  declared_->app.allow_extras();   // Reported with a suggestion.
  declare_doctor(declared_->app, declared_->options);
}

DoctorOptionParser::~DoctorOptionParser() = default;

Result<DoctorOptions> DoctorOptionParser::parse(const std::vector<std::string>& arguments) {
  declared_->app.forget();
  DoctorOptions& options = declared_->options = DoctorOptions();
  if (Status status = parse_arguments(declared_->app, arguments, "doctor takes options only"); !status)
    return status.error();
  if (options.help) return options;
  if (options.quiet && options.verbose) return usage_error("-q and -v cannot be used together");
  return options;
}

Result<DoctorOptions> parse_doctor_options(const std::vector<std::string>& arguments) {
  return DoctorOptionParser().parse(arguments);
}

}  // namespace medial_vk::cli
