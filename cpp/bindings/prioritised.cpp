#include <nanobind/stl/function.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <optional>

#include "bind.hpp"
#include "clearway/multi/neighbourhoods.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

namespace {

using Clock = std::chrono::steady_clock;
using ProgressCall = std::function<void(int, int, std::int64_t, std::optional<double>)>;

struct TeamAnswer {
  TeamResult result;
  bool interrupted = false;
};

TeamAnswer answer_of(const std::vector<Model>& models, std::vector<Agent> agents,
                     const TeamParams& params, std::uint32_t seed, std::int64_t expansions,
                     std::optional<double> seconds, std::optional<ProgressCall> progress,
                     bool improve) {
  TeamAnswer answer;
  const Clock::time_point begin = Clock::now();
  Budget budget;
  budget.expansions = expansions;
  budget.timed = seconds.has_value();
  budget.improve = improve;
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
  Progress tell;
  bool complete = false;
  if (progress) {
    tell = [&](int planned, int total, std::int64_t spent, std::int64_t cost) {
      const bool first = cost >= 0 && !complete;
      if (!first && Clock::now() - told < std::chrono::milliseconds(200)) return;
      complete = complete || first;
      told = Clock::now();
      nb::gil_scoped_acquire gil;
      try {
        (*progress)(planned, total, spent,
                    cost < 0 ? std::nullopt
                             : std::optional<double>(static_cast<double>(cost) / kTicksPerSecond));
      } catch (nb::python_error& error) {
        if (!error.matches(PyExc_KeyboardInterrupt)) throw;
        answer.interrupted = true;
      }
    };
  }
  nb::gil_scoped_release release;
  answer.result = plan_team(models, std::move(agents), params, seed, budget, tell);
  return answer;
}

// One robot's search among others whose tours are given (an empty one: not planned, ignored), with
// the states that it expands.
std::pair<TourResult, std::vector<Expanded>> trace_tour(const std::vector<Model>& models,
                                                        std::vector<Agent> agents,
                                                        const TeamParams& params,
                                                        const std::vector<TourResult>& tours,
                                                        std::size_t robot) {
  Team team(models, std::move(agents), params.search, params.objective, params.margin);
  for (std::size_t i = 0; i < team.size() && i < tours.size(); ++i) {
    if (i != robot && !tours[i].pieces.empty()) team.insert(i, team.place(i, tours[i]));
  }
  std::vector<Expanded> trace;
  TourQuery query = team.query(robot, &team.traffic());
  query.trace = &trace;
  Budget budget;
  const auto legs = static_cast<std::int64_t>(team.agent(robot).legs.size());
  TourResult tour = team.search(query, params.search_limit * legs, budget);
  return {std::move(tour), std::move(trace)};
}

}  // namespace

