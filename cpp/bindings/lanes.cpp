#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"
#include "clearway/multi/lane_search.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

using Bytes = nb::ndarray<const std::uint8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

void check(const Bytes& bytes, const CellHolds& holds, const char* name) {
  if (bytes.shape(0) != static_cast<std::size_t>(holds.height()) ||
      bytes.shape(1) != static_cast<std::size_t>(holds.width()))
    throw std::invalid_argument(std::string(name) + " must have the shape (height, width)");
}

}  // namespace

void bind_lanes(nb::module_& m) {
  nb::class_<CellStay>(m, "CellStay", "One cell of a timed route; times in ticks.")
      .def(
          "__init__",
          [](CellStay* self, int cell, Ticks arrive, Ticks depart, Ticks turn_begin,
             Ticks turn_end) { new (self) CellStay{cell, arrive, depart, turn_begin, turn_end}; },
          "cell"_a, "arrive"_a, "depart"_a, "turn_begin"_a = 0, "turn_end"_a = 0)
      .def_ro("cell", &CellStay::cell, "y times width plus x.")
      .def_ro("arrive", &CellStay::arrive)
      .def_ro("depart", &CellStay::depart, "`NEVER` of the last one.")
      .def_ro("turn_begin", &CellStay::turn_begin)
      .def_ro("turn_end", &CellStay::turn_end);
  nb::class_<Clash>(m, "Clash", "Two robots that hold a cell at once, or turn side by side.")
      .def_ro("cell", &Clash::cell)
      .def_ro("index", &Clash::index, "Of the cell in the route asked about.")
      .def_ro("other", &Clash::other, "The robot in the way.")
      .def_ro("other_index", &Clash::other_index, "Of the cell in its route.")
      .def_ro("at", &Clash::at, "Tick at which both begin to hold it.");
  nb::class_<CellHolds>(m, "CellHolds", "Who holds which cell of a lane grid when.")
      .def(nb::init<int, int, int, Ticks, bool>(), "width"_a, "height"_a, "num_robots"_a, "step"_a,
           "wide"_a = false)
      .def("put", &CellHolds::put, "robot"_a, "route"_a,
           "Replace what a robot holds by a timed route.")
      .def("remove", &CellHolds::remove, "robot"_a)
      .def("route", &CellHolds::route, "robot"_a, nb::rv_policy::copy)
      .def("clashes", &CellHolds::clashes, "robot"_a, "route"_a, "granted"_a = 0,
           "Conflicts of a timed route with what all others hold, by their moments. Nobody goes "
           "before another into a cell that this one begins to hold before `granted`.")
      .def("least_delay", &CellHolds::least_delay, "robot"_a, "route"_a, "index"_a, "other"_a,
           "granted"_a = 0,
           "Ticks by which a robot must go on later from a cell of its route so that it meets "
           "nothing of another's from there on; -1: it cannot by waiting there.")
      .def(
          "holders",
          [](const CellHolds& self, int cell, Ticks since) {
            if (cell < 0 || cell >= self.width() * self.height())
              throw std::invalid_argument("there is no such cell");
            return self.holders(cell, since);
          },
          "cell"_a, "since"_a, "Robots that hold a cell after a tick.");
  m.def(
      "delayed",
      [](const std::vector<CellStay>& route, std::size_t index, Ticks by) {
        return delayed(route, index, by);
      },
      "route"_a, "index"_a, "by"_a,
      "A route whose robot goes on from the middle of a cell later, and turns there later.");
  nb::class_<LaneWay>(m, "LaneWay", "What a search over a lane grid found.")
      .def_ro("found", &LaneWay::found)
      .def_ro("stays", &LaneWay::stays, nb::rv_policy::copy)
      .def_ro("behind", &LaneWay::behind, nb::rv_policy::copy,
              "Per stay: the robot waited for there before it departs; -1: nobody.")
      .def_ro("ready", &LaneWay::ready, "Tick at which it has turned to its last heading.")
      .def_ro("expansions", &LaneWay::expansions);
  nb::class_<LaneSearch>(m, "LaneSearch", "Earliest way over a lane grid past what others hold.")
      .def(
          "__init__",
          [](LaneSearch* self, const CellHolds& holds, const Bytes& may_wait, Ticks turn) {
            check(may_wait, holds, "may_wait");
            new (self)
                LaneSearch(&holds, {may_wait.data(), may_wait.data() + may_wait.size()}, turn);
          },
          "holds"_a, "may_wait"_a, "turn"_a, nb::keep_alive<1, 2>())
      .def(
          "__call__",
          [](LaneSearch& self, const Bytes& moves, int robot, int start, int goal, Ticks now,
             Ticks granted, std::array<Ticks, 4> first_turn, std::array<Ticks, 4> last_turn,
             std::int64_t limit) {
            check(moves, self.holds(), "moves");
            const int cells = self.holds().width() * self.holds().height();
            if (std::min(start, goal) < 0 || std::max(start, goal) >= cells)
              throw std::invalid_argument("start and goal must be cells of the grid");
            return self(moves.data(), {robot, start, goal, now, granted, first_turn, last_turn},
                        limit);
          },
          "moves"_a, "robot"_a, "start"_a, "goal"_a, "now"_a, "granted"_a, "first_turn"_a,
          "last_turn"_a, "limit"_a,
          "`moves` holds bits of the legal directions out of each cell; the earliest arrival "
          "wins.");
}

}  // namespace clearway::bindings
