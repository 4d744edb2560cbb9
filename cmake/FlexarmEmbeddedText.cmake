# flexarm_embedded_text(OUTPUT HEADER header NAMESPACE namespace FUNCTION name FILE file)
#   A generated source with `std::string_view name()`, declared in the header, which returns the text
#   of the file. OUTPUT is set to the source's path. CMake runs anew when the file changes.
function(flexarm_embedded_text output)
  cmake_parse_arguments(TEXT "" "HEADER;NAMESPACE;FUNCTION;FILE" "" ${ARGN})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${TEXT_FILE}")
  file(READ "${TEXT_FILE}" text)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${TEXT_FUNCTION}.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY CONTENT
"#include \"@TEXT_HEADER@\"

namespace @TEXT_NAMESPACE@ {

std::string_view @TEXT_FUNCTION@() {
  return R\"embedded_text(@text@)embedded_text\";
}

}  // namespace @TEXT_NAMESPACE@
")
  set(${output} "${source}" PARENT_SCOPE)
endfunction()