void bind_prioritised(nb::module_& m) {
  nb::class_<TimedPiece>(m, "TimedPiece", "A stretch of a trajectory.")
      .def(
          "__init__",
          [](TimedPiece* self, Ticks begin, Ticks end, const Pose& start, const Twist& twist,
             int mode, int body) { new (self) TimedPiece{begin, end, start, twist, mode, body}; },
          "begin"_a, "end"_a, "start"_a, "twist"_a, "mode"_a, "body"_a)
      .def_ro("begin", &TimedPiece::begin)
      .def_ro("end", &TimedPiece::end)
      .def_ro("start", &TimedPiece::start)
      .def_ro("twist", &TimedPiece::twist)
      .def_ro("mode", &TimedPiece::mode)
      .def_ro("body", &TimedPiece::body);
  nb::class_<Leg>(m, "Leg", "Drive to a goal, then stand there.")
      .def(
          "__init__",
          [](Leg* self, const Pose& goal, Ticks service, int body, Ticks not_before) {
            new (self) Leg{goal, service, body, 0.0, not_before};
          },
          "goal"_a, "service"_a, "body"_a, "not_before"_a = 0);
  nb::class_<Model>(m, "Model", "What all robots of one type share.")
      .def(
          "__init__",
          [](Model* self, std::vector<Body> bodies, std::vector<std::shared_ptr<Statics>> statics,
             MotionTable table, MotionTable fine, double clearance) {
            new (self) Model{std::move(bodies),
                             {statics.begin(), statics.end()},
                             std::move(table),
                             std::move(fine),
                             clearance};
          },
          "bodies"_a, "statics"_a, "table"_a, "fine"_a, "clearance"_a)
      .def_prop_ro("num_bodies", [](const Model& model) { return model.bodies.size(); });
  nb::class_<Agent>(m, "Agent", "A robot of the team.")
      .def(nb::init<>())
      .def_rw("model", &Agent::model)
      .def_rw("start", &Agent::start)
      .def_rw("mode", &Agent::mode)
      .def_rw("ready", &Agent::ready)
      .def_rw("committed", &Agent::committed)
      .def_rw("legs", &Agent::legs)
      .def_rw("rest_body", &Agent::rest_body)
      .def_rw("fixed", &Agent::fixed)
      .def_rw("bound", &Agent::bound);
  nb::class_<SearchParams>(m, "SearchParams", "Parameters of the single-robot search.")
      .def(nb::init<>())
      .def_rw("weight", &SearchParams::weight)
      .def_rw("greed", &SearchParams::greed)
      .def_rw("most_weight", &SearchParams::most_weight)
      .def_rw("tail_weight", &SearchParams::tail_weight)
      .def_rw("soft_weight", &SearchParams::soft_weight)
      .def_rw("cell", &SearchParams::cell)
      .def_rw("shot_words", &SearchParams::shot_words)
      .def_rw("most_nodes", &SearchParams::most_nodes)
      .def_rw("most_cells", &SearchParams::most_cells);
  nb::enum_<Aim>(m, "Aim", "What the sum over robots, or the last of them, is to be least of.")
      .value("SUM_OF_COSTS", Aim::kSumOfCosts)
      .value("MAKESPAN", Aim::kMakespan);
  nb::class_<TeamParams>(m, "TeamParams", "Parameters of prioritised planning.")
      .def(nb::init<>())
      .def_rw("search", &TeamParams::search)
      .def_rw("objective", &TeamParams::objective)
      .def_rw("aim", &TeamParams::aim)
      .def_rw("margin", &TeamParams::margin)
      .def_rw("first_penalty", &TeamParams::first_penalty)
      .def_rw("penalty_growth", &TeamParams::penalty_growth)
      .def_rw("first_hold", &TeamParams::first_hold)
      .def_rw("last_hold", &TeamParams::last_hold)
      .def_rw("jitter", &TeamParams::jitter)
      .def_rw("search_limit", &TeamParams::search_limit)
      .def_rw("alone_limit", &TeamParams::alone_limit)
      .def_rw("restarts", &TeamParams::restarts)
      .def_rw("repair_limit", &TeamParams::repair_limit)
      .def_rw("neighbourhood", &TeamParams::neighbourhood);
  nb::class_<TourStop>(m, "TourStop", "A visit made: its leg, ticks of arrival and leaving.")
      .def_ro("leg", &TourStop::leg)
      .def_ro("arrive", &TourStop::arrive)
      .def_ro("leave", &TourStop::leave);
  nb::class_<TourResult>(m, "TourResult", "One robot's way through its visits.")
      .def_ro("pieces", &TourResult::pieces)
      .def_ro("stops", &TourResult::stops);
  nb::enum_<TeamResult::Status>(m, "TeamStatus", "How prioritised planning ended.")
      .value("SOLVED", TeamResult::Status::kSolved)
      .value("STOPPED", TeamResult::Status::kStopped)
      .value("STUCK", TeamResult::Status::kStuck);
  nb::class_<TeamAnswer>(m, "TeamAnswer", "What planning a team came to.")
      .def_prop_ro("status", [](const TeamAnswer& a) { return a.result.status; })
      .def_prop_ro("tours", [](const TeamAnswer& a) { return a.result.tours; })
      .def_prop_ro("planned", [](const TeamAnswer& a) { return a.result.planned; })
      .def_prop_ro("concerned", [](const TeamAnswer& a) { return a.result.concerned; })
      .def_prop_ro("conflict_free_until",
                   [](const TeamAnswer& a) { return a.result.conflict_free_until; })
      .def_prop_ro("expansions", [](const TeamAnswer& a) { return a.result.expansions; })
      .def_prop_ro("searches", [](const TeamAnswer& a) { return a.result.searches; })
      .def_prop_ro("rip_ups", [](const TeamAnswer& a) { return a.result.rip_ups; })
      .def_prop_ro("restarts", [](const TeamAnswer& a) { return a.result.restarts; })
      .def_prop_ro("full", [](const TeamAnswer& a) { return a.result.full; })
      .def_prop_ro("repairs", [](const TeamAnswer& a) { return a.result.repairs; })
      .def_prop_ro("repaired", [](const TeamAnswer& a) { return a.result.repaired; })
      .def_prop_ro("first_expansions",
                   [](const TeamAnswer& a) { return a.result.first_expansions; })
      .def_prop_ro("first_cost",
                   [](const TeamAnswer& a) {
                     return static_cast<double>(a.result.first_cost) / kTicksPerSecond;
                   })
      .def_ro("interrupted", &TeamAnswer::interrupted);
  nb::class_<Expanded>(m, "Expanded", "A state that a search expanded, with its safe interval.")
      .def_ro("pose", &Expanded::pose)
      .def_ro("begin", &Expanded::begin)
      .def_ro("end", &Expanded::end)
      .def_ro("leg", &Expanded::leg);
  m.def("trace_tour", &trace_tour, "models"_a, "agents"_a, "params"_a, "tours"_a, "robot"_a,
        "Search one robot's tour among others' and tell the states expanded, in order.");
  m.def("plan_team", &answer_of, "models"_a, "agents"_a, "params"_a, "seed"_a, "expansions"_a = -1,
        "seconds"_a.none() = nb::none(), "progress"_a.none() = nb::none(), "improve"_a = true,
        "Plan a team, then plan it better until the budget or an interrupt ends that.");
}

}  // namespace clearway::bindings
