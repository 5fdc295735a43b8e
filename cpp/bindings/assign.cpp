#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "bind.hpp"
#include "clearway/assign/costs.hpp"
#include "clearway/assign/exact.hpp"
#include "clearway/assign/ruin_recreate.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

using namespace clearway::assign;
template <class T>
using Array = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;

template <class T>
std::vector<T> copied(const Array<T>& array) {
  return {array.data(), array.data() + array.size()};
}

Costs costs_of(const std::vector<int>& kind, const Array<double>& start,
               const Array<double>& start_turn, const Array<double>& between,
               const Array<double>& turn, const Array<double>& inner,
               const Array<std::uint8_t>& allowed, const std::array<double, 4>& weights,
               double speed, const Array<double>& service, const Array<double>& due,
               std::vector<std::pair<int, int>> before) {
  if (between.ndim() != 3) throw std::invalid_argument("between must have three dimensions");
  Tables tables;
  tables.robots = static_cast<int>(kind.size());
  tables.kinds = static_cast<int>(between.shape(0));
  tables.tasks = static_cast<int>(between.shape(1));
  tables.kind = kind;
  tables.start = copied(start);
  tables.start_turn = copied(start_turn);
  tables.between = copied(between);
  tables.turn = copied(turn);
  tables.inner = copied(inner);
  tables.allowed = copied(allowed);
  tables.weights = {weights[0], weights[1], weights[2], weights[3]};
  tables.speed = speed;
  tables.service = copied(service);
  tables.due = copied(due);
  for (const auto& [first, second] : before) {
    if (std::min(first, second) < 0 || std::max(first, second) >= tables.tasks) {
      throw std::invalid_argument("before names a task that does not exist");
    }
  }
  tables.before = std::move(before);
  return Costs(tables);
}

// Runs without the interpreter's lock; Ctrl-C ends it as KeyboardInterrupt.
template <class Call>
auto interruptible(const Call& call) {
  bool interrupted = false;
  Budget budget;
  budget.stop = [&interrupted] {
    nb::gil_scoped_acquire gil;
    return interrupted = interrupted || PyErr_CheckSignals() != 0;
  };
  const auto answer = [&] {
    nb::gil_scoped_release release;
    return call(budget);
  }();
  if (interrupted) throw nb::python_error();
  return answer;
}

}  // namespace

void bind_assign(nb::module_& m) {
  nb::class_<Costs>(m, "AssignmentCosts", "What it costs robots to go from task to task.")
      .def(
          "__init__",
          [](Costs* self, const std::vector<int>& kind, const Array<double>& start,
             const Array<double>& start_turn, const Array<double>& between,
             const Array<double>& turn, const Array<double>& inner,
             const Array<std::uint8_t>& allowed, const std::array<double, 4>& weights, double speed,
             const Array<double>& service, const Array<double>& due,
             std::vector<std::pair<int, int>> before) {
            new (self) Costs(costs_of(kind, start, start_turn, between, turn, inner, allowed,
                                      weights, speed, service, due, std::move(before)));
          },
          "kind"_a, "start"_a, "start_turn"_a, "between"_a, "turn"_a, "inner"_a, "allowed"_a,
          "weights"_a, "speed"_a, "service"_a, "due"_a, "before"_a)
      .def_prop_ro("num_robots", &Costs::robots)
      .def_prop_ro("num_tasks", &Costs::tasks)
      .def(
          "values",
          [](const Costs& costs, const Array<std::int32_t>& orders,
             const Array<std::int32_t>& cuts) {
            std::vector<double> values;
            {
              nb::gil_scoped_release release;
              values = assign::values(costs, {orders.data(), orders.size()},
                                      {cuts.data(), cuts.size()});
            }
            return values;
          },
          "orders"_a, "cuts"_a,
          "Values of orders of tasks, cut into one route per robot; infinite where not legal.");
  nb::class_<RuinRecreateParams>(m, "RuinRecreateParams", "Parameters of ruin and recreate.")
      .def(nb::init<>())
      .def_rw("removed", &RuinRecreateParams::removed)
      .def_rw("longest_string", &RuinRecreateParams::longest_string)
      .def_rw("blinks", &RuinRecreateParams::blinks)
      .def_rw("regret", &RuinRecreateParams::regret)
      .def_rw("first_temperature", &RuinRecreateParams::first_temperature)
      .def_rw("last_temperature", &RuinRecreateParams::last_temperature);
  m.def(
      "ruin_recreate",
      [](const Costs& costs, const Routes& start, int seats, const RuinRecreateParams& params,
         std::int64_t rounds, std::uint64_t seed) {
        return interruptible([&](Budget& budget) {
          return RuinRecreate(costs, seats, params)(start, rounds, seed, budget).routes;
        });
      },
      "costs"_a, "start"_a, "seats"_a, "params"_a, "rounds"_a, "seed"_a,
      "Better routes than those to start from, with at most so many seats per robot.");
  nb::class_<ExactResult>(m, "ExactResult", "What exact assignment came to.")
      .def_ro("routes", &ExactResult::routes)
      .def_ro("proven", &ExactResult::proven)
      .def_ro("pooled", &ExactResult::pooled)
      .def_ro("branchings", &ExactResult::branchings);
  m.def(
      "solve_exactly",
      [](const Costs& costs, int seats, const Routes& start) {
        return interruptible(
            [&](Budget& budget) { return solve_exactly(costs, seats, start, budget); });
      },
      "costs"_a, "seats"_a, "start"_a,
      "The best routes of an untimed problem of at most 16 tasks, and proof that they are.");
}

}  // namespace clearway::bindings
