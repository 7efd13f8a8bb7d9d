#include "native/errors.h"

#include <new>

namespace medial_vk::python {
namespace {

namespace py = pybind11;

const char* class_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return "UsageError";
    case ErrorCode::kInvalidMesh:
      return "InvalidMeshError";
    case ErrorCode::kNoDevice:
      return "NoDeviceError";
    case ErrorCode::kOutOfMemory:
      return "OutOfMemoryError";
    case ErrorCode::kInterrupted:
      return "StoppedError";
    case ErrorCode::kInternal:
      break;
  }
  return "InternalError";
}

/// The message is decoded with replacements: a text of the host, such as a path, need not be UTF-8.
void raise(const Error& error) {
  const py::object type = py::module_::import("medial_vk.errors").attr(class_of(error.code));
  const py::object text = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(error.message.data(), static_cast<Py_ssize_t>(error.message.size()), "replace"));
  if (!text) throw py::error_already_set();
  PyErr_SetObject(type.ptr(), text.ptr());
}

void translate(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): pybind11's signature
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const LibraryError& error) {
    raise(error.error());
  } catch (const std::bad_alloc&) {
    raise({ErrorCode::kOutOfMemory, "memory does not suffice"});
  }
}

}  // namespace

void register_errors() { py::register_local_exception_translator(&translate); }

}  // namespace medial_vk::python
