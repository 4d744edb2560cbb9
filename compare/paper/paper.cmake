# The paper's tables, built into the program from data/paper.
foreach(number RANGE 1 7)
  set(table "${PROJECT_SOURCE_DIR}/data/paper/table_${number}.csv")
  file(READ "${table}" PAPER_TABLE_${number})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${table}")
endforeach()
set(paper_tables "${CMAKE_CURRENT_BINARY_DIR}/paper_csv.cpp")
configure_file(paper/paper_csv.cpp.in "${paper_tables}" @ONLY)
