#include "measured/modal/residual_quality.hpp"

#include "measured/spectra/correlation.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

/// Samples that the tests look at, at most: more would find differences that do not matter.
constexpr Index kTested = 200'000;

/// Where each sensor's shared beta begins in the joint vector, then its length.
std::vector<Index> places(const BlockFit& fit) {
  std::vector<Index> first = {fit.blocks.parameters()};
  for (const SensorModel& model : fit.models) first.push_back(first.back() + model.shared);
  return first;
}

bool has(const SensorColumn& column, std::size_t stretch, bool free) {
  switch (column.kind) {
    case SensorColumn::Kind::forced:
    case SensorColumn::Kind::remainder:
    case SensorColumn::Kind::jump:
      return true;
    case SensorColumn::Kind::free:
      return free && column.stretch == stretch;
    case SensorColumn::Kind::offset:
      return column.stretch == stretch;
  }
  return false;
}

/// Signals' coefficients of one sensor's prediction: rows times this is what the model reads.
VectorXd prediction(const BlockFit& fit, std::size_t sensor, std::size_t stretch,
                    const SignalLayout& layout) {
  const MatrixXd unit = MatrixXd::Identity(layout.first_reading(), layout.first_reading());
  VectorXd weights = VectorXd::Zero(layout.first_reading());
  const auto& columns = fit.models[sensor].columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!has(columns[i], stretch, layout.free)) continue;
    weights += fit.sensors[sensor].beta(static_cast<Index>(i)) *
               column_of(columns[i], unit, layout, fit.blocks);
  }
  return weights;
}

/// What one batch's residuals would add to the parameters: its scores through the inverse
/// information. Influence on theta, and each sensor's A^T e for its beta.
struct BatchScores {
  VectorXd theta;
  std::vector<VectorXd> linear;
};

/// `sum`: signals times residual of one sensor, summed over a batch, as one row.
void add_scores(const BlockFit& fit, std::size_t sensor, std::size_t stretch,
                const SignalLayout& layout, const RowVectorXd& sum, BatchScores& scores) {
  const auto& model = fit.models[sensor];
  const SensorEstimate& estimate = fit.sensors[sensor];
  const MatrixXd row = sum;
  RowVectorXd a = RowVectorXd::Zero(static_cast<Index>(model.columns.size()));
  RowVectorXd d = RowVectorXd::Zero(fit.blocks.parameters());
  for (std::size_t i = 0; i < model.columns.size(); ++i) {
    const SensorColumn& column = model.columns[i];
    if (!has(column, stretch, layout.free)) continue;
    a(static_cast<Index>(i)) = column_of(column, row, layout, fit.blocks)(0);
    const MatrixXd change = column_derivatives(column, row, layout, fit.blocks);
    if (change.size() == 0) continue;
    d.segment(fit.blocks.first_parameter(column.block), change.cols()) +=
        estimate.beta(static_cast<Index>(i)) * change.row(0);
  }
  scores.theta += (d + a * estimate.to_theta).transpose() / estimate.variance;
  scores.linear[sensor] += a.transpose();
}

VectorXd influence(const BlockFit& fit, const BatchScores& scores,
                   const std::vector<Index>& first) {
  VectorXd change(first.back());
  const VectorXd theta = fit.theta_covariance * scores.theta;
  change.head(theta.size()) = theta;
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    const VectorXd beta =
        fit.sensors[j].unit_inverse * scores.linear[j] + fit.sensors[j].to_theta * theta;
    change.segment(first[j], fit.models[j].shared) = beta.head(fit.models[j].shared);
  }
  return change;
}

