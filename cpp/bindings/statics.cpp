#include "clearway/space/statics.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"
#include "clearway/search/geodesic.hpp"
#include "clearway/search/goal_distance.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

std::vector<Point> to_points(const std::vector<std::array<double, 2>>& in) {
  std::vector<Point> out;
  for (const auto& p : in) out.push_back({p[0], p[1]});
  return out;
}

}  // namespace

void bind_statics(nb::module_& m) {
  nb::class_<Obstacles>(m, "Obstacles", "Edges, discs and outlines of one layer.")
      .def(
          "__init__",
          [](Obstacles* self, const std::array<double, 4>& box,
             const std::vector<std::array<double, 4>>& segments,
             const std::vector<std::array<double, 3>>& discs,
             const std::vector<std::vector<std::array<double, 2>>>& solids,
             const std::vector<std::array<double, 2>>& bounds) {
            new (self) Obstacles;
            self->box = {box[0], box[1], box[2], box[3]};
            for (const auto& s : segments) self->segments.push_back({{s[0], s[1]}, {s[2], s[3]}});
            for (const auto& d : discs) self->discs.push_back({d[0], d[1], d[2]});
            for (const auto& s : solids) self->solids.push_back(to_points(s));
            self->bounds = to_points(bounds);
          },
          "box"_a, "segments"_a, "discs"_a, "solids"_a, "bounds"_a);
  nb::class_<Geodesic>(m, "Geodesic", "Shortest ways of a disc among obstacles, any angle.")
      .def(nb::init<const Obstacles&, double>(), "obstacles"_a, "radius"_a)
      .def(
          "__call__",
          [](Geodesic& geodesic, const std::array<double, 2>& from,
             const std::array<double, 2>& to) {
            return geodesic({from[0], from[1]}, {to[0], to[1]});
          },
          "start"_a, "goal"_a, "Length of the shortest way (m); infinite where there is none.");
  nb::class_<Statics>(m, "Statics", "Obstacles of one layer behind a distance field.")
      .def(nb::init<Obstacles, double>(), "obstacles"_a, "reach"_a)
      .def("clearance", &Statics::clearance, "x"_a, "y"_a,
           "Lower bound of the distance to the nearest obstacle (m).")
      .def(
          "gap",
          [](const Statics& s, const Body& body, const Pose& p) { return s.gap(body, Frame(p)); },
          "body"_a, "pose"_a, "Signed gap of a placed body (m).")
      .def(
          "clear",
          [](const Statics& s, const Body& body, const Pose& start, const Twist& motion,
             double required,
             double slack) { return s.clear(body, Frame(start), motion, required, slack); },
          "body"_a, "start"_a, "motion"_a, "required"_a = 0.0, "slack"_a = 0.0008,
          "Whether a body keeps the required gap all along a motion.");
  m.def(
      "goal_distances",
      [](const Statics& statics, double radius, const std::array<double, 2>& goal, double cell,
         const std::vector<std::array<double, 2>>& points) {
        const GoalDistance distance(statics, radius, goal[0], goal[1], cell);
        std::vector<float> out;
        for (const auto& p : points) out.push_back(distance(p[0], p[1]));
        return out;
      },
      "statics"_a, "radius"_a, "goal"_a, "cell"_a, "points"_a,
      "Obstacle-aware distances (m) of points to a goal for a disc of the given radius.");
}

}  // namespace clearway::bindings
