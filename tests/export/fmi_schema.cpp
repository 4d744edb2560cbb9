#include "tests/export/fmi_schema.hpp"

#include <limits>

namespace flexarm::testing_export {

namespace {

using fmu::FmiVersion;

constexpr int kMany = std::numeric_limits<int>::max();
const AttributeRule kText{"string"};
const AttributeRule kName{"normalizedString", true};
const AttributeRule kNormalized{"normalizedString"};
const AttributeRule kBoolean{"boolean"};
const AttributeRule kDouble{"double"};
const AttributeRule kInt{"int"};
const AttributeRule kUnsigned{"unsignedInt"};
const AttributeRule kReference{"unsignedInt", true};
const std::string kCausalities =
    "parameter|calculatedParameter|input|output|local|independent|structuralParameter";
const std::string kVariabilities = "constant|fixed|tunable|discrete|continuous";
const std::string kInitials = "exact|approx|calculated";

const std::map<std::string, AttributeRule> kHead = {
    {"modelName", {"string", true}},
    {"description", kText},
    {"author", kText},
    {"version", kNormalized},
    {"copyright", kText},
    {"license", kText},
    {"generationTool", kNormalized},
    {"generationDateAndTime", kNormalized},
    {"variableNamingConvention", {"flat|structured"}}};

std::map<std::string, AttributeRule> with(std::map<std::string, AttributeRule> some,
                                          const std::map<std::string, AttributeRule>& more) {
  some.insert(more.begin(), more.end());
  return some;
}

/// Elements that both versions have alike.
Schema common_schema() {
  return {{"UnitDefinitions", {{}, {{"Unit", 1, kMany}}}},
          {"Unit", {{{"name", kName}}, {{"BaseUnit"}, {"DisplayUnit", 0, kMany}}}},
          {"BaseUnit",
           {{{"kg", kInt},
             {"m", kInt},
             {"s", kInt},
             {"A", kInt},
             {"K", kInt},
             {"mol", kInt},
             {"cd", kInt},
             {"rad", kInt},
             {"factor", kDouble},
             {"offset", kDouble}}}},
          {"LogCategories", {{}, {{"Category", 1, kMany}}}},
          {"Category", {{{"name", kName}, {"description", kText}}}},
          {"DefaultExperiment",
           {{{"startTime", kDouble},
             {"stopTime", kDouble},
             {"tolerance", kDouble},
             {"stepSize", kDouble}}}}};
}

}  // namespace

Schema schema_of(FmiVersion version) {
  Schema made = common_schema();
  if (version == FmiVersion::v2) {
    made.insert({{"fmiModelDescription",
                  {with(kHead, {{"fmiVersion", {"2.0", true}},
                                {"guid", kName},
                                {"numberOfEventIndicators", kUnsigned}}),
                   {{"ModelExchange"},
                    {"CoSimulation"},
                    {"UnitDefinitions"},
                    {"TypeDefinitions"},
                    {"LogCategories"},
                    {"DefaultExperiment"},
                    {"VendorAnnotations"},
                    {"ModelVariables", 1, 1},
                    {"ModelStructure", 1, 1}}}},
                 {"CoSimulation",
                  {{{"modelIdentifier", kName},
                    {"needsExecutionTool", kBoolean},
                    {"canHandleVariableCommunicationStepSize", kBoolean},
                    {"canInterpolateInputs", kBoolean},
                    {"maxOutputDerivativeOrder", kUnsigned},
                    {"canRunAsynchronuously", kBoolean},
                    {"canBeInstantiatedOnlyOncePerProcess", kBoolean},
                    {"canNotUseMemoryManagementFunctions", kBoolean},
                    {"canGetAndSetFMUstate", kBoolean},
                    {"canSerializeFMUstate", kBoolean},
                    {"providesDirectionalDerivative", kBoolean}},
                   {{"SourceFiles"}}}},
                 {"SourceFiles", {{}, {{"File", 1, kMany}}}},
                 {"File", {{{"name", kName}}}},
                 {"VendorAnnotations", {{}, {{"Tool", 1, kMany}}}},
                 {"Annotations", {{}, {{"Tool", 1, kMany}}}},
                 {"Tool", {{{"name", kName}}, {}, true}},
                 {"ModelVariables", {{}, {{"ScalarVariable", 1, kMany}}}},
                 {"ScalarVariable",
                  {{{"name", kName},
                    {"valueReference", kReference},
                    {"description", kText},
                    {"causality", {"parameter|calculatedParameter|input|output|local|independent"}},
                    {"variability", {kVariabilities}},
                    {"initial", {kInitials}},
                    {"canHandleMultipleSetPerTimeInstant", kBoolean}},
                   {{"Real", 1, 1}, {"Annotations"}}}},
                 {"Real",
                  {{{"declaredType", kNormalized},
                    {"quantity", kNormalized},
                    {"unit", kNormalized},
                    {"displayUnit", kNormalized},
                    {"relativeQuantity", kBoolean},
                    {"min", kDouble},
                    {"max", kDouble},
                    {"nominal", kDouble},
                    {"unbounded", kBoolean},
                    {"start", kDouble},
                    {"derivative", kUnsigned},
                    {"reinit", kBoolean}}}},
                 {"ModelStructure", {{}, {{"Outputs"}, {"Derivatives"}, {"InitialUnknowns"}}}},
                 {"Outputs", {{}, {{"Unknown", 1, kMany}}}},
                 {"InitialUnknowns", {{}, {{"Unknown", 1, kMany}}}},
                 {"Unknown",
                  {{{"index", kReference},
                    {"dependencies", {"list of unsignedInt"}},
                    {"dependenciesKind", {"list of kinds"}}}}}});
    return made;
  }
  const ElementRule unknown = {{{"valueReference", kReference},
                                {"dependencies", {"list of unsignedInt"}},
                                {"dependenciesKind", {"list of kinds"}}},
                               {{"Annotations"}}};
  made.insert({{"fmiModelDescription",
                {with(kHead, {{"fmiVersion", {"3.0", true}}, {"instantiationToken", kName}}),
                 {{"ModelExchange"},
                  {"CoSimulation"},
                  {"ScheduledExecution"},
                  {"UnitDefinitions"},
                  {"TypeDefinitions"},
                  {"LogCategories"},
                  {"DefaultExperiment"},
                  {"ModelVariables", 1, 1},
                  {"ModelStructure", 1, 1},
                  {"Annotations"}}}},
               {"CoSimulation",
                {{{"modelIdentifier", kName},
                  {"needsExecutionTool", kBoolean},
                  {"canBeInstantiatedOnlyOncePerProcess", kBoolean},
                  {"canGetAndSetFMUState", kBoolean},
                  {"canSerializeFMUState", kBoolean},
                  {"providesDirectionalDerivatives", kBoolean},
                  {"providesAdjointDerivatives", kBoolean},
                  {"providesPerElementDependencies", kBoolean},
                  {"canHandleVariableCommunicationStepSize", kBoolean},
                  {"fixedInternalStepSize", kDouble},
                  {"maxOutputDerivativeOrder", kUnsigned},
                  {"recommendedIntermediateInputSmoothness", kInt},
                  {"providesIntermediateUpdate", kBoolean},
                  {"mightReturnEarlyFromDoStep", kBoolean},
                  {"canReturnEarlyAfterIntermediateUpdate", kBoolean},
                  {"hasEventMode", kBoolean},
                  {"providesEvaluateDiscreteStates", kBoolean}},
                 {{"Annotations"}}}},
               {"Annotations", {{}, {{"Annotation", 1, kMany}}}},
               {"Annotation", {{{"type", kName}}, {}, true}},
               {"ModelVariables", {{}, {{"Float64", 1, kMany}}}},
               {"Float64",
                {{{"name", kName},
                  {"valueReference", kReference},
                  {"description", kText},
                  {"causality", {kCausalities}},
                  {"variability", {kVariabilities}},
                  {"canHandleMultipleSetPerTimeInstant", kBoolean},
                  {"intermediateUpdate", kBoolean},
                  {"previous", kUnsigned},
                  {"clocks", {"list of unsignedInt"}},
                  {"declaredType", kNormalized},
                  {"initial", {kInitials}},
                  {"quantity", kNormalized},
                  {"unit", kNormalized},
                  {"displayUnit", kNormalized},
                  {"relativeQuantity", kBoolean},
                  {"unbounded", kBoolean},
                  {"min", kDouble},
                  {"max", kDouble},
                  {"nominal", kDouble},
                  {"start", kDouble},
                  {"derivative", kUnsigned},
                  {"reinit", kBoolean}},
                 {{"Annotations"}, {"Dimension", 0, kMany}, {"Alias", 0, kMany}}}},
               {"ModelStructure",
                {{},
                 {{"Output", 0, kMany},
                  {"ContinuousStateDerivative", 0, kMany},
                  {"ClockedState", 0, kMany},
                  {"InitialUnknown", 0, kMany},
                  {"EventIndicator", 0, kMany}}}},
               {"Output", unknown},
               {"InitialUnknown", unknown}});
  return made;
}

Schema build_schema() {
  return {{"fmiBuildDescription",
           {{{"fmiVersion", {"3.0", true}}}, {{"BuildConfiguration", 1, kMany}, {"Annotations"}}}},
          {"BuildConfiguration",
           {{{"modelIdentifier", kName}, {"platform", kNormalized}, {"description", kText}},
            {{"SourceFileSet", 0, kMany}, {"Library", 0, kMany}, {"Annotations"}}}},
          {"SourceFileSet",
           {{{"name", kNormalized},
             {"language", kNormalized},
             {"compiler", kNormalized},
             {"compilerOptions", kText}},
            {{"SourceFile", 1, kMany},
             {"PreprocessorDefinition", 0, kMany},
             {"IncludeDirectory", 0, kMany},
             {"Annotations"}}}},
          {"SourceFile", {{{"name", kName}}}},
          {"IncludeDirectory", {{{"name", kName}}}},
          {"Library",
           {{{"name", kName},
             {"version", kNormalized},
             {"external", kBoolean},
             {"description", kText}}}}};
}

}  // namespace flexarm::testing_export
