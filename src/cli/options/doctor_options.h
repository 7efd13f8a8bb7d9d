// The command line of `medial-vk doctor` as a struct. Names and exit codes are a contract with scripts
// (docs/command-line.md).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

struct DoctorOptions {
  bool help = false;
  std::string device;        ///< Examined as the default device; empty: that of other commands.
  std::string report;        ///< Empty: none; "-": standard output.
  unsigned time_limit = 60;  ///< Seconds for each process that examines a driver or a device.
  bool quiet = false;
  bool verbose = false;

  bool operator==(const DoctorOptions&) const = default;
};

/// `arguments` without the program's name and without "doctor". Errors: kUsage with a message that names the option.
Result<DoctorOptions> parse_doctor_options(const std::vector<std::string>& arguments);

/// Parses many command lines, as OptionParser does.
class DoctorOptionParser {
 public:
  DoctorOptionParser();
  ~DoctorOptionParser();
  DoctorOptionParser(const DoctorOptionParser&) = delete;
  DoctorOptionParser& operator=(const DoctorOptionParser&) = delete;

  Result<DoctorOptions> parse(const std::vector<std::string>& arguments);

 private:
  struct Declared;  // keeps CLI11 out of this header
  std::unique_ptr<Declared> declared_;
};

}  // namespace medial_vk::cli
