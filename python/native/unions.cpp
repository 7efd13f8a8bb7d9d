#include <pybind11/stl.h>

#include "medial_vk/ball_union.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// The complex of a union, as betti_numbers() requires it: nobody but the library makes one.
struct ComplexHandle {
  DualComplex complex;
};

py::dict complex_dict(const ComplexHandle& handle) {
  const DualComplex& complex = handle.complex;
  py::dict out;
  out["vertices"] = array_of(std::vector<std::uint32_t>(complex.vertices));
  out["edges"] = array_of(std::vector<std::array<std::uint32_t, 2>>(complex.edges));
  out["triangles"] = array_of(std::vector<std::array<std::uint32_t, 3>>(complex.triangles));
  out["tetrahedra"] = array_of(std::vector<std::array<std::uint32_t, 4>>(complex.tetrahedra));
  return out;
}

py::tuple topology(const std::shared_ptr<ComplexHandle>& handle) {
  const BettiNumbers betti = value_of(run([handle] { return betti_numbers(handle->complex); }));
  return py::make_tuple(betti.components, betti.tunnels, betti.cavities);
}

/// Fewer balls are measured on the calling thread: a thread of its own would take longer than the work.
constexpr std::size_t kFewBalls = 100;

py::dict measure(py::handle centres, py::handle radii, bool with_complex, unsigned threads) {
  std::vector<Ball> balls = balls_of(centres, radii);
  const bool is_short = balls.size() <= kFewBalls;
  const BallUnionOptions options = {.threads = threads, .complex = with_complex};
  BallUnion made = value_of(run_unless_short(is_short, std::make_shared<Call>(), [balls = std::move(balls), options] {
    return measure_ball_union(balls, options);
  }));
  py::dict out;
  out["volume"] = made.volume;
  out["area"] = made.area;
  out["volumes"] = array_of(std::move(made.volumes));
  out["areas"] = array_of(std::move(made.areas));
  out["vectors"] = array_of(std::move(made.vectors));
  out["complex"] = py::none();
  if (with_complex) out["complex"] = std::make_shared<ComplexHandle>(ComplexHandle{std::move(made.complex)});
  out["envelope_vertices"] = column(made.vertices, [](const EnvelopeVertex& vertex) { return vertex.at; });
  out["envelope_balls"] = column(made.vertices, [](const EnvelopeVertex& vertex) { return vertex.balls; });
  return out;
}

py::dict measure_on_device(py::handle centres, py::handle radii, const ContextHandle& context, double tolerance,
                           unsigned threads) {
  const std::vector<Ball> balls = balls_of(centres, radii);
  const auto call = std::make_shared<Call>();
  DeviceBallUnion made = value_of(run(call, [balls, context, tolerance, threads, call] {
    return context->use(call->token(), [&](Context& device) {
      return measure_ball_union(balls, {.threads = threads, .tolerance = tolerance}, device);
    });
  }));
  py::dict out;
  out["volume"] = made.volume;
  out["area"] = made.area;
  out["volume_bound"] = made.volume_bound;
  out["area_bound"] = made.area_bound;
  out["volumes"] = array_of(std::move(made.volumes));
  out["areas"] = array_of(std::move(made.areas));
  out["volume_bounds"] = array_of(std::move(made.volume_bounds));
  out["area_bounds"] = array_of(std::move(made.area_bounds));
  out["redone"] = array_of(std::move(made.redone));
  return out;
}

}  // namespace

void bind_unions(py::module_& module) {
  py::class_<ComplexHandle, std::shared_ptr<ComplexHandle>>(module, "DualComplex")
      .def("simplices", &complex_dict)
      .def("betti_numbers", &topology);
  module.def("measure_union", &measure);
  module.def("measure_union_on_device", &measure_on_device);
}

}  // namespace medial_vk::python
