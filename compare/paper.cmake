# The paper's tables, built into the program from data/paper.
foreach(number RANGE 1 7)
  set(table "${PROJECT_SOURCE_DIR}/data/paper/table_${number}.csv")
  file(READ "${table}" PAPER_TABLE_${number})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${table}")
endforeach()
configure_file(paper_csv.cpp.in "${CMAKE_CURRENT_BINARY_DIR}/paper_csv.cpp" @ONLY)

set(paper_sources
  "${CMAKE_CURRENT_BINARY_DIR}/paper_csv.cpp" paper_cells.cpp paper_check.cpp paper_forms.cpp
  paper_identification.cpp paper_measured_tables.cpp paper_modal_sums.cpp paper_mode_shapes.cpp
  paper_models.cpp paper_motion.cpp paper_state_space.cpp paper_table_figures.cpp paper_tables.cpp
  paper_topics.cpp paper_transfer_functions.cpp)
set(paper_headers
  paper_cells.hpp paper_check.hpp paper_csv.hpp paper_forms.hpp paper_measured_tables.hpp
  paper_modal_sums.hpp paper_models.hpp paper_tables.hpp paper_topics.hpp)
