#pragma once

#include <optional>

namespace flexarm::arm {

/// A uniform beam, given by cross-section and material, or by flexural rigidity and linear density,
/// or by both where they agree. What was not given is empty, so that a file is written back as
/// read.
struct Beam {
  double length_m = 0.0;              ///< from the motor axis to the tip
  std::optional<double> width_m;      ///< out of the bending plane
  std::optional<double> thickness_m;  ///< in the bending plane; strain sensors need it
  std::optional<double> density_kg_per_m3;
  std::optional<double> youngs_modulus_Pa;
  std::optional<double> shear_modulus_Pa;  ///< needed by shear_and_rotary_inertia only
  std::optional<double> given_flexural_rigidity_N_m2;
  std::optional<double> given_linear_density_kg_per_m;

  /// A beam known by its dimensions and material.
  static Beam from_section(double length_m, double width_m, double thickness_m,
                           double density_kg_per_m3, double youngs_modulus_Pa);
  /// A beam known by its bending behaviour alone.
  static Beam from_rigidity(double length_m, double flexural_rigidity_N_m2,
                            double linear_density_kg_per_m);

  /// EI: as given, else E w t^3/12. Throws InputError when neither is known.
  double flexural_rigidity_N_m2() const;
  /// m: as given, else density w t. Throws InputError when neither is known.
  double linear_density_kg_per_m() const;

  bool operator==(const Beam&) const = default;
};

/// Throws InputError for a value that is not finite or not positive, for a beam that is not known
/// well enough, and for two descriptions that differ by more than `kDescriptionAgreement`.
void require_valid(const Beam& beam);

/// Relative difference up to which a rigidity (or density) given directly and the one that follows
/// from the dimensions count as the same: data sheets round to four digits.
inline constexpr double kDescriptionAgreement = 1e-3;

/// Gives the beam factor times its EI (or m), by whichever numbers describe it.
void scale_flexural_rigidity(Beam& beam, double factor);
void scale_linear_density(Beam& beam, double factor);

}  // namespace flexarm::arm
