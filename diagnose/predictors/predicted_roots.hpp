#pragma once

#include "arm/arm.hpp"
#include "measured/files/modal_table.hpp"

#include <Eigen/Core>

namespace flexarm::diagnose {

/// The natural frequencies [Hz] and damping ratios that a modal table of this arm should hold: in
/// the order of `Observations`, the poles and then the zeros of each sensor. Poles are damped
/// ones; zeros have the modulus of the undamped, and the damping ratio of the zero of the damped
/// transfer function beside it. By exact_tf. Every entry has an order
/// (diagnose/modal_orders.hpp), that of a zero among the zeros on the imaginary axis.
///
/// Throws InputError where the arm has no such zero among the lowest 32, or four times its order.
void predict_roots(const arm::Arm& arm, const measured::ModalTable& table,
                   Eigen::Ref<Eigen::VectorXd> values);

}  // namespace flexarm::diagnose
