// Prints the nanoseconds that one call of ExactArm::poles takes, as the smallest mean of several
// repetitions: poles_timing CALLS REPETITIONS.
#include "arm/arm.hpp"
#include "exact_tf/exact_arm.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const int calls = std::atoi(argv[1]);
  const int repetitions = std::atoi(argv[2]);
  const flexarm::exact_tf::ExactArm exact(flexarm::arm::paper_arm());
  double least_ns = std::numeric_limits<double>::infinity();
  double sum = 0.0;  // so that no call is left out
  for (int r = 0; r < repetitions; ++r) {
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) sum += exact.poles(1).omega_rad_per_s.front();
    const std::chrono::duration<double, std::nano> elapsed =
        std::chrono::steady_clock::now() - begun;
    least_ns = std::min(least_ns, elapsed.count() / calls);
  }
  std::printf("%.1f\n", least_ns);
  return sum > 0.0 ? 0 : 1;
}
