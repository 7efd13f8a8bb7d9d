// Collects the runs of bench/queries/queries.cpp and prints their medians as a markdown table.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace medial_vk::bench {

/// Benchmarks are named MESH/QUERIES/WHO, and the counter "queries" is the number of queries per iteration.
class QueryTable : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;
  /// Rates per CPU-second and per second of wall time, in millions, and the ratio to WHO = "embree" if present.
  std::string markdown() const;

 private:
  struct Times {
    std::vector<double> cpu, wall, device;  // seconds per iteration
    double queries = 0;
  };
  std::vector<std::string> names_;  // in order of first appearance
  std::map<std::string, Times> times_;
};

}  // namespace medial_vk::bench
