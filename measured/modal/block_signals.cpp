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
  std::vector<double> deviation;
  std::vector<std::size_t> lines;

  void operator()(const BlockSet& set, const RowVisitor& visitor) const {
    const SignalLayout layout = SignalLayout::of(set, false);
    const int derivatives = arm::derivative_order(channel.sensor);
    const Index columns = layout.first_reading() + 1;
    Eigen::VectorXcd row(columns);
    Eigen::MatrixXd rows;
    for (std::size_t first = 0; first < lines.size(); first += kChunk / 2) {
      const std::size_t count = std::min<std::size_t>(kChunk / 2, lines.size() - first);
      rows.resize(2 * static_cast<Index>(count), columns);
      for (std::size_t r = 0; r < count; ++r) {
        const std::size_t k = lines[first + r];
        const Complex s(0.0, 2.0 * std::numbers::pi * channel.frequency_Hz[k]);
        for (std::size_t m = 0; m < set.blocks.size(); ++m) {
          const Complex q = set.blocks[m].value(s);
          row.segment<2>(layout.block(m, false)) << q, s * q;
          if (!set.is_held(m)) row.segment<2>(layout.block(m, false) + 2) << q * q, s * q * q;
        }
        row(layout.torque()) = 1.0;
        row(layout.remainder()) = derivatives == 0 ? 1.0 : derivatives == 1 ? s : s * s;
        row(layout.one()) = 0.0;
        row(layout.first_reading()) = channel.response[k];
        row /= deviation[k];
        rows.row(2 * static_cast<Index>(r)) = row.real();
        rows.row(2 * static_cast<Index>(r) + 1) = row.imag();
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
                          std::vector<double> deviation) {
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
          .visit = FrequencyRows{channel, std::move(deviation), std::move(lines)}};
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

}  // namespace flexarm::measured
