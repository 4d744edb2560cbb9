#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/page/page_document.hpp"

namespace flexarm::report::page {

/// Posterior probabilities of the named causes, each by itself.
RankingBlock cause_ranking(const diagnose::Diagnosis& diagnosis);

/// "0.98", "1.2e-05".
std::string probability_text(double probability);

/// What speaks for each cause, and what would speak against it; a row a sentence.
TableBlock evidence_table(const diagnose::Diagnosis& diagnosis);

/// For each cause the effects that these data do not distinguish from it; no rows without any.
TableBlock indistinguishable_table(const diagnose::Diagnosis& diagnosis);

/// An empirical law over velocity or angle with the means that it describes; a view a velocity of a
/// law over both.
CurvesBlock empirical_law_block(const diagnose::EmpiricalLaw& law);

/// What a force at each port explains of the excess residual.
RankingBlock missing_force_ranking(const diagnose::MissingForce& force);

/// "Coulomb friction", "gain on the hub angle".
std::string cause_label(const diagnose::Cause& cause);

}  // namespace flexarm::report::page
