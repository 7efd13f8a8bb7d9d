#include "native/options.h"

#include <fmt/format.h>

namespace medial_vk::python {

namespace py = pybind11;

py::object Options::take(const char* name) {
  if (!values_.contains(name)) {
    throw LibraryError({ErrorCode::kInternal, fmt::format("the option `{}` is missing", name)});
  }
  return values_.attr("pop")(name);
}

std::string Options::text_of(const char* name) {
  const py::object value = take(name);
  if (!py::isinstance<py::str>(value)) fail(name, value);
  return value.cast<std::string>();
}

void Options::fail(const char* name, const py::object& value) {
  fail_usage(fmt::format("`{}` cannot be {}", name, std::string(py::repr(value))));
}

void Options::fail_choice(const char* name, const std::string& text, const std::string& known) {
  fail_usage(fmt::format("`{}` is \"{}\", not one of: {}", name, text, known));
}

void Options::finish() const {
  if (values_.empty()) return;
  throw LibraryError({ErrorCode::kInternal, fmt::format("unknown options {}", std::string(py::repr(values_)))});
}

}  // namespace medial_vk::python
