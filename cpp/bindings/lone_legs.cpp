#include "clearway/multi/lone_legs.hpp"

#include <nanobind/stl/vector.h>

#include "bind.hpp"
#include "clearway/multi/prioritised.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

std::vector<Ticks> durations_of(const Model& model, const TeamParams& params,
                                const std::vector<LoneLeg>& legs) {
  Budget budget;
  budget.stop = [] {
    nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return false;
  };
  nb::gil_scoped_release release;
  return lone_durations(model, params.search, params.objective, params.margin, legs,
                        params.search_limit, budget);
}

}  // namespace

void bind_lone_legs(nb::module_& m) {
  nb::class_<LoneLeg>(m, "LoneLeg", "From one pose to another, with a body.")
      .def(
          "__init__",
          [](LoneLeg* self, const Pose& start, const Pose& goal, int body) {
            new (self) LoneLeg{start, goal, body};
          },
          "start"_a, "goal"_a, "body"_a);
  m.def("lone_durations", &durations_of, "model"_a, "params"_a, "legs"_a,
        "Ticks that each leg takes with nobody else on the site; -1 where no way is found.");
}

}  // namespace clearway::bindings
