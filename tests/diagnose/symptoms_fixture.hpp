#pragma once

#include "diagnose/symptoms/symptoms.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// An experiment with its residuals, as statements are made from.
class Symptomatic {
 public:
  explicit Symptomatic(Experiment experiment)
      : experiment_(std::move(experiment)),
        problem_(experiment_),
        before_(*problem_.residuals({}, std::vector<bool>(experiment_.runs.size(), true))) {}
  Symptomatic(const Symptomatic&) = delete;
  Symptomatic& operator=(const Symptomatic&) = delete;

  const Problem& problem() const { return problem_; }
  SymptomsInput input() const { return {problem_, before_, before_, nothing_}; }

 private:
  Experiment experiment_;
  Problem problem_;
  Eigen::VectorXd before_;
  Candidate nothing_;
};

inline std::vector<Symptom> significant(std::vector<Symptom> symptoms) {
  std::erase_if(symptoms, [](const Symptom& one) { return !one.is_significant; });
  return symptoms;
}

}  // namespace flexarm::diagnose
