#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "bind.hpp"
#include "clearway/assign/costs.hpp"
#include "clearway/assign/exact.hpp"
#include "clearway/assign/memetic.hpp"
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

// Searches begin at legal routes only.
void require_routes(const Costs& costs, int seats, const Routes& routes) {
  std::vector<bool> seen(static_cast<std::size_t>(costs.tasks()));
  std::size_t number = 0;
  bool legal = routes.size() == static_cast<std::size_t>(costs.robots());
  for (std::size_t k = 0; legal && k < routes.size(); ++k) {
    legal = routes[k].size() <= static_cast<std::size_t>(std::max(seats, 0));
    for (const int task : routes[k]) {
      legal = legal && task >= 0 && task < costs.tasks() && !seen[static_cast<std::size_t>(task)] &&
              costs.allowed(static_cast<int>(k), task);
      if (!legal) break;
      seen[static_cast<std::size_t>(task)] = true;
      ++number;
    }
  }
  if (!legal || number != seen.size()) {
    throw std::invalid_argument("start must hold each task once, with robots that may do it");
  }
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
      .def_prop_ro("is_timed", &Costs::timed)
      .def(
          "values",
          [](const Costs& costs, const Array<std::int32_t>& orders,
             const Array<std::int32_t>& cuts) {
            std::vector<double> values;
            {
              nb::gil_scoped_release release;
              values =
                  assign::values(costs, {orders.data(), orders.size()}, {cuts.data(), cuts.size()});
            }
            return values;
          },
          "orders"_a, "cuts"_a,
          "Values of orders of tasks, cut into one route per robot; infinite where not legal.");
  using Ruin = RuinRecreateParams;
  nb::class_<Ruin>(m, "RuinRecreateParams", "Effort and shape of ruin and recreate.")
      .def(
          "__init__",
          [](Ruin* self, std::optional<std::int64_t> rounds, int removed, int longest_string,
             double blinks, double regret, double first_temperature, double last_temperature) {
            const Ruin params{rounds, removed,           longest_string,  blinks,
                              regret, first_temperature, last_temperature};
            params.check();
            new (self) Ruin(params);
          },
          "rounds"_a.none() = nb::none(), "removed"_a = 10, "longest_string"_a = 10,
          "blinks"_a = 0.02, "regret"_a = 0.02, "first_temperature"_a = 1.0,
          "last_temperature"_a = 0.01)
      .def_ro("rounds", &Ruin::rounds,
              "Times that tasks are taken out and put back; more find better routes. None: by the "
              "number of tasks, for about 2 s of a core at the most.")
      .def_ro("removed", &Ruin::removed, "Tasks taken out in a round, on average.")
      .def_ro("longest_string", &Ruin::longest_string, "Tasks out of one route in a row, at most.")
      .def_ro("blinks", &Ruin::blinks, "Share of the places overlooked; more is more varied.")
      .def_ro("regret", &Ruin::regret,
              "Share of the rounds that put back first what would lose most by its second-best "
              "robot.")
      .def_ro("first_temperature", &Ruin::first_temperature,
              "By how much a round may end worse at first, in mean prices of a leg.")
      .def_ro("last_temperature", &Ruin::last_temperature, "The same at the end.");
  m.def(
      "ruin_recreate",
      [](const Costs& costs, const Routes& start, int seats, const Ruin& params,
         std::uint64_t seed) {
        require_routes(costs, seats, start);
        return interruptible([&](Budget& budget) {
          return RuinRecreate(costs, seats, params)(start, seed, budget).routes;
        });
      },
      "costs"_a, "start"_a, "seats"_a, "params"_a, "seed"_a,
      "Better routes than those to start from, with at most so many seats per robot.");
  nb::class_<ExactResult>(m, "ExactResult", "What exact assignment came to.")
      .def_ro("routes", &ExactResult::routes)
      .def_ro("proven", &ExactResult::proven)
      .def_ro("pooled", &ExactResult::pooled)
      .def_ro("branchings", &ExactResult::branchings);
  m.def(
      "solve_exactly",
      [](const Costs& costs, int seats, const Routes& start) {
        require_routes(costs, seats, start);
        if (costs.tasks() > RoutePool::kMostTasks || costs.timed()) {
          throw std::invalid_argument("at most 16 tasks, none of them timed");
        }
        return interruptible(
            [&](Budget& budget) { return solve_exactly(costs, seats, start, budget); });
      },
      "costs"_a, "seats"_a, "start"_a,
      "The best routes of an untimed problem of at most 16 tasks, and proof that they are.");
  nb::class_<MemeticParams>(m, "MemeticParams", "Effort and shape of the memetic swarm.")
      .def(
          "__init__",
          [](MemeticParams* self, int particles, int iterations, double mutation, double c_max,
             double c_min, double w_max, double w_min, double gamma) {
            const MemeticParams params{particles, iterations, mutation, c_max,
                                       c_min,     w_max,      w_min,    gamma};
            params.check();
            new (self) MemeticParams(params);
          },
          "particles"_a = 30, "iterations"_a = 5, "mutation"_a = 0.1, "c_max"_a = 2.5,
          "c_min"_a = 0.5, "w_max"_a = 1.0, "w_min"_a = 0.0, "gamma"_a = 0.2)
      .def_ro("particles", &MemeticParams::particles, "More find better routes.")
      .def_ro("iterations", &MemeticParams::iterations, "Times that all are mixed and descend.")
      .def_ro("mutation", &MemeticParams::mutation,
              "Chance that two coordinates of a child change places.")
      .def_ro("c_max", &MemeticParams::c_max,
              "Pull of a particle's own best at first and of the best of all at last.")
      .def_ro("c_min", &MemeticParams::c_min, "The same the other way round.")
      .def_ro("w_max", &MemeticParams::w_max, "Pull towards staying as it is, at first.")
      .def_ro("w_min", &MemeticParams::w_min, "The same at last.")
      .def_ro("gamma", &MemeticParams::gamma,
              "Adds to that, times the ratio of the best value to the mean one.");
  nb::class_<MemeticResult>(m, "MemeticResult", "What a memetic swarm came to.")
      .def_ro("routes", &MemeticResult::routes)
      .def_ro("evaluations", &MemeticResult::evaluations);
  m.def(
      "swarm_memetically",
      [](const Costs& costs, int seats, const Routes& start, const MemeticParams& params,
         std::uint64_t seed) {
        require_routes(costs, seats, start);
        return interruptible([&](Budget& budget) {
          return swarm_memetically(costs, seats, start, params, seed, budget);
        });
      },
      "costs"_a, "seats"_a, "start"_a, "params"_a, "seed"_a,
      "The best even split that a swarm finds.");
}

}  // namespace clearway::bindings
