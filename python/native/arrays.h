// NumPy arrays, and what looks like them, as values of the library, and back. Inputs are read while the interpreter's
// lock is held: no other thread can free or change them meanwhile.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/plane_shape.h"
#include "medial_vk/pose.h"

namespace medial_vk::python {

/// The rows of an array of numbers, shape (n, 3), of any real type; float64 and float32 are read in place. The library
/// tests the numbers. Error: kUsage, which calls the array `name`.
std::vector<Point> points_of(pybind11::handle array_like, const char* name);
/// One point, shape (3,).
Point point_of(pybind11::handle array_like, const char* name);
/// Points of the plane, shape (n, 2), and one, shape (2,).
std::vector<PlanePoint> plane_points_of(pybind11::handle array_like, const char* name);
PlanePoint plane_point_of(pybind11::handle array_like, const char* name);
/// The rows of an array of integers, shape (n, 3), whose values fit into 32 bits; all types of 32 and 64 bits are read
/// in place. Errors: kUsage (also names the first row with a value that does not fit).
std::vector<Triangle> triangles_of(pybind11::handle array_like, const char* name);
/// The same of two integers, shape (n, 2), and of one, shape (n,).
std::vector<std::array<std::uint32_t, 2>> index_pairs_of(pybind11::handle array_like, const char* name);
std::vector<std::uint32_t> indices_of(pybind11::handle array_like, const char* name);
/// Numbers, shape (n,).
std::vector<double> numbers_of(pybind11::handle array_like, const char* name);
/// Centres, shape (n, 3), and radii, shape (n,).
std::vector<Ball> balls_of(pybind11::handle centres, pybind11::handle radii);
/// Rigid motions, as matrices of shape (n, 4, 4) whose last rows are 0, 0, 0, 1. Error: kUsage, also for a matrix whose
/// upper left part is no rotation to within 1e-12, or whose shift is not finite.
std::vector<Pose> poses_of(pybind11::handle array_like, const char* name);

/// An array that owns the vector's memory, without a copy. Shape (size,).
template <class T>
pybind11::array_t<T> array_of(std::vector<T> values) {
  auto* owned = new std::vector<T>(std::move(values));
  const pybind11::capsule owner(owned, [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  return pybind11::array_t<T>(static_cast<pybind11::ssize_t>(owned->size()), owned->data(), owner);
}

/// The same for rows of n numbers: shape (size, n).
template <class T, std::size_t n>
pybind11::array_t<T> array_of(std::vector<std::array<T, n>> rows) {
  static_assert(sizeof(std::array<T, n>) == n * sizeof(T));
  auto* owned = new std::vector<std::array<T, n>>(std::move(rows));
  const pybind11::capsule owner(owned,
                                [](void* pointer) { delete static_cast<std::vector<std::array<T, n>>*>(pointer); });
  const std::array<pybind11::ssize_t, 2> shape = {static_cast<pybind11::ssize_t>(owned->size()),
                                                  static_cast<pybind11::ssize_t>(n)};
  return pybind11::array_t<T>(shape, owned->empty() ? nullptr : owned->front().data(), owner);
}

/// Shape (3,), or (2,) of the plane.
template <std::size_t n>
pybind11::array_t<double> array_of(const std::array<double, n>& point) {
  return pybind11::array_t<double>(n, point.data());
}

/// get(element) of each element of a range, as an array: a number for each, or a row.
template <class Range, class Get>
auto column(const Range& range, Get get) {
  using Value = std::remove_cvref_t<decltype(get(*std::begin(range)))>;
  std::vector<Value> values;
  values.reserve(std::size(range));
  for (const auto& element : range) values.push_back(get(element));
  return array_of(std::move(values));
}

/// Balls as their `centres` and `radii`.
inline pybind11::dict balls_dict(std::span<const Ball> balls) {
  pybind11::dict out;
  out["centres"] = column(balls, [](const Ball& ball) { return ball.centre; });
  out["radii"] = column(balls, [](const Ball& ball) { return ball.radius; });
  return out;
}

}  // namespace medial_vk::python
