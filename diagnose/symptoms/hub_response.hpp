#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "measured/files/measurement.hpp"
#include "response/time/arm_simulator.hpp"

#include <complex>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// What answers a torque on the hub that is given at samples, and that is 0 before the first, in
/// proportion to it: the convolution with its answer to one of 1 N m at one sample and 0 at the
/// others; its adjoint; and what undoes it.
class HubResponse {
 public:
  /// A sensor of the linear arm, at rest before the first sample, under a torque that is held as
  /// the run holds its torque. `flexible_modes` of exact_tf move. Throws InputError as they do.
  HubResponse(const arm::Arm& arm, const arm::Sensor& sensor, int flexible_modes,
              measured::TorqueHold hold, double period_s, std::size_t samples);
  /// What has this answer to 1 N m at the first sample, a value a sample, and has died after that.
  explicit HubResponse(const std::vector<double>& pulse_response);

  std::size_t samples() const { return samples_; }

  /// The reading under this torque, a value a sample of both.
  std::vector<double> reading(std::span<const double> torque_N_m) const;

  /// The product of `values`, one a sample, with the transposed matrix of `reading`: the scalar
  /// product of `values` with any reading is that of this with its torque.
  std::vector<double> adjoint(std::span<const double> values) const;

  /// The torque [N m] whose reading this is, but for white noise of deviation `noise`, as far as
  /// the noise lets it be seen: Wiener's filter
  ///
  ///     T = conj(G) Y/(|G|^2 + n/s)
  ///
  /// with the power s of a white torque of largest likelihood [Whittle1953] beside that of the
  /// noise, n. Reading, response and noise are differenced until a free arm does not drift
  /// (measured::differences_until_steady), and fade exponentially, so that what rings on has faded
  /// when the discrete transform comes round [KauselRoesset1992]. The last
  /// few samples of the reading say little of the torque under them.
  std::vector<double> torque(std::span<const double> reading, double noise) const;

 private:
  using Spectrum = std::vector<std::complex<double>>;

  HubResponse(std::shared_ptr<const response::ArmSimulator> simulator, std::size_t samples,
              int differences);
  /// Of an answer that is followed for `kPulseRecords` records of so many samples.
  HubResponse(const std::vector<double>& pulse_response, std::size_t samples, int differences);

  std::vector<double> transformed_back(const Spectrum& spectrum, std::size_t padded) const;

  /// Null where the answer is given. It takes less time than transforms.
  std::shared_ptr<const response::ArmSimulator> simulator_;
  std::size_t samples_;
  std::size_t padded_;          // for what rings on, to fade before it comes round
  std::size_t padded_twofold_;  // for a convolution of two records
  int differences_;
  Spectrum response_;         // padded_twofold_/2 + 1
  Spectrum steady_response_;  // padded_/2 + 1, differenced
};

}  // namespace flexarm::diagnose
