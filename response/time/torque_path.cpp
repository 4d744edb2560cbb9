#include "response/time/torque_path.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::response {

namespace {

/// A delay this near to whole samples is whole samples: delay/sample_time is rounded that much.
constexpr double kWholeSample = 1e-9;

}  // namespace

TorquePath::TorquePath(const Actuator& actuator, std::span<const double> torque_N_m,
                       double sample_time_s, TorqueHold hold)
    : actuator_(actuator), bends_(actuator.bends()), torque_N_m_(torque_N_m), hold_(hold) {
  const double delay = actuator.delay_s / sample_time_s;
  delay_samples_ = std::floor(delay);
  delay_fraction_ = delay - delay_samples_;
  if (delay_fraction_ > 1.0 - kWholeSample) delay_samples_ += 1.0;
  if (delay_fraction_ < kWholeSample || delay_fraction_ > 1.0 - kWholeSample) delay_fraction_ = 0.0;
}

/// `command` is delayed, but not yet mapped.
void TorquePath::add(TorquePiece command, Pieces& pieces) const {
  const double from = command.begin_N_m;
  const double to = command.end_N_m;
  std::vector<double> breaks;
  for (const double bend : bends_) {
    if ((bend - from) * (bend - to) < 0.0) breaks.push_back((bend - from) / (to - from));
  }
  if (to < from) std::ranges::reverse(breaks);
  breaks.push_back(1.0);
  const double begin = command.begin;
  const double length = command.end - command.begin;
  double done = 0.0;
  for (const double s : breaks) {
    if (s <= done) continue;
    TorquePiece piece = command;
    piece.begin = begin + done * length;
    piece.end = s == 1.0 ? command.end : begin + s * length;
    piece.begin_N_m = actuator_.mapped(from + done * (to - from));
    piece.end_N_m = actuator_.mapped(s == 1.0 ? to : from + s * (to - from));
    if (breaks.size() > 1) piece.length = TorquePiece::Length::other;
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
    const double left = torque_N_m_[at];
    const double right =
        hold_ == TorqueHold::first && at + 1 < torque_N_m_.size() ? torque_N_m_[at + 1] : left;
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
