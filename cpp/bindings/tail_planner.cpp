#include "clearway/multi/tail_planner.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

// An interrupt ends a search with an exception.
Tail searched(TailPlanner& planner, const TailQuery& query,
              Tail (TailPlanner::*search)(const TailQuery&, Budget&)) {
  Budget budget;
  budget.stop = [] {
    nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    return false;
  };
  nb::gil_scoped_release release;
  return (planner.*search)(query, budget);
}

std::vector<std::shared_ptr<const Statics>> constant(
    const std::vector<std::shared_ptr<Statics>>& statics) {
  return {statics.begin(), statics.end()};
}

}  // namespace

void bind_tail_planner(nb::module_& m) {
  nb::class_<TailParams>(m, "TailParams", "Parameters of always-complete planning.")
      .def(nb::init<>())
      .def_rw("search", &TailParams::search)
      .def_rw("objective", &TailParams::objective)
      .def_rw("margin", &TailParams::margin);
  nb::class_<TailQuery>(m, "TailQuery", "A new tail that is asked for.")
      .def(nb::init<>())
      .def_rw("robot", &TailQuery::robot)
      .def_rw("now", &TailQuery::now)
      .def_rw("kept", &TailQuery::kept)
      .def_rw("start", &TailQuery::start)
      .def_rw("mode", &TailQuery::mode)
      .def_rw("ready", &TailQuery::ready)
      .def_rw("legs", &TailQuery::legs)
      .def_rw("rests", &TailQuery::rests)
      .def_rw("rest_body", &TailQuery::rest_body)
      .def_rw("fine", &TailQuery::fine)
      .def_rw("limit", &TailQuery::limit);
  nb::class_<Tail>(m, "Tail", "What a search for a tail came to.")
      .def_prop_ro("found",
                   [](const Tail& t) { return t.tour.outcome == TourResult::Outcome::kFound; })
      .def_prop_ro("exhausted",
                   [](const Tail& t) { return t.tour.outcome == TourResult::Outcome::kExhausted; })
      .def_prop_ro("pieces", [](const Tail& t) { return t.tour.pieces; })
      .def_prop_ro("stops", [](const Tail& t) { return t.tour.stops; })
      .def_ro("rest", &Tail::rest)
      .def_ro("expansions", &Tail::expansions)
      .def_ro("met", &Tail::met);
  nb::class_<TailMeeting>(m, "TailMeeting", "Whom a robot meets, and where it is then.")
      .def_ro("robot", &TailMeeting::robot)
      .def_ro("at", &TailMeeting::at);
  nb::class_<TailPlanner>(m, "TailPlanner",
                          "Everybody's committed motion, of which tails are replaced one by one.")
      .def(nb::init<std::vector<Model>, std::vector<int>, const TailParams&>(), "models"_a,
           "model_of"_a, "params"_a)
      .def("place", &TailPlanner::place, "robot"_a, "now"_a, "start"_a, "pieces"_a, "body"_a)
      .def(
          "plan",
          [](TailPlanner& planner, const TailQuery& query) {
            return searched(planner, query, &TailPlanner::plan);
          },
          "query"_a, "Commit a robot to a new tail, if one is found.")
      .def(
          "alone",
          [](TailPlanner& planner, const TailQuery& query) {
            return searched(planner, query, &TailPlanner::alone);
          },
          "query"_a, "The tail that it would have with nobody else on the site.")
      .def("meetings", &TailPlanner::meetings, "robot"_a, "pieces"_a, "earlier"_a,
           "Whom a robot would meet first if it drove pieces so many ticks earlier.")
      .def(
          "clear_until",
          [](const TailPlanner& planner, int robot, Ticks now,
             const std::vector<std::shared_ptr<Statics>>& statics) {
            return planner.clear_until(robot, now, constant(statics));
          },
          "robot"_a, "now"_a, "statics"_a,
          "Last tick up to which a robot's motion is clear of what stands; NEVER if always.")
      .def("settled", &TailPlanner::settled, "robot"_a, "When a robot comes to its last rest.")
      .def(
          "rebuild",
          [](TailPlanner& planner,
             const std::vector<std::vector<std::shared_ptr<Statics>>>& statics) {
            std::vector<std::vector<std::shared_ptr<const Statics>>> all;
            for (const auto& of_model : statics) all.push_back(constant(of_model));
            planner.rebuild(all);
          },
          "statics"_a, "Take over what stands, for each model and body.");
}

}  // namespace clearway::bindings
