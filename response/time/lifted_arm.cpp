#include "response/time/lifted_arm.hpp"

#include "response/time/added_forces.hpp"

#include <algorithm>
#include <vector>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Rows that are linear in (X; torques; 1) at the beginning of a sample interval.
struct AffineRows {
  Eigen::MatrixXd state;
  Eigen::MatrixXd torques;
  Eigen::VectorXd constant;
};

/// What a sample interval does: X at its end, and what is read in it, a row a sensor.
struct IntervalMap {
  AffineRows end;
  AffineRows readings;
};

AffineRows rows(Index count, Index states, Index torques) {
  return {Eigen::MatrixXd::Zero(count, states), Eigen::MatrixXd::Zero(count, torques),
          Eigen::VectorXd::Zero(count)};
}

/// Writes the readings of `sensors` that are taken where a part of the interval begins, with the
/// state `now` and the torque in column `column`.
void read_part(const ReadingTimes& times, const TorquePath& path, std::size_t part,
               const AffineRows& now, const LinearSystem& system, const Eigen::VectorXd& force,
               Index column, AffineRows& readings) {
  for (std::size_t j = 0; j < system.sensors.size(); ++j) {
    if (path.part_from(times.sensors[j].at) != part) continue;
    const auto row = static_cast<Index>(j);
    const Reading& reading = system.sensors[j];
    readings.state.row(row).noalias() = reading.state * now.state;
    readings.torques.row(row).noalias() = reading.state * now.torques;
    readings.torques(row, column) += reading.actuator;
    readings.constant(row) += reading.state.dot(now.constant) + reading.force.dot(force);
  }
}

/// One inner step of a part, from the torque `begin` to `end`: rows by which the torques of the
/// part, in the columns from `column` on, are multiplied.
void step(const StepTable& table, const Eigen::RowVectorXd& begin, const Eigen::RowVectorXd& end,
          Index column, double force, AffineRows& now) {
  const Index n = now.state.rows();
  const auto by_state = table.end.leftCols(n);
  now.state = by_state * now.state;
  now.torques = by_state * now.torques;
  now.torques.middleCols(column, begin.size()) +=
      table.end.col(n) * begin + table.end.col(n + 1) * end;
  now.constant = by_state * now.constant + table.end.col(n + 2) * force;
}

/// The torque that far in a part, by the torques of it.
Eigen::RowVectorXd torque_in_part(double passed, Index torques_of_part) {
  if (torques_of_part == 1) return Eigen::RowVectorXd::Ones(1);
  return Eigen::RowVector2d(1.0 - passed, passed);
}

IntervalMap interval_map(const StepPlan& plan, const TorquePath& path, const ReadingTimes& times,
                         const Eigen::VectorXd& offsets) {
  const ModalDynamics& arm = plan.arm();
  const Index states = arm.size();
  const auto parts = path.edges().size() - 1;
  const Index of_part = path.torques_of_part();
  const Index torques = static_cast<Index>(parts) * of_part;
  Eigen::VectorXd force;
  plan.forces().form({}, HubMotion::frictionless, {}, force);
  AffineRows now = rows(states, states, torques);
  now.state.setIdentity();
  IntervalMap made{.end = {}, .readings = rows(offsets.size(), states, torques)};
  made.readings.constant = offsets;
  for (std::size_t part = 0; part < parts; ++part) {
    const Index column = static_cast<Index>(part) * of_part;
    read_part(times, path, part, now, arm.turning, force, column, made.readings);
    const Steps& steps = plan.regular(part).unsettled;
    for (int i = 0; i < steps.count; ++i) {
      const auto at = [&](int behind) {
        return torque_in_part(static_cast<double>(behind) / steps.count, of_part);
      };
      step(steps.turning, at(i), at(i + 1), column, force(0), now);
    }
  }
  made.end = std::move(now);
  return made;
}

}  // namespace

