#include "measured/modal/block_signals.hpp"

#include "measured/modal/held_response.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr Index kChunk = 256;  // rows that stay in the second-level cache with 60 columns

struct TimeRows {
  const TimeRecord& record;
  std::vector<Index> sensors;
  TorqueHold hold;
  bool free;
  Index samples;

  double torque(Index k) const {
    return record.torque_N_m[static_cast<std::size_t>(std::clamp<Index>(k, 0, samples - 1))];
  }

  void fill_block(const HeldResponse& step, Eigen::Vector4d& x, double drive, Index first,
                  Eigen::Ref<Eigen::MatrixXd> columns) const {
    for (Index r = 0; r < columns.rows(); ++r) {
      columns.row(r) = x.head(columns.cols());
      step.step(x, drive * torque(first + r), drive * torque(first + r + 1));
    }
  }

  void fill_rest(const SignalLayout& layout, Index first, Eigen::MatrixXd& rows) const {
    for (Index r = 0; r < rows.rows(); ++r) {
      const Index k = first + r;
      rows(r, layout.torque()) = torque(k);
      const bool before = hold == TorqueHold::zero;
      rows(r, layout.remainder()) = before && k == 0 ? 0.0 : torque(before ? k - 1 : k);
      rows(r, layout.one()) = 1.0;
      for (std::size_t j = 0; j < sensors.size(); ++j) {
        rows(r, layout.first_reading() + static_cast<Index>(j)) =
            record.channels[static_cast<std::size_t>(j)].values[static_cast<std::size_t>(k)];
      }
    }
  }

  void operator()(const BlockSet& set, const RowVisitor& visitor) const {
    const std::vector<SecondOrderBlock>& blocks = set.blocks;
    const SignalLayout layout = SignalLayout::of(set, free);
    const double period_s = sampling_period_s(record);
    std::vector<HeldResponse> steps;
    for (const auto& block : blocks) steps.emplace_back(block, period_s, hold);
    std::vector<Eigen::Vector4d> forced(blocks.size(), Eigen::Vector4d::Zero());
    std::vector<Eigen::Vector4d> kicked(blocks.size(), Eigen::Vector4d(0.0, 1.0, 0.0, 0.0));
    Eigen::MatrixXd rows;
    for (Index first = 0; first < samples; first += kChunk) {
      rows.resize(std::min(kChunk, samples - first),
                  layout.first_reading() + static_cast<Index>(sensors.size()));
      for (std::size_t m = 0; m < blocks.size(); ++m) {
        fill_block(steps[m], forced[m], 1.0, first,
                   rows.middleCols(layout.block(m, false), set.is_held(m) ? 2 : 4));
        if (free && !set.is_held(m)) {
          fill_block(steps[m], kicked[m], 0.0, first, rows.middleCols<4>(layout.block(m, true)));
        }
      }
      fill_rest(layout, first, rows);
      visitor(rows);
    }
  }
};

struct FrequencyRows {
  const FrequencyChannel& channel;
  std::vector<std::size_t> lines;
  // Of the lines.
  Eigen::ArrayXd omega_rad_per_s;
  Eigen::ArrayXd weight;  ///< 1/deviation

