#include "tests/trials/dirt.hpp"

#include <cstddef>

namespace flexarm::trials {

namespace {

constexpr double kBefore_s = 1.5;

}  // namespace

/// The recorder is started while the arm moves.
Dirt free_start() {
  return {.name = "free_start", .recording = [](double size, Random& /*random*/, Recording& made) {
            auto& record = made.record;
            const auto before = static_cast<std::ptrdiff_t>(size * kBefore_s / kSampleTime_s);
            if (before == 0) return;
            made.run.initial = measured::InitialState::free;
            record.time_s.resize(record.time_s.size() - static_cast<std::size_t>(before));
            record.torque_N_m.erase(record.torque_N_m.begin(), record.torque_N_m.begin() + before);
            for (auto& channel : record.channels) {
              channel.values.erase(channel.values.begin(), channel.values.begin() + before);
            }
          }};
}

}  // namespace flexarm::trials
