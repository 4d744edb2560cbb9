#include "exact_tf/segment_series.hpp"

#include "exact_tf/series_sum.hpp"
#include "exact_tf/uniform_segment.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// One step of the recursion after the other.
template <class T>
class Recursion {
 public:
  using R = RealOf<T>;

  Recursion(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
            const Segment<RealOf<T>>& segment, const BeamState<T>& at_right)
      : shear_(arm.shear_flexibility),
        tension_(arm.tension(segment.right)),
        tension_slope_(arm.gravity * segment.length),
        bending_(-segment.length * beam.flexibility),
        rotary_(-segment.length * beam.rotary),
        inertia_(-segment.length * beam.inertia),
        minus_length_(-segment.length),
        stretch_(R(1) + shear_ * tension_),
        stretch_slope_(shear_ * tension_slope_),
        term_(at_right) {}

  const BeamState<T>& term() const { return term_; }

  /// From term n to n + 1.
  void advance() {
    const T& y = term_[kDisplacement];
    const T& psi = term_[kRotation];
    const T& moment = term_[kMoment];
    const T& force = term_[kForce];
    const T slope =
        shear_ == R(0) ? psi : (psi + shear_ * force - stretch_slope_ * slope_before_) / stretch_;
    T moment_change = rotary_ * psi - minus_length_ * force;
    if (tension_ != R(0) || tension_slope_ != R(0)) {
      moment_change += minus_length_ * (tension_ * slope + tension_slope_ * slope_before_);
    }
    const R next = R(1) / static_cast<R>(++order_);
    term_ = {minus_length_ * next * slope, next * (bending_ * moment), next * moment_change,
             next * (inertia_ * y)};
    slope_before_ = slope;
  }

 private:
  R shear_;
  R tension_;
  R tension_slope_;
  T bending_;
  T rotary_;
  T inertia_;
  R minus_length_;
  R stretch_;
  R stretch_slope_;
  BeamState<T> term_;
  T slope_before_{};
  int order_ = 0;
};

template <class T>
int likely_terms_of(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                    const Segment<RealOf<T>>& segment) {
  return likely_terms(wave_number(arm, beam, segment) * segment.length);
}

}  // namespace

template <class T>
RealOf<T> wave_number(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                      const Segment<RealOf<T>>& segment) {
  const RealOf<T> flexibility = std::abs(beam.flexibility);
  const RealOf<T> inertia = std::abs(beam.inertia);
  const RealOf<T> at_right = arm.tension(segment.right);
  const RealOf<T> tension =
      std::max(std::abs(at_right + arm.gravity * segment.length), std::abs(at_right));
  return std::sqrt(std::sqrt(inertia * flexibility) + inertia * arm.shear_flexibility +
                   (std::abs(beam.rotary) + tension) * flexibility);
}

template <class T>
SegmentSeries<T>::SegmentSeries(const ArmInBeamUnits<RealOf<T>>& arm,
                                const BeamAtFrequency<T>& beam, const Segment<RealOf<T>>& segment,
                                const BeamState<T>& at_right)
    : coefficients_{at_right} {
  Recursion<T> recursion(arm, beam, segment, at_right);
  const int likely = likely_terms_of(arm, beam, segment);
  coefficients_.reserve(static_cast<std::size_t>(likely) + 8);
  sum_series(recursion, likely,
             [this](int, const BeamState<T>& term) { coefficients_.push_back(term); });
}

template <class T>
BeamState<T> SegmentSeries<T>::at(RealOf<T> u) const {
  BeamState<T> sum{};
  for (auto term = coefficients_.rbegin(); term != coefficients_.rend(); ++term) {
    for (std::size_t i = 0; i < 4; ++i) sum[i] = sum[i] * u + (*term)[i];
  }
  return sum;
}

template <class T>
SegmentTransfer<T> segment_transfer(const ArmInBeamUnits<RealOf<T>>& arm,
                                    const BeamAtFrequency<T>& beam,
                                    const Segment<RealOf<T>>& segment) {
  if (arm.gravity == 0) return uniform_transfer(arm, beam, segment.length);
  const int likely = likely_terms_of(arm, beam, segment);
  SegmentTransfer<T> transfer{};
  for (std::size_t j = 0; j < 4; ++j) {
    BeamState<T> unit{};
    unit[j] = T(1);
    Recursion<T> recursion(arm, beam, segment, unit);
    if (j > kRotation) {
      transfer.columns[j] = sum_series(recursion, likely, [](int, const BeamState<T>&) {});
      continue;
    }
    BeamState<T>& bending = transfer.bending[j];
    transfer.columns[j] = sum_series(recursion, likely, [&](int n, const BeamState<T>& term) {
      for (std::size_t i = 0; i < 4; ++i) bending[i] += term[i];
      if (n != 1 || j != kRotation) return;
      // y' = psi/(1 + phi g P) of a rod that does not bend, less psi.
      const RealOf<T> tension = arm.tension(segment.right);
      const RealOf<T> lag = arm.shear_flexibility * tension;
      bending[kDisplacement] = T(segment.length * lag / (1 + lag));
    });
  }
  return transfer;
}

template <class T>
SegmentTransfer<T> crack_transfer(const ArmInBeamUnits<RealOf<T>>& arm) {
  SegmentTransfer<T> transfer{};
  for (std::size_t j = 0; j < 4; ++j) transfer.columns[j][j] = T(1);
  transfer.columns[kMoment][kRotation] = T(-arm.crack_flexibility);
  return transfer;
}

template Real wave_number(const ArmInBeamUnits<Real>&, const BeamAtFrequency<Real>&,
                          const Segment<Real>&);
template Real wave_number(const ArmInBeamUnits<Real>&, const BeamAtFrequency<Complex>&,
                          const Segment<Real>&);
template double wave_number(const ArmInBeamUnits<double>&, const BeamAtFrequency<double>&,
                            const Segment<double>&);
template double wave_number(const ArmInBeamUnits<double>&,
                            const BeamAtFrequency<std::complex<double>>&, const Segment<double>&);
template class SegmentSeries<Real>;
template class SegmentSeries<Complex>;
template class SegmentSeries<double>;
template class SegmentSeries<std::complex<double>>;
template SegmentTransfer<Real> segment_transfer(const ArmInBeamUnits<Real>&,
                                                const BeamAtFrequency<Real>&, const Segment<Real>&);
template SegmentTransfer<Complex> segment_transfer(const ArmInBeamUnits<Real>&,
                                                   const BeamAtFrequency<Complex>&,
                                                   const Segment<Real>&);
template SegmentTransfer<double> segment_transfer(const ArmInBeamUnits<double>&,
                                                  const BeamAtFrequency<double>&,
                                                  const Segment<double>&);
template SegmentTransfer<std::complex<double>> segment_transfer(
    const ArmInBeamUnits<double>&, const BeamAtFrequency<std::complex<double>>&,
    const Segment<double>&);
template SegmentTransfer<Real> crack_transfer<Real>(const ArmInBeamUnits<Real>&);
template SegmentTransfer<Complex> crack_transfer<Complex>(const ArmInBeamUnits<Real>&);
template SegmentTransfer<double> crack_transfer<double>(const ArmInBeamUnits<double>&);
template SegmentTransfer<std::complex<double>> crack_transfer<std::complex<double>>(
    const ArmInBeamUnits<double>&);

}  // namespace flexarm::exact_tf