  FrequencyRows(const FrequencyChannel& of, std::vector<std::size_t> taken,
                const std::vector<double>& deviation)
      : channel(of),
        lines(std::move(taken)),
        omega_rad_per_s(static_cast<Index>(lines.size())),
        weight(static_cast<Index>(lines.size())) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto at = static_cast<Index>(i);
      omega_rad_per_s(at) = 2.0 * std::numbers::pi * channel.frequency_Hz[lines[i]];
      weight(at) = 1.0 / deviation[lines[i]];
    }
  }

  void operator()(const BlockSet& set, const RowVisitor& visitor) const {
    const SignalLayout layout = SignalLayout::of(set, false);
    const int derivatives = arm::derivative_order(channel.sensor);
    Eigen::MatrixXd rows;
    for (Index first = 0; first < weight.size(); first += kChunk / 2) {
      const Index count = std::min(kChunk / 2, weight.size() - first);
      const Eigen::ArrayXd omega = omega_rad_per_s.segment(first, count);
      rows.setZero(2 * count, layout.first_reading() + 1);
      const auto put = [&](Index column, const Eigen::ArrayXd& real, const Eigen::ArrayXd& imag) {
        rows(Eigen::seqN(0, count, 2), column) = weight.segment(first, count) * real;
        rows(Eigen::seqN(1, count, 2), column) = weight.segment(first, count) * imag;
      };
      const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(count);
      const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(count);
      for (std::size_t m = 0; m < set.blocks.size(); ++m) {
        // 1/(a0 - omega^2 + j a1 omega)
        const Eigen::ArrayXd real = set.blocks[m].a0_rad2_per_s2 - omega.square();
        const Eigen::ArrayXd imag = set.blocks[m].a1_rad_per_s * omega;
        const Eigen::ArrayXd square = real.square() + imag.square();
        const Eigen::ArrayXd q_real = real / square;
        const Eigen::ArrayXd q_imag = -imag / square;
        const Index column = layout.block(m, false);
        put(column, q_real, q_imag);
        put(column + 1, -omega * q_imag, omega * q_real);
        if (set.is_held(m)) continue;
        const Eigen::ArrayXd p_real = q_real.square() - q_imag.square();
        const Eigen::ArrayXd p_imag = 2.0 * q_real * q_imag;
        put(column + 2, p_real, p_imag);
        put(column + 3, -omega * p_imag, omega * p_real);
      }
      put(layout.torque(), ones, none);
      if (derivatives == 0) put(layout.remainder(), ones, none);
      if (derivatives == 1) put(layout.remainder(), none, omega);
      if (derivatives == 2) put(layout.remainder(), -omega.square(), none);
      for (Index r = 0; r < count; ++r) {
        const Complex own = channel.response[lines[static_cast<std::size_t>(first + r)]];
        rows(2 * r, layout.first_reading()) = weight(first + r) * own.real();
        rows(2 * r + 1, layout.first_reading()) = weight(first + r) * own.imag();
      }
      visitor(rows);
    }
  }
};

}  // namespace

Stretch time_stretch(const TimeRecord& record, std::vector<Index> sensors, TorqueHold hold,
                     InitialState initial, std::size_t samples) {
  const bool free = initial == InitialState::free;
  const auto count = static_cast<Index>(std::min(samples, record.time_s.size()));
  return {.sensors = sensors,
          .begins_in_motion = free,
          .in_time = true,
          .rows = count,
          .duration_s = static_cast<double>(count) * sampling_period_s(record),
          .visit = TimeRows{record, sensors, hold, free, count}};
}

Stretch frequency_stretch(const FrequencyChannel& channel, Index sensor,
                          const std::vector<double>& deviation) {
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < channel.frequency_Hz.size(); ++k) {
    if (channel.frequency_Hz[k] > 0.0 && std::isfinite(deviation[k])) lines.push_back(k);
  }
  const auto rows = 2 * static_cast<Index>(lines.size());
  return {.sensors = {sensor},
          .begins_in_motion = false,
          .in_time = false,
          .rows = rows,
          .duration_s = 0.0,
          .visit = FrequencyRows(channel, std::move(lines), deviation)};
}

Eigen::MatrixXd triangle(const Stretch& stretch, const BlockSet& blocks) {
  const Index columns =
      stretch.layout(blocks).first_reading() + static_cast<Index>(stretch.sensors.size());
  Eigen::MatrixXd work = Eigen::MatrixXd::Zero(columns + kChunk, columns);
  stretch.visit(blocks, [&](const Eigen::Ref<const Eigen::MatrixXd>& rows) {
    work.middleRows(columns, rows.rows()) = rows;
    work.bottomRows(kChunk - rows.rows()).setZero();
    const Eigen::HouseholderQR<Eigen::Ref<Eigen::MatrixXd>> in_place(work);
    work.topRows(columns).triangularView<Eigen::StrictlyLower>().setZero();
  });
  return work.topRows(columns);
}

std::vector<Eigen::MatrixXd> triangles(std::span<const Stretch> stretches, const BlockSet& blocks) {
  std::vector<Eigen::MatrixXd> made;
  for (const Stretch& stretch : stretches) made.push_back(triangle(stretch, blocks));
  return made;
}

}  // namespace flexarm::measured
