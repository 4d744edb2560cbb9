# flexarm_eigen: what Eigen compiles slowest and many sources use, compiled once. The header that
# says so is among the precompiled ones (FlexarmOptimisation.cmake): sources need not know of it.
set(factors)
foreach(name HouseholderQR ColPivHouseholderQR CompleteOrthogonalDecomposition PartialPivLU LLT LDLT)
  list(APPEND factors "class Eigen::${name}<Eigen::MatrixXd>")
endforeach()
list(APPEND factors "class Eigen::PartialPivLU<Eigen::MatrixXcd>")

set(symmetric)
foreach(name Tridiagonalization SelfAdjointEigenSolver GeneralizedSelfAdjointEigenSolver)
  list(APPEND symmetric "class Eigen::${name}<Eigen::MatrixXd>")
endforeach()

set(unsymmetric)
foreach(name HessenbergDecomposition RealSchur EigenSolver RealQZ GeneralizedEigenSolver)
  list(APPEND unsymmetric "class Eigen::${name}<Eigen::MatrixXd>")
endforeach()
foreach(name RealSchur EigenSolver)
  set(class "Eigen::${name}<Eigen::MatrixXd>")
  list(APPEND unsymmetric
       "${class}& ${class}::compute(const Eigen::EigenBase<Eigen::MatrixXd>&, bool)")
endforeach()

set(singular "class Eigen::JacobiSVD<Eigen::MatrixXd>" "class Eigen::JacobiSVD<Eigen::MatrixXcd>")

# Kernels of products: blocks, matrix times vector in either storage order, triangle times matrix.
set(products)
foreach(scalar double std::complex<double>)
  set(blocks 1)
  if(scalar STREQUAL double)
    set(blocks 4)
  endif()
  set(result "Eigen::internal::blas_data_mapper<${scalar}, Eigen::Index, 0, 0, 1>")
  list(APPEND products "struct Eigen::internal::gebp_kernel<${scalar}, ${scalar}, Eigen::Index, \
${result}, ${blocks}, 4, false, false>")
  foreach(orders "0;0;0" "0;1;0" "1;0;0" "1;1;0" "1;1;1")
    list(GET orders 0 order)
    list(GET orders 1 vector_order)
    list(GET orders 2 version)
    set(operand "Eigen::internal::const_blas_data_mapper<${scalar}, Eigen::Index,")
    list(APPEND products "struct Eigen::internal::general_matrix_vector_product<Eigen::Index, \
${scalar}, ${operand} ${order}>, ${order}, false, ${scalar}, ${operand} ${vector_order}>, false, \
${version}>")
  endforeach()
endforeach()
foreach(mode Lower Upper UnitLower UnitUpper)
  foreach(order 0 1)
    list(APPEND products "struct Eigen::internal::product_triangular_matrix_matrix<double, \
Eigen::Index, Eigen::${mode}, true, ${order}, false, 0, false, 0, 1, 0>")
  endforeach()
endforeach()

set(FLEXARM_EIGEN_HEADER "${CMAKE_CURRENT_BINARY_DIR}/eigen_instances.hpp")
set(declarations)
add_library(flexarm_eigen STATIC)
foreach(group factors symmetric unsymmetric singular products)
  set(definitions)
  foreach(instance IN LISTS ${group})
    string(APPEND declarations "extern template ${instance};\n")
    string(APPEND definitions "template ${instance};\n")
  endforeach()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/eigen_${group}.cpp")
  file(CONFIGURE OUTPUT "${source}" @ONLY
       CONTENT "#include \"@FLEXARM_EIGEN_HEADER@\"\n@definitions@")
  target_sources(flexarm_eigen PRIVATE "${source}")
endforeach()
file(CONFIGURE OUTPUT "${FLEXARM_EIGEN_HEADER}" @ONLY
     CONTENT "#pragma once\n#include <Eigen/Dense>\n#include <complex>\n@declarations@")
target_link_libraries(flexarm_eigen PRIVATE "$<BUILD_INTERFACE:Eigen3::Eigen>")
set_target_properties(flexarm_eigen PROPERTIES EXPORT_NAME eigen)
install(TARGETS flexarm_eigen EXPORT flexarmTargets)
