#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace flexarm::benchmarks {

/// Prints one line a benchmark: its processor time, the least of its repetitions (what other
/// programs on the machine take only adds), then its counters. Of a benchmark that calls
/// SetComplexityN for three sizes or more it prints at the end the slope of the logarithms of time
/// and of the counters, errors left out, over that of the size, by least squares.
class ScoreTable : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  struct Series {
    std::vector<double> sizes;
    std::map<std::string, std::vector<double>> values;  ///< "time" and the counters
  };
  std::map<std::string, Series> series_;  ///< by the benchmark's name
};

}  // namespace flexarm::benchmarks
