#include "native/arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "native/errors.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// The object as an array: lists and whatever else NumPy converts. Exceptions of the object itself arrive as they are.
py::array as_array(py::handle array_like, const char* name) {
  const auto& numpy = py::detail::npy_api::get();
  PyObject* const made =
      numpy.PyArray_FromAny_(array_like.ptr(), nullptr, 0, 0, py::detail::npy_api::NPY_ARRAY_ENSUREARRAY_, nullptr);
  if (made != nullptr) return py::reinterpret_steal<py::array>(made);
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0 && PyErr_ExceptionMatches(PyExc_ValueError) == 0) {
    throw py::error_already_set();
  }
  PyErr_Clear();
  fail_usage(fmt::format("`{}` is no array of numbers", name));
}

std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

[[noreturn]] void fail_shape(const py::array& array, const char* name, const char* expected) {
  fail_usage(fmt::format("`{}` has the shape {} where {} is expected", name, shape_text(array), expected));
}

/// Rows of n, of an array of the type `From`, wherever they lie in memory.
template <class From, class To, std::size_t n, class Convert>
void read_rows(const py::array& array, std::vector<std::array<To, n>>& rows, Convert convert) {
  const auto* bytes = static_cast<const char*>(array.data());
  const py::ssize_t step = array.strides(0), inner = array.strides(1);
  rows.resize(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      From value;  // an array need not be aligned
      std::memcpy(&value, bytes + static_cast<py::ssize_t>(i) * step + static_cast<py::ssize_t>(k) * inner,
                  sizeof(From));
      rows[i][k] = convert(value, i);
    }
  }
}

template <class T>
bool has_type(const py::array& array) {
  return py::isinstance<py::array_t<T>>(array);
}

/// An array of real numbers of another type as one of doubles.
py::array as_doubles(const py::array& array, const char* name) {
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u' && kind != 'b') {
    fail_usage(fmt::format("`{}` has the type {}, not one of real numbers", name, std::string(py::str(array.dtype()))));
  }
  py::array doubles = py::array_t<double>::ensure(array);
  if (!doubles) throw std::bad_alloc();  // all of these types convert
  return doubles;
}

/// An empty list counts as no rows.
bool is_empty_list(const py::array& array) { return array.ndim() == 1 && array.size() == 0; }

/// The numbers of an array of doubles with one dimension, wherever they lie.
std::vector<double> row_of(const py::array& doubles) {
  const auto* bytes = static_cast<const char*>(doubles.data());
  std::vector<double> numbers(static_cast<std::size_t>(doubles.shape(0)));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::memcpy(&numbers[i], bytes + static_cast<py::ssize_t>(i) * doubles.strides(0), sizeof(double));
  }
  return numbers;
}

template <std::size_t n>
void require_rows(const py::array& array, const char* name) {
  static_assert(n == 2 || n == 3);
  if (array.ndim() != 2 || array.shape(1) != py::ssize_t{n}) fail_shape(array, name, n == 3 ? "(n, 3)" : "(n, 2)");
}

template <std::size_t n>
std::vector<std::array<double, n>> rows_of_numbers(py::handle array_like, const char* name) {
  py::array array = as_array(array_like, name);
  std::vector<std::array<double, n>> points;
  if (is_empty_list(array)) return points;
  require_rows<n>(array, name);
  if (has_type<float>(array)) {
    read_rows<float>(array, points, [](float x, std::size_t) { return double{x}; });
    return points;
  }
  if (!has_type<double>(array)) array = as_doubles(array, name);
  read_rows<double>(array, points, [](double x, std::size_t) { return x; });
  return points;
}

template <std::size_t n>
std::array<double, n> row_of_numbers(py::handle array_like, const char* name) {
  static_assert(n == 2 || n == 3);
  const py::array array = as_array(array_like, name);
  if (array.ndim() != 1 || array.shape(0) != py::ssize_t{n}) fail_shape(array, name, n == 3 ? "(3,)" : "(2,)");
  const std::vector<double> numbers = row_of(as_doubles(array, name));
  std::array<double, n> point;
  for (std::size_t k = 0; k < n; ++k) point[k] = numbers[k];
  return point;
}

/// Of an array with two dimensions, or an empty list.
template <std::size_t n>
std::vector<std::array<std::uint32_t, n>> rows_of_indices(const py::array& array, const char* name) {
  std::vector<std::array<std::uint32_t, n>> rows;
  if (is_empty_list(array)) return rows;
  const auto index = [name](auto value, std::size_t row) {
    if (value < 0 || static_cast<std::uint64_t>(value) > std::numeric_limits<std::uint32_t>::max()) {
      fail_usage(fmt::format("row {} of `{}` has the value {}, which is no index", row, name, value));
    }
    return static_cast<std::uint32_t>(value);
  };
  if (has_type<std::int32_t>(array)) {
    read_rows<std::int32_t>(array, rows, index);
  } else if (has_type<std::uint32_t>(array)) {
    read_rows<std::uint32_t>(array, rows, [](std::uint32_t value, std::size_t) { return value; });
  } else if (has_type<std::uint64_t>(array)) {
    read_rows<std::uint64_t>(array, rows, index);
  } else if (array.dtype().kind() == 'i' || array.dtype().kind() == 'u' || array.size() == 0) {
    const py::array wide = py::array_t<std::int64_t>::ensure(array);
    if (!wide) throw std::bad_alloc();
    read_rows<std::int64_t>(wide, rows, index);
  } else {
    fail_usage(fmt::format("`{}` has the type {}, not one of integers", name, std::string(py::str(array.dtype()))));
  }
  return rows;
}

