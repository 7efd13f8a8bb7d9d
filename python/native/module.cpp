// The module medial_vk._native: the calls of the library on NumPy arrays. Its functions are private; the package
// medial_vk gives them names, defaults, types and documentation.
#include <pybind11/pybind11.h>

#include <string>

#include "medial_vk/version.h"
#include "native/calls.h"
#include "native/errors.h"
#include "native/handles.h"

namespace {

namespace py = pybind11;

/// Objects of the library cannot be pickled, and say so: a mesh, a body and an analysis are pickled by the package.
void refuse_pickling(const py::module_& module) {
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (!py::isinstance<py::type>(value)) continue;
    const py::cpp_function refuse(
        [](const py::object& self) -> py::object {
          throw py::type_error(py::type::of(self).attr("__name__").cast<std::string>() +
                               " cannot be pickled, nor copied deeply: it belongs to the library in this process");
        },
        py::name("__reduce__"), py::is_method(value));
    value.attr("__reduce__") = refuse;
  }
}

}  // namespace

PYBIND11_MODULE(_native, module) {
  namespace python = medial_vk::python;
  module.doc() = "Calls of the medial-vk library; use the package medial_vk.";
  module.attr("VERSION") = std::to_string(MEDIAL_VK_VERSION_MAJOR) + "." + std::to_string(MEDIAL_VK_VERSION_MINOR) +
                           "." + std::to_string(MEDIAL_VK_VERSION_PATCH);
  module.def("wait_for_abandoned", &python::Call::wait_for_abandoned);
  python::register_errors();
  python::bind_context(module);
  python::bind_mesh(module);
  python::bind_analysis(module);
  python::bind_spheres(module);
  python::bind_hulls(module);
  python::bind_unions(module);
  python::bind_distances(module);
  python::bind_following(module);
  python::bind_boundary(module);
  python::bind_plane(module);
  python::bind_plane_axis(module);
  python::bind_sites(module);
  python::bind_any_boundary(module);
  python::bind_part_fits(module);
  python::bind_body_groups(module);
  refuse_pickling(module);
}
