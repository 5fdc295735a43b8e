#include "clearway/multi/path_conflicts.hpp"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <utility>

#include "bind.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

using Passages = std::vector<std::pair<Ticks, Ticks>>;

Passages pairs_of(const std::vector<Passage>& passages) {
  Passages out;
  for (const Passage& p : passages) out.emplace_back(p.at, p.passed);
  return out;
}

}  // namespace

void bind_path_conflicts(nb::module_& m) {
  nb::class_<CommittedPath>(m, "CommittedPath", "A robot's whole motion, cut into cells.")
      .def(
          "__init__",
          [](CommittedPath* self, const std::vector<Body>& bodies, const Pose& start,
             const std::vector<TimedPiece>& pieces, double cell) {
            if (bodies.empty()) throw std::invalid_argument("a path needs a body");
            if (!(cell > 0.0)) throw std::invalid_argument("cell must be above 0");
            Ticks tick = 0;
            for (const TimedPiece& p : pieces) {
              if (p.begin != tick || p.end <= p.begin) {
                throw std::invalid_argument("pieces must follow each other from tick 0 on");
              }
              if (p.body < 0 || static_cast<std::size_t>(p.body) >= bodies.size()) {
                throw std::invalid_argument("a piece has a body that is not there");
              }
              tick = p.end;
            }
            new (self) CommittedPath(bodies, start, pieces, cell);
          },
          "bodies"_a, "start"_a, "pieces"_a, "cell"_a)
      .def_prop_ro("num_cells", [](const CommittedPath& path) { return path.cells().size(); });
  nb::class_<PathParams>(m, "PathParams", "How exactly places of conflict are told.")
      .def(nb::init<>())
      .def_rw("margin", &PathParams::margin)
      .def_rw("finest", &PathParams::finest);
  nb::class_<PathConflicts>(m, "PathConflicts", "What two robots wait for: (at, passed), rising.")
      .def_prop_ro("first", [](const PathConflicts& c) { return pairs_of(c.first); })
      .def_prop_ro("second", [](const PathConflicts& c) { return pairs_of(c.second); })
      .def_ro("meeting", &PathConflicts::meeting);
  m.def("path_conflicts", &path_conflicts, "a"_a, "done_a"_a, "b"_a, "done_b"_a, "params"_a,
        nb::call_guard<nb::gil_scoped_release>(),
        "Where two committed motions need the same floor, whatever their times become.");
  m.def("paths_overlap", &paths_overlap, "a"_a, "from_a"_a, "to_a"_a, "b"_a, "from_b"_a, "to_b"_a,
        "Whether bodies are in each other for some tick of each of two stretches.");
}

}  // namespace clearway::bindings