constexpr double kRotationTolerance = 1e-12;  // of the library's precondition (proximity.h)

/// The greatest difference of products of rows from those of a rotation, and of the determinant from 1.
double distance_from_rotation(const std::array<Point, 3>& rows) {
  for (const Point& row : rows) {
    for (const double x : row) {
      if (!std::isfinite(x)) return std::numeric_limits<double>::infinity();
    }
  }
  double greatest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) {
      const double product = rows[i][0] * rows[j][0] + rows[i][1] * rows[j][1] + rows[i][2] * rows[j][2];
      const double difference = std::abs(product - (i == j ? 1 : 0));
      greatest = std::max(greatest, difference);
    }
  }
  const double determinant = rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) -
                             rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0]) +
                             rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
  return determinant > 0 ? greatest : std::numeric_limits<double>::infinity();
}

Pose pose_of(const std::array<double, 16>& m, std::size_t index, const char* name) {
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) {
    pose.rotation[i] = {m[4 * i], m[4 * i + 1], m[4 * i + 2]};
    pose.shift[i] = m[4 * i + 3];
    if (!std::isfinite(pose.shift[i])) fail_usage(fmt::format("the shift of `{}`[{}] is not finite", name, index));
  }
  if (!(distance_from_rotation(pose.rotation) <= kRotationTolerance)) {
    fail_usage(fmt::format("`{}`[{}] is no rigid motion to within {:g}: rigid_pose() makes the nearest one", name,
                           index, kRotationTolerance));
  }
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    fail_usage(fmt::format("the last row of `{}`[{}] is not 0, 0, 0, 1", name, index));
  }
  return pose;
}

}  // namespace

std::vector<Point> points_of(py::handle array_like, const char* name) { return rows_of_numbers<3>(array_like, name); }

Point point_of(py::handle array_like, const char* name) { return row_of_numbers<3>(array_like, name); }

std::vector<PlanePoint> plane_points_of(py::handle array_like, const char* name) {
  return rows_of_numbers<2>(array_like, name);
}

PlanePoint plane_point_of(py::handle array_like, const char* name) { return row_of_numbers<2>(array_like, name); }

std::vector<Triangle> triangles_of(py::handle array_like, const char* name) {
  const py::array array = as_array(array_like, name);
  if (!is_empty_list(array)) require_rows<3>(array, name);
  return rows_of_indices<3>(array, name);
}

std::vector<std::array<std::uint32_t, 2>> index_pairs_of(py::handle array_like, const char* name) {
  const py::array array = as_array(array_like, name);
  if (!is_empty_list(array)) require_rows<2>(array, name);
  return rows_of_indices<2>(array, name);
}

std::vector<std::uint32_t> indices_of(py::handle array_like, const char* name) {
  const py::array array = as_array(array_like, name);
  if (array.ndim() != 1) fail_shape(array, name, "(n,)");
  const std::vector<std::array<std::uint32_t, 1>> rows =
      rows_of_indices<1>(array[py::make_tuple(py::ellipsis(), py::none())], name);
  std::vector<std::uint32_t> indices;
  indices.reserve(rows.size());
  for (const auto& [index] : rows) indices.push_back(index);
  return indices;
}

std::vector<double> numbers_of(py::handle array_like, const char* name) {
  const py::array array = as_array(array_like, name);
  if (array.ndim() != 1) fail_shape(array, name, "(n,)");
  return row_of(as_doubles(array, name));
}

std::vector<Ball> balls_of(py::handle centres, py::handle radii) {
  const std::vector<Point> points = points_of(centres, "centres");
  const std::vector<double> lengths = numbers_of(radii, "radii");
  if (points.size() != lengths.size()) {
    fail_usage(fmt::format("there are {} `centres` and {} `radii`", points.size(), lengths.size()));
  }
  std::vector<Ball> balls(points.size());
  for (std::size_t i = 0; i < balls.size(); ++i) balls[i] = {points[i], lengths[i]};
  return balls;
}

std::vector<Pose> poses_of(py::handle array_like, const char* name) {
  const py::array array = as_array(array_like, name);
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) fail_shape(array, name, "(n, 4, 4)");
  const auto doubles = py::array_t<double, py::array::c_style | py::array::forcecast>(as_doubles(array, name));
  std::vector<Pose> poses(static_cast<std::size_t>(doubles.shape(0)));
  const auto* bytes = static_cast<const char*>(static_cast<const void*>(doubles.data()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::array<double, 16> matrix;  // an array need not be aligned
    std::memcpy(matrix.data(), bytes + i * sizeof(matrix), sizeof(matrix));
    poses[i] = pose_of(matrix, i, name);
  }
  return poses;
}

}  // namespace medial_vk::python
