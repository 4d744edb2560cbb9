# flexarm_registry(OUTPUT HEADER header NAMESPACE namespace TYPE type FUNCTION name FILES ...)
#   Of files NAME.cpp that each define `type NAME()` in the namespace: a generated source with
#   `std::vector<type> name()`, declared in the header, that calls all of them. A new file is then
#   all that a new entry needs. OUTPUT is set to the source's path.
function(flexarm_registry output)
  cmake_parse_arguments(REGISTRY "" "HEADER;NAMESPACE;TYPE;FUNCTION" "FILES" ${ARGN})
  set(declarations)
  set(calls)
  foreach(file IN LISTS REGISTRY_FILES)
    get_filename_component(name "${file}" NAME_WE)
    string(APPEND declarations "${REGISTRY_TYPE} ${name}();\n")
    string(APPEND calls "${name}(), ")
  endforeach()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${REGISTRY_FUNCTION}.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT
"#include \"@REGISTRY_HEADER@\"

namespace @REGISTRY_NAMESPACE@ {

@declarations@
std::vector<@REGISTRY_TYPE@> @REGISTRY_FUNCTION@() {
  return {@calls@};
}

}  // namespace @REGISTRY_NAMESPACE@
")
  set(${output} "${source}" PARENT_SCOPE)
endfunction()