/// What is known beforehand of coefficients errs by its own deviation, whatever the residuals.
void add_prior(const BlockFit& fit, const std::vector<Index>& first, MatrixXd& covariance) {
  BatchScores scores{VectorXd::Zero(fit.blocks.parameters()), {}};
  for (const SensorEstimate& sensor : fit.sensors) {
    scores.linear.push_back(VectorXd::Zero(sensor.beta.size()));
  }
  const BatchScores none = scores;
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    const SensorEstimate& sensor = fit.sensors[j];
    for (Index i = 0; i < sensor.beta.size(); ++i) {
      const double tightness = fit.models[j].columns[static_cast<std::size_t>(i)].tightness;
      if (tightness == 0.0) continue;
      const double residual = tightness * std::sqrt(sensor.variance);
      scores = none;
      scores.theta = residual / sensor.variance * sensor.to_theta.row(i).transpose();
      scores.linear[j](i) = residual;
      const VectorXd change = influence(fit, scores, first);
      covariance += change * change.transpose();
    }
  }
}

struct FTest {
  double probability = 1.0;
  double share = 0.0;
};

/// Regression of the residual on the torques of kTorqueLags samples.
FTest explained_by_torque(const VectorXd& residual, const VectorXd& torque) {
  const Index rows = residual.size() - kTorqueLags;
  if (rows < 4 * kTorqueLags) return {};
  MatrixXd gram(kTorqueLags, kTorqueLags);
  VectorXd mixed(kTorqueLags);
  for (int i = 0; i < kTorqueLags; ++i) {
    const auto ahead = torque.segment(kTorqueLags - i, rows);
    for (int k = i; k < kTorqueLags; ++k) {
      gram(i, k) = gram(k, i) = ahead.dot(torque.segment(kTorqueLags - k, rows));
    }
    mixed(i) = ahead.dot(residual.tail(rows));
  }
  gram.diagonal().array() *= 1.0 + 1e-10;  // torques that are not excited in all directions
  const double all = residual.tail(rows).squaredNorm();
  const double explained = mixed.dot(gram.ldlt().solve(mixed));
  const double left = all - explained;
  if (!(left > 0.0) || !(explained > 0.0)) return {};
  const double freedom = static_cast<double>(rows - kTorqueLags);
  const double f = explained / kTorqueLags / (left / freedom);
  return {f_tail(f, kTorqueLags, freedom), explained / all};
}

void judge(ResidualQuality& quality, const VectorXd& residual, const VectorXd& torque,
           bool in_time) {
  if (residual.size() <= 2 * kWhitenessLags || residual.squaredNorm() == 0.0) return;
  const double statistic =
      ljung_box({residual.data(), static_cast<std::size_t>(residual.size())}, kWhitenessLags);
  // Residuals that are no numbers are no noise.
  const double probability =
      std::isnan(statistic) ? 0.0 : chi_squared_tail(statistic, kWhitenessLags);
  quality.whiteness_probability = std::min(quality.whiteness_probability, probability);
  if (!in_time) return;
  const FTest test = explained_by_torque(residual, torque);
  if (test.probability < quality.explained_probability) {
    quality.explained_probability = test.probability;
    quality.explained_share = test.share;
  }
}

}  // namespace

MatrixXd joint_covariance(const BlockFit& fit) {
  const auto first = places(fit);
  const Index theta = fit.blocks.parameters();
  MatrixXd to_all(first.back(), theta);
  to_all.topRows(theta).setIdentity();
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    to_all.middleRows(first[j], fit.models[j].shared) =
        fit.sensors[j].to_theta.topRows(fit.models[j].shared);
  }
  MatrixXd covariance = to_all * fit.theta_covariance * to_all.transpose();
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    const Index n = fit.models[j].shared;
    covariance.block(first[j], first[j], n, n) +=
        fit.sensors[j].variance * fit.sensors[j].unit_inverse.topLeftCorner(n, n);
  }
  return covariance;
}

