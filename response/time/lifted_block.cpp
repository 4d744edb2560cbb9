#include "response/time/lifted_block.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace flexarm::response {

namespace {

using Eigen::Index;

AffineRows rows(Index count, Index states, Index inputs) {
  return {Eigen::MatrixXd::Zero(count, states), Eigen::MatrixXd::Zero(count, inputs),
          Eigen::MatrixXd::Zero(count, 2)};
}

/// A reading of the state `now`, where the torque is that in `column`.
void read(const Reading& reading, const AffineRows& now, Index column,
          const Eigen::MatrixXd& forces, Index row, AffineRows& readings) {
  readings.state.row(row).noalias() = reading.state * now.state;
  readings.inputs.row(row).noalias() = reading.state * now.inputs;
  readings.inputs(row, column) += reading.actuator;
  readings.constants.row(row) += reading.state * now.constants + reading.force * forces;
}

/// One inner step of a part, from the torque `begin` to `end`: rows by which the torques of the
/// part, in the columns from `column` on, are multiplied.
void step(const StepTable& table, const Eigen::RowVectorXd& begin, const Eigen::RowVectorXd& end,
          Index column, const Eigen::RowVectorXd& force, AffineRows& now) {
  const Index n = now.state.rows();
  const auto by_state = table.end.leftCols(n);
  now.state = by_state * now.state;
  now.inputs = by_state * now.inputs;
  now.inputs.middleCols(column, begin.size()) +=
      table.end.col(n) * begin + table.end.col(n + 1) * end;
  now.constants = by_state * now.constants + table.end.col(n + 2) * force;
}

/// The torque that far in a part, by the torques of it.
Eigen::RowVectorXd torque_in_part(double passed, Index torques_of_part) {
  if (torques_of_part == 1) return Eigen::RowVectorXd::Ones(1);
  return Eigen::RowVector2d(1.0 - passed, passed);
}

}  // namespace

Eigen::MatrixXd constant_forces(const AddedForces& forces) {
  const auto of = [&](HubMotion motion) {
    Eigen::VectorXd made;
    forces.form({}, motion, {}, made);
    return made;
  };
  const Eigen::VectorXd forward = of(HubMotion::forward);
  const Eigen::VectorXd backward = of(HubMotion::backward);
  Eigen::MatrixXd made(forward.size(), 2);
  made << 0.5 * (forward + backward), 0.5 * (forward - backward);
  return made;
}

IntervalMap interval_map(const StepPlan& plan, const ArmParts& parts,
                         std::span<const arm::Sensor> sensors, const TorquePath& path,
                         const ReadingTimes& times) {
  Eigen::VectorXd offsets(static_cast<Index>(sensors.size()));
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    offsets(static_cast<Index>(j)) = chain_of(parts.sensor_chains, sensors[j]).offset;
  }
  const LinearSystem& system = plan.arm().turning;
  const Index states = plan.arm().size();
  const auto part_count = path.edges().size() - 1;
  const Index of_part = path.torques_of_part();
  const Index torques = static_cast<Index>(part_count) * of_part;
  const Eigen::MatrixXd forces = constant_forces(plan.forces());
  AffineRows now = rows(states, states, torques);
  now.state.setIdentity();
  const Index watched = plan.forces().has_friction() ? 1 : 0;
  AffineRows readings = rows(offsets.size() + watched, states, torques);
  readings.constants.col(0).head(offsets.size()) = offsets;
  if (watched > 0) readings.state.bottomRows(1) = plan.velocity_row();
  for (std::size_t part = 0; part < part_count; ++part) {
    const Index column = static_cast<Index>(part) * of_part;
    for (std::size_t j = 0; j < system.sensors.size(); ++j) {
      if (path.part_from(times.sensors[j].at) != part) continue;
      read(system.sensors[j], now, column, forces, static_cast<Index>(j), readings);
    }
    const Steps& steps = plan.regular(part).unsettled;
    for (int i = 0; i < steps.count; ++i) {
      const auto at = [&](int behind) {
        return torque_in_part(static_cast<double>(behind) / steps.count, of_part);
      };
      step(steps.turning, at(i), at(i + 1), column, forces.row(0), now);
    }
  }
  return {std::move(now), std::move(readings)};
}

