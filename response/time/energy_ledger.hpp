#pragma once

#include "response/time/added_forces.hpp"
#include "response/time/expansion.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/simulation.hpp"
#include "response/time/step_energy.hpp"
#include "response/time/step_table.hpp"

namespace flexarm::response {

/// Books the energy of inner steps. Losses are integrals of powers that are formed from the state
/// by each law anew, not from the forces that the step was solved with: a force that is wrong, or
/// wrong in sign, leaves a residual or a loss below 0.
class EnergyLedger {
 public:
  /// `hub_viscous_friction_N_m_s_per_rad` is a part of the damping matrix. Both references must
  /// outlive the object.
  EnergyLedger(const ModalDynamics& arm, const AddedForces& forces,
               double hub_viscous_friction_N_m_s_per_rad);

  /// The part of a step from r = 0 to `until`, by Gauss' rule of 7 points on the solution: powers
  /// are of degree 14 to rounding where |A| dt is 1.
  void add(const Expansion& solution, const StepInputs& inputs, HubMotion motion, double until);
  /// A whole step of constant forces from `begin` to `end`, which `energy` is of.
  void add(const StepEnergy& energy, const StepInputs& inputs, HubMotion motion,
           const Eigen::VectorXd& begin, const Eigen::VectorXd& end);
  /// Of such steps of `arm`: that of the ledger, or its with_settled_torque.
  StepEnergy step_energy(const ModalDynamics& arm, StepEnergy::Hub hub, double step_s) const {
    return {arm, hub, hub_viscous_friction_, step_s};
  }
  /// At a sample: state of the energies, and what the steps since the last sample have lost.
  void close_sample(const Eigen::VectorXd& x);

  const EnergyBalance& balance() const { return balance_; }

 private:
  /// Powers [W].
  struct Powers {
    double work_in = 0.0;
    double viscous = 0.0;
    double material_air = 0.0;
    double dry_friction = 0.0;
    double drag = 0.0;
  };
  Powers powers(const Eigen::VectorXd& x, double actuator_N_m, double time_s,
                HubMotion motion) const;

  const ModalDynamics* arm_;
  const AddedForces* forces_;
  double hub_viscous_friction_;
  EnergyBalance balance_;
  EnergyBalance at_last_sample_;
};

}  // namespace flexarm::response
