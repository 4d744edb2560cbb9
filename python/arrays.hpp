#pragma once

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::python {

/// Numbers of a result as NumPy has them: read-only, and without a copy. `owner` is the Python
/// object whose numbers they are; the array keeps it alive.
template <class T>
pybind11::array_t<T> view(std::span<const T> values, pybind11::handle owner) {
  pybind11::array_t<T> array({static_cast<pybind11::ssize_t>(values.size())}, values.data(), owner);
  pybind11::detail::array_proxy(array.ptr())->flags &=
      ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// The same of a matrix, whose columns Eigen stores one after the other.
inline pybind11::array_t<double> view(const Eigen::MatrixXd& matrix, pybind11::handle owner) {
  constexpr pybind11::ssize_t kSize = sizeof(double);
  pybind11::array_t<double> array({matrix.rows(), matrix.cols()}, {kSize, kSize * matrix.rows()},
                                  matrix.data(), owner);
  pybind11::detail::array_proxy(array.ptr())->flags &=
      ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// The getter of a property whose numbers are the member of the C++ object.
template <class Object, class T>
auto view_of(std::vector<T> Object::*member) {
  return [member](const pybind11::object& self) {
    return view<T>(self.cast<const Object&>().*member, self);
  };
}

/// An array that takes the numbers over, of any shape with as many elements, by rows.
template <class T>
pybind11::array_t<T> owned(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const T* first = kept->data();
  const pybind11::capsule owner(kept.release(), [](void* pointer) {
    delete static_cast<std::vector<T>*>(pointer);  // NOLINT: a capsule has no other deleter
  });
  return pybind11::array_t<T>(std::move(shape), first, owner);
}

template <class T>
pybind11::array_t<T> owned(std::vector<T> values) {
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  return owned(std::move(values), {size});
}

/// An argument of numbers: anything that NumPy makes an array of doubles of, by rows.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;
using ComplexNumbers =
    pybind11::array_t<std::complex<double>, pybind11::array::c_style | pybind11::array::forcecast>;

/// The numbers of a one-dimensional argument. Throws arm::InputError, with the argument's name, for
/// another shape.
std::vector<double> one_dimensional(const Numbers& numbers, const char* argument);

}  // namespace flexarm::python
