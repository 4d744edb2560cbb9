#pragma once

#include "arm/arm.hpp"
#include "measured/files/modal_table.hpp"

#include <Eigen/Core>

namespace flexarm::diagnose {

/// The natural frequencies [Hz] and damping ratios that a modal table of this arm should hold: in
/// the order of `Observations`, the poles and then the zeros of each sensor. Poles are damped
/// ones, and zeros those of the damped transfer function beside the undamped ones on the imaginary
/// axis. By exact_tf. Every entry has an order
/// (diagnose/modal_orders.hpp), that of a zero among the zeros on the imaginary axis.
///
/// Throws InputError where the arm has no such zero among the lowest 32, or four times its order,
/// and where a zero could not be followed to the arm's damping.
void predict_roots(const arm::Arm& arm, const measured::ModalTable& table,
                   Eigen::Ref<Eigen::VectorXd> values);

}  // namespace flexarm::diagnose
