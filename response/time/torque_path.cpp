#include "response/time/torque_path.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::response {

TorquePath::TorquePath(const Actuator& actuator, std::span<const double> torque_N_m,
                       double sample_time_s, TorqueHold hold, std::span<const double> cuts)
    : actuator_(actuator),
      bends_(actuator.bends()),
      torque_N_m_(torque_N_m),
      hold_(hold),
      delay_(sample_delay(actuator.delay_s, sample_time_s)),
      edges_({0.0, 1.0}) {
  const auto divide = [this](double at) {
    if (std::abs(edges_[part_from(at)] - at) < 0.5 * kSameInstant) return;
    edges_.insert(std::ranges::upper_bound(edges_, at), at);
  };
  divide(delay_.fraction);
  for (const double cut : cuts) divide(cut);
}

std::size_t TorquePath::part_from(double cut) const {
  const auto nearest =
      std::ranges::min_element(edges_, {}, [cut](double edge) { return std::abs(edge - cut); });
  return static_cast<std::size_t>(nearest - edges_.begin());
}

double TorquePath::acting_sample(std::ptrdiff_t k, std::size_t part) const {
  const bool is_of_sample_before = edges_[part] < delay_.fraction;
  const double sample =
      static_cast<double>(k) - delay_.samples - (is_of_sample_before ? 1.0 : 0.0);
  return std::min(sample, static_cast<double>(torque_N_m_.size()) - 1.0);
}

TorquePiece TorquePath::command(std::ptrdiff_t k, std::size_t part) const {
  const double begin = edges_[part];
  const double end = edges_[part + 1];
  const double j = acting_sample(k, part);
  if (j < 0.0) return {begin, end, 0.0, 0.0, part};
  // How far it is from that sample to the next one.
  const double ahead = (begin < delay_.fraction ? 1.0 : 0.0) - delay_.fraction;
  const auto at = static_cast<std::size_t>(j);
  const double left = torque_N_m_[at];
  const double right =
      hold_ == TorqueHold::first && at + 1 < torque_N_m_.size() ? torque_N_m_[at + 1] : left;
  const auto between = [&](double fraction) { return left + fraction * (right - left); };
  const double to = end == delay_.fraction ? 1.0 : end + ahead;  // to the last bit
  return {begin, end, between(begin + ahead), between(to), part};
}

void TorquePath::add(const TorquePiece& command, Pieces& pieces) const {
  const double from = command.begin_N_m;
  const double to = command.end_N_m;
  std::vector<double> breaks;
  for (const double bend : bends_) {
    if ((bend - from) * (bend - to) < 0.0) breaks.push_back((bend - from) / (to - from));
  }
  if (to < from) std::ranges::reverse(breaks);
  const double begin = command.begin;
  const double length = command.end - command.begin;
  double done = 0.0;
  for (std::size_t i = 0; i <= breaks.size(); ++i) {
    const double s = i < breaks.size() ? breaks[i] : 1.0;
    if (s <= done) continue;
    TorquePiece piece = command;
    piece.begin = begin + done * length;
    piece.end = s == 1.0 ? command.end : begin + s * length;
    piece.begin_N_m = actuator_.mapped(from + done * (to - from));
    piece.end_N_m = actuator_.mapped(s == 1.0 ? to : from + s * (to - from));
    piece.is_whole_part = breaks.empty();
    if (piece.end > piece.begin) pieces.push_back(piece);
    done = s;
  }
}

void TorquePath::pieces(std::ptrdiff_t k, Pieces& pieces) const {
  pieces.clear();
  for (std::size_t part = 0; part + 1 < edges_.size(); ++part) add(command(k, part), pieces);
}

std::optional<Eigen::MatrixXd> TorquePath::whole_parts(std::ptrdiff_t first) const {
  if (hold_ == TorqueHold::zero) return held_parts(first);
  const std::size_t parts = edges_.size() - 1;
  const std::ptrdiff_t intervals = std::ssize(torque_N_m_) - first;
  Eigen::MatrixXd made(static_cast<Eigen::Index>(parts) * torques_of_part(), intervals);
  for (std::ptrdiff_t i = 0; i < intervals; ++i) {
    Eigen::Index row = 0;
    for (std::size_t part = 0; part < parts; ++part) {
      const TorquePiece piece = command(first + i, part);
      const auto is_within = [&](double bend) {
        return (bend - piece.begin_N_m) * (bend - piece.end_N_m) < 0.0;
      };
      if (std::ranges::any_of(bends_, is_within)) return std::nullopt;
      made(row++, i) = actuator_.mapped(piece.begin_N_m);
      made(row++, i) = actuator_.mapped(piece.end_N_m);
    }
  }
  return made;
}

Eigen::MatrixXd TorquePath::held_parts(std::ptrdiff_t first) const {
  const auto parts = std::ssize(edges_) - 1;
  const std::ptrdiff_t intervals = std::ssize(torque_N_m_) - first;
  const double before_run_N_m = actuator_.mapped(0.0);
  Eigen::MatrixXd made(parts, intervals);
  for (std::ptrdiff_t part = 0; part < parts; ++part) {
    for (std::ptrdiff_t i = 0; i < intervals; ++i) {
      const double j = acting_sample(first + i, static_cast<std::size_t>(part));
      made(part, i) =
          j < 0.0 ? before_run_N_m : actuator_.mapped(torque_N_m_[static_cast<std::size_t>(j)]);
    }
  }
  return made;
}

}  // namespace flexarm::response
