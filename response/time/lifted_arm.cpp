#include "response/time/lifted_arm.hpp"

namespace flexarm::response {

using Eigen::Index;

void LiftedArm::read(const Eigen::MatrixXd& torques, std::ptrdiff_t first,
                     const Eigen::VectorXd& initial, Eigen::MatrixXd& made) const {
  const Index intervals = torques.cols();
  const Index blocks = (intervals + kSamples - 1) / kSamples;
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(kSamples * torques.rows(), blocks);
  inputs.reshaped().head(torques.size()) = torques.reshaped();
  Eigen::MatrixXd states(initial.size(), blocks);
  states.col(0) = initial;
  if (blocks > 1) {
    auto ends = states.rightCols(blocks - 1);
    ends.noalias() = block_.end_by_torques * inputs.leftCols(blocks - 1);
    ends.colwise() += block_.end_by_constants.col(0);
  }
  for (Index b = 1; b < blocks; ++b) {
    states.col(b).noalias() += block_.end_by_state * states.col(b - 1);
  }
  Eigen::MatrixXd read = block_.readings_by_state * states;
  read.noalias() += block_.readings_by_torques * inputs;
  read.colwise() += block_.readings_by_constants.col(0);
  for (Index j = 0; j < made.cols(); ++j) {
    const Eigen::MatrixXd of_sensor = read.middleRows(j * kSamples, kSamples);
    put_readings(of_sensor.reshaped().head(intervals), first,
                 times_.sensors[static_cast<std::size_t>(j)].samples_later, made.col(j));
  }
}

}  // namespace flexarm::response
