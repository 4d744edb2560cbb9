#pragma once

#include "arm/arm.hpp"
#include "effects/registry/entry.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::effects {

/// Every effect, by the port that it acts through in the order of arm::Port, then by name.
const std::vector<Entry>& entries();

/// The definitions of `entries()`, in their order: what an arm file may use.
const arm::Vocabulary& vocabulary();

/// The entry of that name, or null.
const Entry* find(std::string_view name);

/// The effect of that name with these numbers. Throws InputError for a name that is none.
arm::Effect effect(std::string_view name, std::map<std::string, double> parameters,
                   std::string sensor = {});

/// The same with its name, as arm::Effects hold it.
arm::Effects::value_type named(const std::string& name, std::map<std::string, double> parameters,
                               std::string sensor = {});

/// The effect with the example values of its parameters.
arm::Effect example(const arm::Vocabulary::value_type& definition);

/// The unit of a parameter of an effect on that sensor, which is empty where it acts on none.
std::string unit_of(const arm::EffectParameter& parameter, const std::string& sensor);

/// Gives the arm the effect with these numbers. What it has of that effect keeps its other numbers.
void put(arm::Arm& arm, const std::string& name, const std::map<std::string, double>& parameters,
         const std::string& sensor = {});

}  // namespace flexarm::effects
