#pragma once

#include "export/fmu/model_description.hpp"
#include "tests/export/xml_node.hpp"

#include <string>
#include <vector>

namespace flexarm::testing_export {

/// What a model description does that the standard does not allow; empty: nothing.
///
/// Checked are the rules of fmi2ModelDescription.xsd (FMI 2.0.x) or fmi3ModelDescription.xsd (FMI
/// 3.0.x) and of the files that these include: elements and their order, attributes and their
/// types, as far as a co-simulation FMU of real variables has them; and those that the standard's
/// text adds: unique names and value references, units that are defined, start values, allowed
/// combinations of causality, variability and initial, and a model structure that is complete.
std::vector<std::string> faults_of(const XmlNode& description, fmu::FmiVersion version);

/// The same for buildDescription.xml.
std::vector<std::string> faults_of_build(const XmlNode& description);

}  // namespace flexarm::testing_export
