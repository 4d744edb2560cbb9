#include "response/time/lifted_block.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Rows that are linear in X and the torques at the beginning of a sample interval, and in c.
struct AffineRows {
  Eigen::MatrixXd state;
  Eigen::MatrixXd torques;
  Eigen::MatrixXd constants;
};

/// What a sample interval does: X at its end, and what is read in it.
struct IntervalMap {
  AffineRows end;
  AffineRows readings;
};

AffineRows rows(Index count, Index states, Index torques) {
  return {Eigen::MatrixXd::Zero(count, states), Eigen::MatrixXd::Zero(count, torques),
          Eigen::MatrixXd::Zero(count, 2)};
}

/// A reading of the state `now`, where the torque is that in `column`.
void read(const Reading& reading, const AffineRows& now, Index column,
          const Eigen::MatrixXd& forces, Index row, AffineRows& readings) {
  readings.state.row(row).noalias() = reading.state * now.state;
  readings.torques.row(row).noalias() = reading.state * now.torques;
  readings.torques(row, column) += reading.actuator;
  readings.constants.row(row) += reading.state * now.constants + reading.force * forces;
}

/// One inner step of a part, from the torque `begin` to `end`: rows by which the torques of the
/// part, in the columns from `column` on, are multiplied.
void step(const StepTable& table, const Eigen::RowVectorXd& begin, const Eigen::RowVectorXd& end,
          Index column, const Eigen::RowVectorXd& force, AffineRows& now) {
  const Index n = now.state.rows();
  const auto by_state = table.end.leftCols(n);
  now.state = by_state * now.state;
  now.torques = by_state * now.torques;
  now.torques.middleCols(column, begin.size()) +=
      table.end.col(n) * begin + table.end.col(n + 1) * end;
  now.constants = by_state * now.constants + table.end.col(n + 2) * force;
}

/// The torque that far in a part, by the torques of it.
Eigen::RowVectorXd torque_in_part(double passed, Index torques_of_part) {
  if (torques_of_part == 1) return Eigen::RowVectorXd::Ones(1);
  return Eigen::RowVector2d(1.0 - passed, passed);
}

IntervalMap interval_map(const StepPlan& plan, const TorquePath& path, const ReadingTimes& times,
                         const Eigen::VectorXd& offsets) {
  const LinearSystem& system = plan.arm().turning;
  const Index states = plan.arm().size();
  const auto parts = path.edges().size() - 1;
  const Index of_part = path.torques_of_part();
  const Index torques = static_cast<Index>(parts) * of_part;
  const Eigen::MatrixXd forces = constant_forces(plan.forces());
  AffineRows now = rows(states, states, torques);
  now.state.setIdentity();
  const Index watched = plan.forces().has_friction() ? 1 : 0;
  AffineRows readings = rows(offsets.size() + watched, states, torques);
  readings.constants.col(0).head(offsets.size()) = offsets;
  if (watched > 0) readings.state.bottomRows(1) = plan.velocity_row();
  for (std::size_t part = 0; part < parts; ++part) {
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

LiftedBlock lifted_block(const StepPlan& plan, const ArmParts& parts,
                         std::span<const arm::Sensor> sensors, const TorquePath& path,
                         const ReadingTimes& times, Index samples) {
  Eigen::VectorXd offsets(static_cast<Index>(sensors.size()));
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    offsets(static_cast<Index>(j)) = chain_of(parts.sensor_chains, sensors[j]).offset;
  }
  const auto [end, readings] = interval_map(plan, path, times, offsets);
  const Index states = end.state.rows();
  const Index torques = end.torques.cols();
  const Index count = readings.state.rows();

  LiftedBlock made{.end_by_state = end.state,
                   .end_by_torques = Eigen::MatrixXd(states, samples * torques),
                   .end_by_constants = Eigen::MatrixXd::Zero(states, 2),
                   .readings_by_state = Eigen::MatrixXd(samples * count, states),
                   .readings_by_torques = Eigen::MatrixXd::Zero(samples * count, samples * torques),
                   .readings_by_constants = Eigen::MatrixXd(samples * count, 2)};
  // What the torques of an interval do to X, and to the readings, so many intervals later.
  Eigen::MatrixXd carried = end.torques;
  std::vector<Eigen::MatrixXd> responses = {readings.torques};
  Eigen::MatrixXd seen = readings.state;  // of X at the beginning of the block
  for (Index i = 0; i < samples; ++i) {
    for (Index j = 0; j < count; ++j) {
      const Index row = j * samples + i;
      made.readings_by_state.row(row) = seen.row(j);
      made.readings_by_constants.row(row) =
          readings.constants.row(j) + readings.state.row(j) * made.end_by_constants;
      for (Index k = 0; k <= i; ++k) {
        made.readings_by_torques.block(row, k * torques, 1, torques) =
            responses[static_cast<std::size_t>(i - k)].row(j);
      }
    }
    made.end_by_torques.middleCols((samples - 1 - i) * torques, torques) = carried;
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

void put_readings(const Eigen::Ref<const Eigen::VectorXd>& of_intervals, std::ptrdiff_t first,
                  std::ptrdiff_t samples_later, Eigen::Ref<Eigen::VectorXd> made) {
  const Index shift = first + samples_later;
  const Index from = std::max<Index>(0, -shift);
  const Index count = std::min(of_intervals.size(), made.size() - shift) - from;
  if (count > 0) made.segment(from + shift, count) = of_intervals.segment(from, count);
}

}  // namespace flexarm::response
