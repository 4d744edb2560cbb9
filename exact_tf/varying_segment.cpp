#include "exact_tf/varying_segment.hpp"

#include "exact_tf/series_sum.hpp"

namespace flexarm::exact_tf {

namespace {

/// A linear function of the variable of a series times a series, by the coefficients of both.
template <class R>
struct Linear {
  R constant;
  R slope;

  template <class T>
  T times(const T& now, const T& before) const {
    return constant * now + slope * before;
  }
  /// The coefficient of x in (constant + slope u) x = value.
  template <class T>
  T divide(const T& value, const T& before) const {
    return slope == 0 && constant == 1 ? value : (value - slope * before) / constant;
  }
};

template <class T>
class PlaneRecursion {
 public:
  using R = RealOf<T>;

  PlaneRecursion(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                 const Segment<RealOf<T>>& segment, const Bivector<T>& at_right)
      : beam_(beam),
        shear_(arm.shear_flexibility),
        length_(segment.length),
        tension_{arm.tension(segment.right), arm.gravity * segment.length},
        stretch_{R(1) + shear_ * tension_.constant, shear_ * tension_.slope},
        term_(at_right.minors) {}

  const std::array<T, 6>& term() const { return term_; }

  void advance() {
    const auto& [y_psi, y_moment, y_force, psi_moment, psi_force, moment_force] = term_;
    const std::array<T, 4> slope = {
        stretch_.divide(T(-y_psi - shear_ * y_force), before_[kDisplacement]),
        shear_ == 0 ? T(0) : stretch_.divide(T(-shear_ * psi_force), before_[kRotation]),
        stretch_.divide(T(psi_moment - shear_ * moment_force), before_[kMoment]),
        stretch_.divide(psi_force, before_[kForce])};
    const auto pulled = [&](std::size_t j) { return tension_.times(slope[j], before_[j]); };
    const R step = -length_ / static_cast<R>(++order_);
    const T& f = beam_.flexibility;
    const T& q = beam_.inertia;
    const T& r = beam_.rotary;
    term_ = {step * (slope[kRotation] + f * y_moment),
             step * (slope[kMoment] + r * y_psi - y_force - pulled(kDisplacement)),
             step * slope[kForce],
             -step * (psi_force + pulled(kRotation)),
             step * (f * moment_force - q * y_psi),
             step * (r * psi_force + pulled(kForce) - q * y_moment)};
    before_ = slope;
  }

 private:
  const BeamAtFrequency<T>& beam_;
  R shear_;
  R length_;
  Linear<R> tension_;
  Linear<R> stretch_;
  std::array<T, 6> term_;
  std::array<T, 4> before_{};
  int order_ = 0;
};

template <class T>
class FunctionalRecursion {
 public:
  using R = RealOf<T>;

  FunctionalRecursion(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                      const Segment<RealOf<T>>& segment, const BeamState<T>& at_left)
      : beam_(beam),
        shear_(arm.shear_flexibility),
        length_(segment.length),
        tension_{arm.tension(segment.right) + arm.gravity * segment.length,
                 -arm.gravity * segment.length},
        stretch_{R(1) + shear_ * tension_.constant, shear_ * tension_.slope},
        term_(at_left) {}

  const BeamState<T>& term() const { return term_; }

  void advance() {
    const BeamState<T> g = term_;
    const T slope = stretch_.divide(
        T(g[kDisplacement] + tension_.times(g[kMoment], moment_before_)), slope_before_);
    const R step = -length_ / static_cast<R>(++order_);
    term_ = {step * (beam_.inertia * g[kForce]), step * (slope + beam_.rotary * g[kMoment]),
             step * (beam_.flexibility * g[kRotation]), step * (shear_ * slope - g[kMoment])};
    slope_before_ = slope;
    moment_before_ = g[kMoment];
  }

 private:
  const BeamAtFrequency<T>& beam_;
  R shear_;
  R length_;
  Linear<R> tension_;
  Linear<R> stretch_;
  BeamState<T> term_;
  T slope_before_{};
  T moment_before_{};
  int order_ = 0;
};

}  // namespace

template <class T>
Bivector<T> plane_at_left(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                          const Segment<RealOf<T>>& segment, const Bivector<T>& at_right) {
  PlaneRecursion<T> recursion(arm, beam, segment, at_right);
  const RealOf<T> waves = 2 * wave_number(arm, beam, segment) * segment.length;
  return {sum_series(recursion, likely_terms(waves), [](int, const auto&) {})};
}

template <class T>
BeamState<T> functional_at_right(const ArmInBeamUnits<RealOf<T>>& arm,
                                 const BeamAtFrequency<T>& beam, const Segment<RealOf<T>>& segment,
                                 const BeamState<T>& at_left) {
  FunctionalRecursion<T> recursion(arm, beam, segment, at_left);
  const RealOf<T> waves = wave_number(arm, beam, segment) * segment.length;
  return sum_series(recursion, likely_terms(waves), [](int, const auto&) {});
}

template Bivector<Real> plane_at_left(const ArmInBeamUnits<Real>&, const BeamAtFrequency<Real>&,
                                      const Segment<Real>&, const Bivector<Real>&);
template Bivector<Complex> plane_at_left(const ArmInBeamUnits<Real>&,
                                         const BeamAtFrequency<Complex>&, const Segment<Real>&,
                                         const Bivector<Complex>&);
template Bivector<double> plane_at_left(const ArmInBeamUnits<double>&,
                                        const BeamAtFrequency<double>&, const Segment<double>&,
                                        const Bivector<double>&);
template Bivector<std::complex<double>> plane_at_left(const ArmInBeamUnits<double>&,
                                                      const BeamAtFrequency<std::complex<double>>&,
                                                      const Segment<double>&,
                                                      const Bivector<std::complex<double>>&);
template BeamState<Real> functional_at_right(const ArmInBeamUnits<Real>&,
                                             const BeamAtFrequency<Real>&, const Segment<Real>&,
                                             const BeamState<Real>&);
template BeamState<Complex> functional_at_right(const ArmInBeamUnits<Real>&,
                                                const BeamAtFrequency<Complex>&,
                                                const Segment<Real>&, const BeamState<Complex>&);
template BeamState<double> functional_at_right(const ArmInBeamUnits<double>&,
                                               const BeamAtFrequency<double>&,
                                               const Segment<double>&, const BeamState<double>&);
template BeamState<std::complex<double>> functional_at_right(
    const ArmInBeamUnits<double>&, const BeamAtFrequency<std::complex<double>>&,
    const Segment<double>&, const BeamState<std::complex<double>>&);

}  // namespace flexarm::exact_tf
