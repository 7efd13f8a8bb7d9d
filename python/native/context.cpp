#include <pybind11/stl.h>

#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

py::dict device_dict(const DeviceDescription& device) {
  py::dict out;
  out["index"] = device.index;
  out["name"] = device.name;
  out["type"] = device.type;
  out["driver"] = device.driver;
  out["memory_bytes"] = device.memory_bytes;
  out["usable"] = device.usable;
  out["why_not"] = device.why_not;
  return out;
}

ContextHandle open_context(py::dict values) {
  ContextOptions made;
  Options options(std::move(values));
  options.read("device", made.device);
  options.read("threads", made.threads);
  options.read("validation", made.validation);
  options.read("cache_folder", made.cache_folder);
  options.finish();
  return value_of(run([made]() -> Result<ContextHandle> {
    Result<Context> context = Context::create(made);
    if (!context) return context.error();
    return std::make_shared<SharedContext>(std::move(context).value());
  }));
}

py::list list_devices() {
  const std::vector<DeviceDescription> devices = value_of(run([] { return Context::list_devices(); }));
  py::list out;
  for (const DeviceDescription& device : devices) out.append(device_dict(device));
  return out;
}

}  // namespace

void bind_context(py::module_& module) {
  py::class_<SharedContext, ContextHandle>(module, "Context")
      .def("device", [](const SharedContext& context) { return device_dict(context.device()); })
      .def("is_here", &SharedContext::is_here);
  module.def("open_context", &open_context);
  module.def("list_devices", &list_devices);
}

}  // namespace medial_vk::python