ResidualStudy study_residuals(std::span<const Stretch> stretches, const BlockFit& fit) {
  ResidualStudy study;
  for (const SensorEstimate& sensor : fit.sensors) {
    study.sensors.push_back({.standard_deviation = std::sqrt(sensor.variance)});
  }
  std::vector<double> reading_squares(fit.sensors.size(), 0.0);
  const auto first = places(fit);
  const bool in_time = stretches.front().in_time;
  // A frequency response is a stretch of its own, whose batches meet no others'.
  const Index batches_each =
      in_time ? std::max<Index>(10, kBatches / static_cast<Index>(stretches.size())) : kBatches;
  std::vector<VectorXd> influences;
  for (std::size_t r = 0; r < stretches.size(); ++r) {
    const Stretch& stretch = stretches[r];
    const SignalLayout layout = stretch.layout(fit.blocks);
    const auto readings = static_cast<Index>(stretch.sensors.size());
    MatrixXd predictions(layout.first_reading(), readings);
    for (Index i = 0; i < readings; ++i) {
      const auto j = static_cast<std::size_t>(stretch.sensors[static_cast<std::size_t>(i)]);
      predictions.col(i) = prediction(fit, j, r, layout);
    }
    const Index tested = std::min(stretch.rows, kTested);
    MatrixXd residuals(tested, readings);
    VectorXd torque(tested);
    std::vector<MatrixXd> sums(static_cast<std::size_t>(batches_each),
                               MatrixXd::Zero(readings, layout.first_reading()));
    VectorXd reading_sums = VectorXd::Zero(readings);
    Index at = 0;
    stretch.visit(fit.blocks, [&](const Eigen::Ref<const MatrixXd>& rows) {
      const auto signals = rows.leftCols(layout.first_reading());
      const MatrixXd residual = rows.rightCols(readings) - signals * predictions;
      for (Index i = 0; i < readings; ++i) {
        const auto j = static_cast<std::size_t>(stretch.sensors[static_cast<std::size_t>(i)]);
        reading_squares[j] += rows.rightCols(readings).col(i).squaredNorm();
        reading_sums(i) += rows.rightCols(readings).col(i).sum();
      }
      if (at < tested) {
        const Index kept = std::min(rows.rows(), tested - at);
        residuals.middleRows(at, kept) = residual.topRows(kept);
        torque.segment(at, kept) = rows.col(layout.torque()).head(kept);
      }
      for (Index k = 0; k < rows.rows();) {
        const Index batch = (at + k) * batches_each / stretch.rows;
        const Index end = ((batch + 1) * stretch.rows + batches_each - 1) / batches_each;
        const Index count = std::min(rows.rows() - k, end - at - k);
        sums[static_cast<std::size_t>(batch)].noalias() +=
            residual.middleRows(k, count).transpose() * signals.middleRows(k, count);
        k += count;
      }
      at += rows.rows();
    });
    for (const MatrixXd& sum : sums) {
      BatchScores scores{VectorXd::Zero(fit.blocks.parameters()), {}};
      for (const SensorEstimate& sensor : fit.sensors) {
        scores.linear.push_back(VectorXd::Zero(sensor.beta.size()));
      }
      for (Index i = 0; i < readings; ++i) {
        const auto j = static_cast<std::size_t>(stretch.sensors[static_cast<std::size_t>(i)]);
        const double weight = stretch.weight(i);
        add_scores(fit, j, r, layout, weight * weight * sum.row(i), scores);
      }
      influences.push_back(influence(fit, scores, first));
    }
    for (Index i = 0; i < readings; ++i) {
      const auto j = static_cast<std::size_t>(stretch.sensors[static_cast<std::size_t>(i)]);
      if (in_time) {
        reading_squares[j] -= reading_sums(i) * reading_sums(i) / static_cast<double>(stretch.rows);
      }
      judge(study.sensors[j], residuals.col(i), torque, in_time);
    }
  }
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    study.sensors[j].relative =
        std::sqrt(fit.sensors[j].squares / std::max(reading_squares[j], 1e-300));
  }
  const auto count = static_cast<double>(influences.size());
  study.robust_covariance = MatrixXd::Zero(first.back(), first.back());
  for (const VectorXd& change : influences) study.robust_covariance += change * change.transpose();
  study.robust_covariance *= count / (count - 1.0);
  add_prior(fit, first, study.robust_covariance);
  return study;
}

}  // namespace flexarm::measured
