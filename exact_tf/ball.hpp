#pragma once

// Private to exact_tf: thin owners of Arb's balls, with operators. Not installed.

#include <acb.h>
#include <arb.h>

#include <complex>
#include <optional>
#include <utility>

namespace flexarm::exact_tf::ball {

/// Working precision of every operator below, in bits, for the current thread and scope.
class Precision {
 public:
  explicit Precision(long bits) : outer_(std::exchange(bits_, bits)) {}
  ~Precision() { bits_ = outer_; }
  Precision(const Precision&) = delete;
  Precision& operator=(const Precision&) = delete;

  static long bits() { return bits_; }

 private:
  static inline thread_local long bits_ = 128;
  long outer_;
};

/// A real ball: every result contains every value that the operands allow.
class Real {
 public:
  Real() { arb_init(x_); }
  Real(double exact) : Real() { arb_set_d(x_, exact); }
  Real(int exact) : Real() { arb_set_si(x_, exact); }
  Real(const Real& other) : Real() { arb_set(x_, other.x_); }
  Real(Real&& other) noexcept : Real() { arb_swap(x_, other.x_); }
  Real& operator=(Real other) noexcept {
    arb_swap(x_, other.x_);
    return *this;
  }
  ~Real() { arb_clear(x_); }

  arb_ptr get() { return x_; }
  arb_srcptr get() const { return x_; }

  static Real pi() {
    Real result;
    arb_const_pi(result.x_, Precision::bits());
    return result;
  }

  /// [low, high] as one ball.
  static Real hull(const Real& low, const Real& high) {
    Real result;
    arb_union(result.x_, low.x_, high.x_, Precision::bits());
    return result;
  }

  /// +1 or -1 where the whole ball lies on one side of zero, else 0.
  int sign() const { return arb_is_positive(x_) ? 1 : arb_is_negative(x_) ? -1 : 0; }

  /// The one integer in the ball; empty where there is none or more than one.
  std::optional<long> unique_integer() const {
    fmpz_t integer;
    fmpz_init(integer);
    std::optional<long> result;
    if (arb_get_unique_fmpz(integer, x_) && fmpz_fits_si(integer)) result = fmpz_get_si(integer);
    fmpz_clear(integer);
    return result;
  }

  Real midpoint() const {
    Real result;
    arb_get_mid_arb(result.x_, x_);
    return result;
  }
  double nearest_double() const { return arf_get_d(arb_midref(x_), ARF_RND_NEAR); }

  /// An exact number that no value of the ball exceeds.
  Real upper_end() const {
    Real result;
    arb_get_ubound_arf(arb_midref(result.x_), x_, Precision::bits());
    return result;
  }
  /// A double that no value of the ball exceeds.
  double upper_bound() const { return arf_get_d(arb_midref(upper_end().x_), ARF_RND_CEIL); }

  bool is_below(const Real& other) const { return arb_lt(x_, other.x_) != 0; }
  bool overlaps(const Real& other) const { return arb_overlaps(x_, other.x_) != 0; }

  friend Real operator-(const Real& a) {
    Real result;
    arb_neg(result.x_, a.x_);
    return result;
  }
  friend Real operator+(const Real& a, const Real& b) {
    Real result;
    arb_add(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend Real operator-(const Real& a, const Real& b) {
    Real result;
    arb_sub(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend Real operator*(const Real& a, const Real& b) {
    Real result;
    arb_mul(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend Real operator/(const Real& a, const Real& b) {
    Real result;
    arb_div(result.x_, a.x_, b.x_, Precision::bits());
    return result;
  }
  friend Real sqrt(const Real& a) {
    Real result;
    arb_sqrt(result.x_, a.x_, Precision::bits());
    return result;
  }
  friend Real exp(const Real& a) {
    Real result;
    arb_exp(result.x_, a.x_, Precision::bits());
    return result;
  }
  friend Real floor(const Real& a) {
    Real result;
    arb_floor(result.x_, a.x_, Precision::bits());
    return result;
  }
  friend void sin_cos(Real& sine, Real& cosine, const Real& a) {
    arb_sin_cos(sine.x_, cosine.x_, a.x_, Precision::bits());
  }

 private:
  arb_t x_;
};

/// A complex ball, a rectangle; real values are held and multiplied as such.
class Complex {
 public:
  Complex() { acb_init(z_); }
  Complex(int exact) : Complex() { acb_set_si(z_, exact); }
  Complex(const Real& real) : Complex() { acb_set_arb(z_, real.get()); }
  Complex(const Real& real, const Real& imaginary) : Complex() {
    acb_set_arb_arb(z_, real.get(), imaginary.get());
  }
  Complex(const Complex& other) : Complex() { acb_set(z_, other.z_); }
  Complex(Complex&& other) noexcept : Complex() { acb_swap(z_, other.z_); }
  Complex& operator=(Complex other) noexcept {
    acb_swap(z_, other.z_);
    return *this;
  }
  ~Complex() { acb_clear(z_); }

  /// e^{i pi t}.
  static Complex unit_at_half_turns(const Real& t) {
    Complex result;
    acb_set_arb(result.z_, t.get());
    acb_exp_pi_i(result.z_, result.z_, Precision::bits());
    return result;
  }

  Real real() const {
    Real result;
    arb_set(result.get(), acb_realref(z_));
    return result;
  }
  Real imag() const {
    Real result;
    arb_set(result.get(), acb_imagref(z_));
    return result;
  }
  Complex midpoint() const {
    Complex result;
    acb_get_mid(result.z_, z_);
    return result;
  }
  std::complex<double> nearest_double() const {
    return {real().nearest_double(), imag().nearest_double()};
  }
  bool contains_zero() const { return acb_contains_zero(z_) != 0; }
  bool overlaps(const Complex& other) const { return acb_overlaps(z_, other.z_) != 0; }

  friend Complex operator-(const Complex& a) {
    Complex result;
    acb_neg(result.z_, a.z_);
    return result;
  }
  friend Complex operator+(const Complex& a, const Complex& b) {
    Complex result;
    acb_add(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend Complex operator-(const Complex& a, const Complex& b) {
    Complex result;
    acb_sub(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend Complex operator*(const Complex& a, const Complex& b) {
    Complex result;
    acb_mul(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend Complex operator/(const Complex& a, const Complex& b) {
    Complex result;
    acb_div(result.z_, a.z_, b.z_, Precision::bits());
    return result;
  }
  friend Complex exp(const Complex& a) {
    Complex result;
    acb_exp(result.z_, a.z_, Precision::bits());
    return result;
  }
  friend Complex sqrt(const Complex& a) {
    Complex result;
    acb_sqrt(result.z_, a.z_, Precision::bits());
    return result;
  }
  friend void sin_cos(Complex& sine, Complex& cosine, const Complex& a) {
    acb_sin_cos(sine.z_, cosine.z_, a.z_, Precision::bits());
  }
  friend Real abs(const Complex& a) {
    Real result;
    acb_abs(result.get(), a.z_, Precision::bits());
    return result;
  }
  friend Real arg(const Complex& a) {
    Real result;
    acb_arg(result.get(), a.z_, Precision::bits());
    return result;
  }

 private:
  acb_t z_;
};

}  // namespace flexarm::exact_tf::ball
