#include "clearway/geometry/body.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

void bind_body(nb::module_& m) {
  nb::class_<Pose>(m, "Pose", "Position (m) and heading (rad).")
      .def(nb::init<double, double, double>(), "x"_a, "y"_a, "theta"_a)
      .def_ro("x", &Pose::x)
      .def_ro("y", &Pose::y)
      .def_ro("theta", &Pose::theta);
  nb::class_<Twist>(m, "Twist", "Body-frame displacement: along x (m), along y (m), turn (rad).")
      .def(nb::init<double, double, double>(), "a"_a, "b"_a, "c"_a)
      .def_ro("a", &Twist::a)
      .def_ro("b", &Twist::b)
      .def_ro("c", &Twist::c);
  nb::class_<Body>(m, "Body", "Convex parts in the body frame, or a disc.")
      .def(
          "__init__",
          [](Body* self, const std::vector<std::vector<std::array<double, 2>>>& parts,
             double disc_radius) {
            std::vector<std::vector<Point>> converted;
            for (const auto& part : parts) {
              auto& points = converted.emplace_back();
              for (const auto& p : part) points.push_back({p[0], p[1]});
            }
            new (self) Body(converted, disc_radius);
          },
          "parts"_a, "disc_radius"_a = 0.0)
      .def_prop_ro("circumradius", &Body::circumradius)
      .def_prop_ro("inradius", &Body::inradius)
      .def(
          "gap",
          [](const Body& a, const Pose& pa, const Body& b, const Pose& pb) {
            return gap(a, Frame(pa), b, Frame(pb), 1e300);
          },
          "pose"_a, "other"_a, "other_pose"_a, "Signed gap between two placed bodies (m).");
}

}  // namespace clearway::bindings
