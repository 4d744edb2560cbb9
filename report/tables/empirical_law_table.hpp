#pragma once

#include "diagnose/unknown/empirical_law.hpp"
#include "report/tables/table.hpp"

#include <string>

namespace flexarm::report {

/// What the law is a function of, what it explains and what it does for simulations.
std::string empirical_law_text(const diagnose::EmpiricalLaw& law);

/// A row a place of the table: angle, velocity, torque.
Table empirical_law_table(const diagnose::EmpiricalLaw& law);

}  // namespace flexarm::report
