#include "response/time/torque_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace flexarm::response {

namespace {

/// A delay this near to whole samples is whole samples: delay/sample_time is rounded that much.
constexpr double kWholeSample = 1e-9;

}  // namespace

TorquePath::TorquePath(const Actuator& actuator, std::span<const double> torque_N_m,
                       double sample_time_s, TorqueHold hold)
    : actuator_(actuator), torque_N_m_(torque_N_m), hold_(hold) {
  const double delay = actuator.delay_s / sample_time_s;
  delay_samples_ = std::floor(delay);
  delay_fraction_ = delay - delay_samples_;
  if (delay_fraction_ > 1.0 - kWholeSample) delay_samples_ += 1.0;
  if (delay_fraction_ < kWholeSample || delay_fraction_ > 1.0 - kWholeSample) delay_fraction_ = 0.0;
}

double TorquePath::clipped(double command_N_m) const {
  const double size = std::max(0.0, std::abs(command_N_m) - actuator_.dead_zone_N_m);
  return std::copysign(std::min(size, actuator_.saturation_N_m), command_N_m);
}

/// `command` is delayed and multiplied by the gain, but not yet clipped.
void TorquePath::add(TorquePiece command, Pieces& pieces) const {
  const double from = command.begin_N_m;
  const double to = command.end_N_m;
  const double limit = actuator_.dead_zone_N_m + actuator_.saturation_N_m;
  std::array edges = {-limit, -actuator_.dead_zone_N_m, actuator_.dead_zone_N_m, limit};
  if (to < from) std::ranges::reverse(edges);
  std::array<double, 5> breaks = {};
  std::size_t count = 0;
  for (const double edge : edges) {
    const bool is_crossed = (edge - from) * (edge - to) < 0.0;
    const bool is_corner = std::isfinite(edge) && (edge != 0.0 || actuator_.dead_zone_N_m > 0.0);
    if (is_crossed && is_corner) breaks[count++] = (edge - from) / (to - from);
  }
  breaks[count++] = 1.0;
  const double begin = command.begin;
  const double length = command.end - command.begin;
  double done = 0.0;
  for (const double s : std::span(breaks).first(count)) {
    if (s <= done) continue;
    TorquePiece piece = command;
    piece.begin = begin + done * length;
    piece.end = s == 1.0 ? command.end : begin + s * length;
    piece.begin_N_m = clipped(from + done * (to - from));
    piece.end_N_m = clipped(s == 1.0 ? to : from + s * (to - from));
    if (count > 1) piece.length = TorquePiece::Length::other;
    if (piece.end > piece.begin) pieces.push_back(piece);
    done = s;
  }
}

void TorquePath::pieces(std::size_t k, Pieces& pieces) const {
  pieces.clear();
  // The delayed command from sample j to j + 1, from `s` to `e` of the way.
  const auto command = [&](double j, double s, double e, TorquePiece::Length length, double begin,
                           double end) {
    if (j < 0.0) {
      add({begin, end, 0.0, 0.0, length}, pieces);
      return;
    }
    const auto at = static_cast<std::size_t>(j);
    const double left = actuator_.gain * torque_N_m_[at];
    const double right = hold_ == TorqueHold::first && at + 1 < torque_N_m_.size()
                             ? actuator_.gain * torque_N_m_[at + 1]
                             : left;
    add({begin, end, left + s * (right - left), left + e * (right - left), length}, pieces);
  };
  const double j = static_cast<double>(k) - delay_samples_;
  if (delay_fraction_ == 0.0) {
    command(j, 0.0, 1.0, TorquePiece::Length::whole, 0.0, 1.0);
    return;
  }
  command(j - 1.0, 1.0 - delay_fraction_, 1.0, TorquePiece::Length::before_delay, 0.0,
          delay_fraction_);
  command(j, 0.0, 1.0 - delay_fraction_, TorquePiece::Length::after_delay, delay_fraction_, 1.0);
}

}  // namespace flexarm::response
