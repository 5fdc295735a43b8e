#include "clearway/multi/conflict_search.hpp"

#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <optional>

#include "bind.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

using Clock = std::chrono::steady_clock;
using ProgressCall = std::function<void(int, std::int64_t, double, double)>;

struct ConflictAnswer {
  ConflictResult result;
  bool interrupted = false;
};

ConflictAnswer answer_of(const std::vector<Model>& models, std::vector<Agent> agents,
                         const ConflictParams& params, std::int64_t expansions,
                         std::optional<double> seconds, std::optional<ProgressCall> progress) {
  ConflictAnswer answer;
  const Clock::time_point begin = Clock::now();
  Budget budget;
  budget.expansions = expansions;
  budget.timed = seconds.has_value();
  budget.stop = [&] {
    if (seconds && std::chrono::duration<double>(Clock::now() - begin).count() > *seconds) {
      return true;
    }
    if (answer.interrupted) return true;
    nb::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() == 0) return false;
    PyErr_Clear();
    answer.interrupted = true;
    return true;
  };
  Clock::time_point told = begin;
  ConflictProgress tell;
  if (progress) {
    tell = [&](int conflicts, std::int64_t spent, double cost, double bound) {
      if (Clock::now() - told < std::chrono::milliseconds(200)) return;
      told = Clock::now();
      nb::gil_scoped_acquire gil;
      try {
        (*progress)(conflicts, spent, cost, bound);
      } catch (nb::python_error& error) {
        if (!error.matches(PyExc_KeyboardInterrupt)) throw;
        answer.interrupted = true;
      }
    };
  }
  nb::gil_scoped_release release;
  ConflictSearch search(models, std::move(agents), params, tell);
  answer.result = search(budget);
  return answer;
}

}  // namespace

void bind_conflict_search(nb::module_& m) {
  nb::enum_<Heuristic>(m, "Heuristic", "How a search over a lattice estimates what is left.")
      .value("LOOK_BACK", Heuristic::kLookBack)
      .value("BOUND", Heuristic::kBound)
      .value("PAPER", Heuristic::kPaper);
  nb::enum_<ConflictParams::Mode>(m, "ConflictMode", "What conflict-based search aims at.")
      .value("OPTIMAL", ConflictParams::Mode::kOptimal)
      .value("BOUNDED", ConflictParams::Mode::kBounded)
      .value("GREEDY", ConflictParams::Mode::kGreedy);
  nb::class_<LatticeParams>(m, "LatticeParams", "What makes a robot's finite graph.")
      .def(nb::init<>())
      .def_rw("slot", &LatticeParams::slot)
      .def_rw("shot_words", &LatticeParams::shot_words)
      .def_rw("shot_reach", &LatticeParams::shot_reach)
      .def_rw("most_nodes", &LatticeParams::most_nodes);
  nb::class_<ConflictParams>(m, "ConflictParams", "Choices of conflict-based search.")
      .def(nb::init<>())
      .def_rw("mode", &ConflictParams::mode)
      .def_rw("objective", &ConflictParams::objective)
      .def_rw("lattice", &ConflictParams::lattice)
      .def_rw("heuristic", &ConflictParams::heuristic)
      .def_rw("factor", &ConflictParams::factor)
      .def_rw("xi", &ConflictParams::xi)
      .def_rw("adaptive", &ConflictParams::adaptive)
      .def_rw("meeting", &ConflictParams::meeting)
      .def_rw("attempts", &ConflictParams::attempts)
      .def_rw("first_limit", &ConflictParams::first_limit)
      .def_rw("most_nodes", &ConflictParams::most_nodes)
      .def_rw("margin", &ConflictParams::margin);
  nb::enum_<ConflictResult::Status>(m, "ConflictStatus", "How conflict-based search ended.")
      .value("SOLVED", ConflictResult::Status::kSolved)
      .value("STOPPED", ConflictResult::Status::kStopped)
      .value("NONE", ConflictResult::Status::kNone);
  nb::class_<ConflictAnswer>(m, "ConflictAnswer", "What conflict-based search came to.")
      .def_prop_ro("status", [](const ConflictAnswer& a) { return a.result.status; })
      .def_prop_ro("tours", [](const ConflictAnswer& a) { return a.result.tours; })
      .def_prop_ro("concerned", [](const ConflictAnswer& a) { return a.result.concerned; })
      .def_prop_ro("cost", [](const ConflictAnswer& a) { return a.result.cost; })
      .def_prop_ro("proven", [](const ConflictAnswer& a) { return a.result.proven; })
      .def_prop_ro("largest_group", [](const ConflictAnswer& a) { return a.result.largest_group; })
      .def_prop_ro("bound", [](const ConflictAnswer& a) { return a.result.bound; })
      .def_prop_ro("expansions", [](const ConflictAnswer& a) { return a.result.expansions; })
      .def_prop_ro("nodes", [](const ConflictAnswer& a) { return a.result.nodes; })
      .def_prop_ro("searches", [](const ConflictAnswer& a) { return a.result.searches; })
      .def_prop_ro("too_large", [](const ConflictAnswer& a) { return a.result.too_large; })
      .def_ro("interrupted", &ConflictAnswer::interrupted);
  m.def("search_conflicts", &answer_of, "models"_a, "agents"_a, "params"_a, "expansions"_a = -1,
        "seconds"_a.none() = nb::none(), "progress"_a.none() = nb::none(),
        "Plan a team by conflict-based search on bodies.");
}

}  // namespace clearway::bindings