LiftedArm::LiftedArm(const StepPlan& plan, const ArmParts& parts,
                     std::span<const arm::Sensor> sensors, const TorquePath& path,
                     const ReadingTimes& times)
    : times_(times) {
  Eigen::VectorXd offsets(static_cast<Index>(sensors.size()));
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    offsets(static_cast<Index>(j)) = chain_of(parts.sensor_chains, sensors[j]).offset;
  }
  const auto [end, readings] = interval_map(plan, path, times, offsets);
  const Index states = end.state.rows();
  const Index torques = end.torques.cols();
  const Index count = offsets.size();

  // The effect of the torques of an interval, and of the constant, on X and on the readings k
  // intervals later.
  Eigen::MatrixXd carried = end.torques;
  Eigen::VectorXd constant = Eigen::VectorXd::Zero(states);
  Eigen::MatrixXd seen = readings.state;  // of X at the beginning of the block
  std::vector<Eigen::MatrixXd> responses = {readings.torques};
  end_by_torques_.resize(states, kSamples * torques);
  readings_by_state_.resize(kSamples * count, states);
  readings_by_torques_ = Eigen::MatrixXd::Zero(kSamples * count, kSamples * torques);
  readings_constant_.resize(kSamples * count);
  for (Index i = 0; i < kSamples; ++i) {
    for (Index j = 0; j < count; ++j) {
      const Index row = j * kSamples + i;
      readings_by_state_.row(row) = seen.row(j);
      readings_constant_(row) = readings.constant(j) + readings.state.row(j).dot(constant);
      for (Index k = 0; k <= i; ++k) {
        readings_by_torques_.block(row, k * torques, 1, torques) =
            responses[static_cast<std::size_t>(i - k)].row(j);
      }
    }
    end_by_torques_.middleCols((kSamples - 1 - i) * torques, torques) = carried;
    responses.emplace_back(readings.state * carried);
    carried = end.state * carried;
    seen = seen * end.state;
    constant = end.state * constant + end.constant;
  }
  end_constant_ = constant;
  end_by_state_ = end.state;
  for (Index known = 1; known < kSamples; known *= 2) {
    end_by_state_ = Eigen::MatrixXd(end_by_state_ * end_by_state_);
  }
}

void LiftedArm::read(const Eigen::MatrixXd& torques, std::ptrdiff_t first,
                     const Eigen::VectorXd& initial, Eigen::MatrixXd& made) const {
  const Index intervals = torques.cols();
  const Index blocks = (intervals + kSamples - 1) / kSamples;
  Eigen::MatrixXd inputs = Eigen::MatrixXd::Zero(kSamples * torques.rows(), blocks);
  inputs.reshaped().head(torques.size()) = torques.reshaped();
  Eigen::MatrixXd states(initial.size(), blocks);
  states.col(0) = initial;
  if (blocks > 1) {
    states.rightCols(blocks - 1).noalias() = end_by_torques_ * inputs.leftCols(blocks - 1);
    states.rightCols(blocks - 1).colwise() += end_constant_;
  }
  for (Index b = 1; b < blocks; ++b) {
    states.col(b).noalias() += end_by_state_ * states.col(b - 1);
  }
  Eigen::MatrixXd read = readings_by_state_ * states;
  read.noalias() += readings_by_torques_ * inputs;
  read.colwise() += readings_constant_;
  for (Index j = 0; j < made.cols(); ++j) {
    const Eigen::MatrixXd of_sensor = read.middleRows(j * kSamples, kSamples);
    const Index shift = first + times_.sensors[static_cast<std::size_t>(j)].samples_later;
    const Index from = std::max<Index>(0, -shift);
    const Index count = std::min(intervals, made.rows() - shift) - from;
    if (count <= 0) continue;
    made.col(j).segment(from + shift, count) = of_sensor.reshaped().segment(from, count);
  }
}

}  // namespace flexarm::response
