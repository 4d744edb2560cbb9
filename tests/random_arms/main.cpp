// The program `random_arms`: whether the three formulations agree on arms drawn by chance.
#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"
#include "tests/random_arms/agreement.hpp"
#include "tests/random_arms/random_arm.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace flexarm::random_arms {

namespace {

struct RunOptions {
  std::uint64_t count = 10000;
  std::uint64_t first = 0;
  std::uint64_t seed = 1;
  unsigned jobs = 1;
  std::size_t shown = 10;
  std::string out;
};

std::vector<Agreement> computed(const RunOptions& options) {
  std::vector<Agreement> all(options.count);
  std::atomic<std::uint64_t> next{0};
  const bool shows_progress = isatty(STDERR_FILENO) != 0;
  const auto work = [&] {
    for (std::uint64_t k = next++; k < options.count; k = next++) {
      all[k] = agreement_of(random_arm(options.seed, options.first + k));
      if (shows_progress) fmt::print(stderr, "\r{} of {}", k + 1, options.count);
    }
  };
  std::vector<std::jthread> workers;
  for (unsigned k = 0; k < options.jobs; ++k) workers.emplace_back(work);
  workers.clear();
  if (shows_progress) fmt::print(stderr, "\r\033[K");
  return all;
}

/// A message without its numbers, which differ from arm to arm.
std::string reason(const std::string& message) {
  const std::size_t end = message.find(" = ");
  return end == std::string::npos ? message : message.substr(0, end);
}

void print_counts(const std::vector<Agreement>& all) {
  std::map<Outcome, int> outcomes;
  std::map<std::string, int> reasons;
  for (const Agreement& each : all) {
    ++outcomes[each.outcome];
    if (each.refusals.empty()) continue;
    std::string who;
    for (const Refusal& refusal : each.refusals) {
      who += (who.empty() ? "" : ", ") + refusal.formulation;
    }
    ++reasons[fmt::format("{}: {}", who, reason(each.refusals.front().message))];
  }
  fmt::print("arms {}\nagree to {:g} {}\nrefused {}\nstated {}\ndisagree {}\nfailed {}\n",
             all.size(), kRootTolerance, outcomes[Outcome::agree], outcomes[Outcome::refused],
             outcomes[Outcome::stated], outcomes[Outcome::disagree], outcomes[Outcome::failed]);
  fmt::print("\nrefusals\n");
  for (const auto& [text, count] : reasons) fmt::print("{:6} {}\n", count, text);
}

double distance(const Agreement& agreement) {
  if (!agreement.worst) return -1.0;
  const double value = agreement.worst->distance;
  return value >= 0.0 ? value : 1e300;
}

void print_worst(const std::vector<Agreement>& all, const RunOptions& options) {
  std::vector<std::size_t> order(all.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto disagrees = [&](std::size_t k) { return all[k].outcome == Outcome::disagree; };
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t k) {
    return std::pair(disagrees(k), distance(all[k]));
  });
  const auto disagreeing = static_cast<std::size_t>(std::ranges::count_if(order, disagrees));
  fmt::print("\nthose that disagree, and the worst of the others\n");
  for (std::size_t k = 0; k < std::min(disagreeing + options.shown, order.size()); ++k) {
    const Agreement& each = all[order[k]];
    if (!each.worst) break;
    const std::uint64_t index = options.first + order[k];
    const char* outcome = each.outcome == Outcome::stated     ? " (stated)"
                          : each.outcome == Outcome::disagree ? " (DISAGREES)"
                                                              : "";
    fmt::print("arm {}{}: {} of {} and {}, {:.1e}{}\n", index, outcome, each.worst->quantity,
               each.worst->first, each.worst->second, each.worst->distance,
               each.alone.empty() ? "" : "; alone: " + each.alone);
    if (options.out.empty()) continue;
    std::filesystem::create_directories(options.out);
    measured::write_arm_file(
        random_arm(options.seed, index),
        std::filesystem::path(options.out) / fmt::format("arm-{}.toml", index));
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k].outcome != Outcome::failed) continue;
    fmt::print("arm {} failed: {}: {}\n", options.first + k, all[k].refusals.front().formulation,
               all[k].refusals.front().message);
  }
}

}  // namespace

int run(int argc, char** argv) {
  RunOptions options;
  CLI::App app("Whether exact_tf, fem and assumed_modes agree on random arms");
  app.add_option("COUNT", options.count, "Arms");
  app.add_option("--first", options.first, "Index of the first");
  app.add_option("--seed", options.seed, "Seed of the sequence");
  app.add_option("--jobs", options.jobs, "Threads");
  app.add_option("--worst", options.shown,
                 "How many of the worst are listed beside those that disagree");
  app.add_option("--out", options.out, "Folder for the arm files of those");
  CLI11_PARSE(app, argc, argv);
  const auto all = computed(options);
  print_counts(all);
  print_worst(all, options);
  return std::ranges::any_of(all, [](const Agreement& each) {
    return each.outcome == Outcome::disagree || each.outcome == Outcome::failed;
  });
}

}  // namespace flexarm::random_arms

int main(int argc, char** argv) {
  try {
    return flexarm::random_arms::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "random_arms: {}\n", error.what());
    return 2;
  }
}
