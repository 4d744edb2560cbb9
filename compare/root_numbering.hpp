#pragma once

#include "arm/sensor.hpp"
#include "measured/files/modal_table.hpp"

#include <optional>
#include <vector>

namespace flexarm::compare {

struct ModelRoot {
  double frequency_Hz = 0.0;
  int order = 1;
};

/// What measured roots are numbered by; ascending in frequency.
struct ModelRoots {
  struct Zeros {
    arm::Sensor sensor;
    std::vector<ModelRoot> roots;  ///< on the imaginary axis
  };
  double lowest_Hz = 0.0;  ///< of the mode below the flexible ones; 0 where the arm turns freely
  std::vector<ModelRoot> poles = {};
  std::vector<Zeros> zeros = {};
  std::vector<ModelRoot> beyond = {};  ///< poles above those: samples may show their aliases
};

enum class OrderBasis { none, stated, interlacing, distance };

struct RootOrder {
  std::optional<int> order;
  OrderBasis basis = OrderBasis::none;
};

/// The order of each measured root (docs/numerics.md, section 6). An order that the table states
/// stays. Poles and zeros of a collocated sensor alternate, so that the order of one gives those of
/// all. That one order is the one for which, with `count` roots and d = ln(measured/model),
///
///     rms(d) = sqrt(sum (d - mean d)^2/(count - 1))
///
/// is least. It is taken if
///
///     rms <= kSameFactor, count >= 3; or rms <= kFromTheFirst, where the first root of the model
///         is the first measured one and none is missing;
///     rms of any other >= kDistinct max(rms, kLeastDeviation);
///     |mean d| <= ln kMostFactor.
///
/// Roots that this does not number, and zeros that do not alternate with poles, take the order of
/// the nearest after exp(mean d) of the poles numbered until then has been taken out; 1 where there
/// are none. Nearest pairs come first, and orders rise with frequency: a root between two of
/// successive orders has none. Without frequency a root has no order unless it is stated.
std::vector<RootOrder> number_roots(const measured::ModalTable& table, const ModelRoots& model);

/// Single wrong numbers of an arm (rigidity, hub inertia, payload, root compliance, by up to a
/// factor of 3 to 5) move roots against their common factor by rms 0.02 to 0.15.
inline constexpr double kSameFactor = 0.15;
inline constexpr double kFromTheFirst = 0.25;
/// Less is no evidence for one order against another: a wrong number of the arm makes as much.
inline constexpr double kLeastDeviation = 0.03;
inline constexpr double kDistinct = 2.0;
/// Of frequencies; a beam nine times as stiff, or 1.7 times as long.
inline constexpr double kMostFactor = 3.0;

}  // namespace flexarm::compare
