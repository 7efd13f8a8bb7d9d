// Collects the runs of bench/queries/queries.cpp and prints their medians as a markdown table.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace medial_vk::bench {

/// Benchmarks are named MESH/QUERIES/WHO, and the counter "queries" says how many queries an iteration answers.
class QueryTable : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;
  /// Rates per CPU-second and per second of wall time, in millions, and the ratio to WHO = "embree" where there is one.
  std::string markdown() const;

 private:
  struct Times {
    std::vector<double> cpu, wall, device;  // seconds of an iteration
    double queries = 0;
  };
  std::vector<std::string> names_;  // as they came first
  std::map<std::string, Times> times_;
};

}  // namespace medial_vk::bench