LiftedBlock lifted_block(const IntervalMap& interval, Index samples) {
  const auto& [end, readings] = interval;
  const Index states = end.state.rows();
  const Index inputs = end.inputs.cols();
  const Index count = readings.state.rows();

  LiftedBlock made{.end_by_state = end.state,
                   .end_by_inputs = Eigen::MatrixXd(states, samples * inputs),
                   .end_by_constants = Eigen::MatrixXd::Zero(states, 2),
                   .readings_by_state = Eigen::MatrixXd(samples * count, states),
                   .readings_by_inputs = Eigen::MatrixXd::Zero(samples * count, samples * inputs),
                   .readings_by_constants = Eigen::MatrixXd(samples * count, 2)};
  // What the inputs of an interval do to X, and to the readings, so many intervals later.
  Eigen::MatrixXd carried = end.inputs;
  std::vector<Eigen::MatrixXd> responses = {readings.inputs};
  Eigen::MatrixXd seen = readings.state;  // of X at the beginning of the block
  for (Index i = 0; i < samples; ++i) {
    for (Index j = 0; j < count; ++j) {
      const Index row = j * samples + i;
      made.readings_by_state.row(row) = seen.row(j);
      made.readings_by_constants.row(row) =
          readings.constants.row(j) + readings.state.row(j) * made.end_by_constants;
      for (Index k = 0; k <= i; ++k) {
        made.readings_by_inputs.block(row, k * inputs, 1, inputs) =
            responses[static_cast<std::size_t>(i - k)].row(j);
      }
    }
    made.end_by_inputs.middleCols((samples - 1 - i) * inputs, inputs) = carried;
    responses.emplace_back(readings.state * carried);
    carried = end.state * carried;
    seen = seen * end.state;
    made.end_by_constants = end.state * made.end_by_constants + end.constants;
  }
  for (Index known = 1; known < samples; known *= 2) {
    made.end_by_state = Eigen::MatrixXd(made.end_by_state * made.end_by_state);
  }
  return made;
}

Eigen::MatrixXd read_in_blocks(const LiftedBlock& block, Index samples,
                               const Eigen::MatrixXd& inputs, const Eigen::VectorXd& initial) {
  const Index intervals = inputs.cols();
  const Index blocks = (intervals + samples - 1) / samples;
  Eigen::MatrixXd of_blocks = Eigen::MatrixXd::Zero(samples * inputs.rows(), blocks);
  of_blocks.reshaped().head(inputs.size()) = inputs.reshaped();
  Eigen::MatrixXd states(initial.size(), blocks);
  if (blocks > 0) states.col(0) = initial;
  if (blocks > 1) {
    auto ends = states.rightCols(blocks - 1);
    ends.noalias() = block.end_by_inputs * of_blocks.leftCols(blocks - 1);
    ends.colwise() += block.end_by_constants.col(0);
  }
  for (Index b = 1; b < blocks; ++b) {
    states.col(b).noalias() += block.end_by_state * states.col(b - 1);
  }
  Eigen::MatrixXd read = block.readings_by_state * states;
  read.noalias() += block.readings_by_inputs * of_blocks;
  read.colwise() += block.readings_by_constants.col(0);
  const Index count = read.rows() / samples;
  Eigen::MatrixXd made(intervals, count);
  for (Index j = 0; j < count; ++j) {
    const Eigen::MatrixXd of_reading = read.middleRows(j * samples, samples);
    made.col(j) = of_reading.reshaped().head(intervals);
  }
  return made;
}

void put_readings(const Eigen::Ref<const Eigen::VectorXd>& of_intervals, std::ptrdiff_t first,
                  std::ptrdiff_t samples_later, Eigen::Ref<Eigen::VectorXd> made) {
  const Index shift = first + samples_later;
  const Index from = std::max<Index>(0, -shift);
  const Index count = std::min(of_intervals.size(), made.size() - shift) - from;
  if (count > 0) made.segment(from + shift, count) = of_intervals.segment(from, count);
}

}  // namespace flexarm::response
