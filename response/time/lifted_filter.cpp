#include "response/time/lifted_filter.hpp"

#include <algorithm>
#include <cstddef>

namespace flexarm::response {

using Eigen::Index;

LiftedFilter::LiftedFilter(const IntervalMap& interval, std::optional<Index> forgotten,
                           const Eigen::MatrixXd& shown)
    : interval_(interval), shown_(shown) {
  if (!forgotten) return;
  AffineRows& end = interval_.end;
  for (auto* matrix : {&end.state, &end.inputs, &end.constants}) matrix->row(*forgotten).setZero();
}

IntervalMap LiftedFilter::closed_by(const FilterGain& filter) const {
  const auto& [end, read] = interval_;
  const Index states = end.state.rows();
  const Index sensors = read.state.rows();
  const Index torques = end.inputs.cols();
  // x+ = state x + inputs (u; y) + constants c.
  AffineRows corrected{Eigen::MatrixXd::Identity(states, states) - filter.gain * read.state,
                       Eigen::MatrixXd(states, torques + sensors), -filter.gain * read.constants};
  corrected.inputs << -filter.gain * read.inputs, filter.gain;

  IntervalMap made;
  made.end = {end.state * corrected.state, end.state * corrected.inputs,
              end.state * corrected.constants + end.constants};
  made.end.inputs.leftCols(torques) += end.inputs;
  AffineRows& shown = made.readings;
  shown.state.resize(sensors + shown_.rows(), states);
  shown.state << -read.state, shown_ * corrected.state;
  shown.inputs.resize(sensors + shown_.rows(), torques + sensors);
  shown.inputs << -read.inputs, Eigen::MatrixXd::Identity(sensors, sensors),
      shown_ * corrected.inputs;
  shown.constants.resize(sensors + shown_.rows(), read.constants.cols());
  shown.constants << -read.constants, shown_ * corrected.constants;
  return made;
}

Eigen::MatrixXd LiftedFilter::follow(const Eigen::MatrixXd& torques,
                                     const Eigen::MatrixXd& measured,
                                     const FilterGains& gains) const {
  const Index samples = measured.rows();
  Eigen::MatrixXd inputs(torques.rows() + measured.cols(), samples);
  inputs << torques, measured.transpose();
  Eigen::MatrixXd made(samples, measured.cols() + shown_.rows());
  Eigen::VectorXd state = Eigen::VectorXd::Zero(interval_.end.state.rows());
  const Index begun = std::min(samples, static_cast<Index>(gains.first.size()));
  const auto& [end, read] = interval_;
  for (Index k = 0; k < begun; ++k) {
    const auto torque = torques.col(k);
    const Eigen::VectorXd innovation = measured.row(k).transpose() - read.state * state -
                                       read.inputs * torque - read.constants.col(0);
    state += gains.first[static_cast<std::size_t>(k)].gain * innovation;
    made.row(k) << innovation.transpose(), (shown_ * state).transpose();
    state = (end.state * state + end.inputs * torque + end.constants.col(0)).eval();
  }
  if (begun == samples) return made;
  made.bottomRows(samples - begun) =
      read_in_blocks(lifted_block(closed_by(gains.steady), kSamples), kSamples,
                     inputs.rightCols(samples - begun), state);
  return made;
}

}  // namespace flexarm::response
