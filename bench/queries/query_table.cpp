#include "query_table.h"

#include <algorithm>
#include <cstdio>

#include "../helpers.h"

namespace medial_vk::bench {
namespace {

std::string number(double value, const char* format = "%.2f") {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return value > 0 ? text : "";
}

}  // namespace

void QueryTable::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
    const std::string& name = run.run_name.function_name;
    if (times_.count(name) == 0) names_.push_back(name);
    Times& times = times_[name];
    const auto iterations = static_cast<double>(run.iterations);
    times.cpu.push_back(run.cpu_accumulated_time / iterations);
    times.wall.push_back(run.real_accumulated_time / iterations);
    const auto queries = run.counters.find("queries"), device = run.counters.find("device_s");
    if (queries != run.counters.end()) times.queries = queries->second;
    if (device != run.counters.end()) times.device.push_back(device->second);
  }
  ConsoleReporter::ReportRuns(runs);
}

std::string QueryTable::markdown() const {
  std::vector<std::string> names = names_;
  std::sort(names.begin(), names.end());
  std::string text =
      "| mesh / queries / who | queries | Mq per CPU-s | Mq per s, wall | device ms | per CPU-s vs Embree |\n"
      "|---|---|---|---|---|---|\n";
  for (const std::string& name : names) {
    const Times& times = times_.at(name);
    const auto peer = times_.find(name.substr(0, name.rfind('/')) + "/embree");
    const double cpu = median(times.cpu);
    const double ratio = peer != times_.end() && cpu > 0 ? median(peer->second.cpu) / cpu : 0;
    text += "| " + name + " | " + number(times.queries, "%.0f") + " | " + number(1e-6 * times.queries / cpu, "%.3f") +
            " | " + number(1e-6 * times.queries / median(times.wall), "%.3f") + " | " +
            number(1e3 * median(times.device), "%.1f") + " | " + number(ratio) + " |\n";
  }
  return text;
}

}  // namespace medial_vk::bench
