#include "clearway/multi/neighbourhoods.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;
using Status = TeamResult::Status;

namespace {

struct Setting {
  std::vector<Model> models;
  std::vector<Agent> agents;
  TeamParams params;
  std::uint32_t seed = 1;
  Budget budget;

  Setting() {
    params.restarts = 20;
    params.alone_limit = 20000;
    budget.expansions = 300000;
  }
  void add(const Pose& start, std::vector<Leg> legs) {
    Agent agent;
    agent.start = start;
    agent.legs = std::move(legs);
    agents.push_back(std::move(agent));
  }
  TeamResult run() {
    budget.spent = 0;
    budget.ended = false;
    Team planned(models, agents, params.search, params.objective, params.margin);
    return PrioritisedPlanner(planned, params, {})(seed, budget);
  }
};

Setting team(const Obstacles& o, double clearance = 0.0) {
  Setting t;
  t.models.push_back(rover(rectangle(1.0, 0.6), o, clearance));
  return t;
}

Leg to(const Pose& goal, Ticks service = 0, int body = 0) { return {goal, service, body, 0.0}; }

Track track_of(const Setting& t, const TeamResult& result, std::size_t i) {
  std::vector<TimedPiece> pieces = t.agents[i].committed;
  const auto& tour = result.tours[i].pieces;
  if (result.planned[i]) pieces.insert(pieces.end(), tour.begin(), tour.end());
  const auto model = static_cast<std::size_t>(t.agents[i].model);
  return Track(&t.models[model].bodies, t.agents[i].start, pieces);
}

// Dense sampling with true bodies: nobody overlaps anybody, planned or standing, by over 1 mm.
void check_apart(const Setting& t, const TeamResult& result) {
  for (std::size_t i = 0; i < t.agents.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Track a = track_of(t, result, i), b = track_of(t, result, j);
      const Ticks last = std::max(a.settled(), b.settled()) + 100;
      INFO("robots ", i, " and ", j);
      CHECK(least_gap(a, b, last, 5) >= -0.001);
    }
  }
}

void check_visits(const Setting& t, const TeamResult& result) {
  for (std::size_t i = 0; i < t.agents.size(); ++i) {
    if (!result.planned[i] || t.agents[i].legs.empty() || t.agents[i].fixed) continue;
    REQUIRE(result.tours[i].stops.size() == t.agents[i].legs.size());
    const Track track = track_of(t, result, i);
    for (std::size_t k = 0; k < t.agents[i].legs.size(); ++k) {
      const Leg& leg = t.agents[i].legs[k];
      const TourStop& stop = result.tours[i].stops[k];
      CHECK(stop.leave - stop.arrive == leg.service);
      for (Ticks tick = stop.arrive; tick <= stop.leave; tick += 100) {
        const Frame f = track.at(tick).frame;
        CHECK(std::abs(f.x - leg.goal.x) < 1e-4);
        CHECK(std::abs(f.y - leg.goal.y) < 1e-4);
        CHECK(std::abs(f.c - std::cos(leg.goal.theta)) < 1e-4);
        CHECK(std::abs(f.s - std::sin(leg.goal.theta)) < 1e-4);
      }
    }
  }
}

void check_solved(const Setting& t, const TeamResult& result) {
  CHECK(result.status == Status::kSolved);
  CHECK(result.concerned.empty());
  CHECK(std::count(result.planned.begin(), result.planned.end(), true) ==
        static_cast<std::ptrdiff_t>(t.agents.size()));
  check_visits(t, result);
  check_apart(t, result);
}

bool same(const TeamResult& a, const TeamResult& b) {
  if (a.status != b.status || a.planned != b.planned || a.expansions != b.expansions) return false;
  for (std::size_t i = 0; i < a.tours.size(); ++i) {
    const auto &p = a.tours[i].pieces, &q = b.tours[i].pieces;
    if (p.size() != q.size()) return false;
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (p[k].begin != q[k].begin || p[k].end != q[k].end || p[k].start.x != q[k].start.x ||
          p[k].start.y != q[k].start.y || p[k].twist.c != q[k].twist.c) {
        return false;
      }
    }
  }
  return true;
}

// A lane of 1.3 m along x with a siding of 3 m by 2 m that is nearer to its left end.
Obstacles lane_with_siding() {
  return hall(
      {{0, 0}, {20, 0}, {20, 1.3}, {8.5, 1.3}, {8.5, 3.3}, {5.5, 3.3}, {5.5, 1.3}, {0, 1.3}});
}

}  // namespace

TEST_CASE("Robots far apart drive as if alone") {
  Setting t = team(hall(20, 12));
  t.add({2, 3, 0}, {to({12, 3, 0})});
  t.add({2, 9, 0}, {to({15, 9, 0}, 1000)});
  const TeamResult result = t.run();
  check_solved(t, result);
  CHECK(result.tours[0].arrival == 10000);
  CHECK(result.tours[1].arrival == 13000);
  CHECK(result.rip_ups == 0);
  CHECK(result.restarts == 0);
}

TEST_CASE("Two robots swap ends of a lane by its siding") {
  Setting t = team(lane_with_siding());
  t.add({2, 0.65, 0}, {to({18, 0.65, 0})});
  t.add({18, 0.65, kPi}, {to({2, 0.65, kPi})});
  check_solved(t, t.run());
}

TEST_CASE("Without the siding they cannot, and what is kept of the plan is still clear") {
  Setting t = team(hall(20, 1.3));
  t.add({2, 0.65, 0}, {to({18, 0.65, 0})});
  t.add({18, 0.65, kPi}, {to({2, 0.65, kPi})});
  t.params.restarts = 4;
  const TeamResult result = t.run();
  CHECK(result.status == Status::kStopped);
  CHECK(!result.concerned.empty());
  for (const int i : result.concerned) CHECK(!result.planned[static_cast<std::size_t>(i)]);
  check_visits(t, result);
  check_apart(t, result);
}

TEST_CASE("Bound for where another starts, a robot waits until that one has left") {
  Setting t = team(hall(20, 1.3));
  t.add({8, 0.65, 0}, {to({18, 0.65, 0})});
  t.add({2, 0.65, 0}, {to({8, 0.65, 0})});
  const TeamResult result = t.run();
  check_solved(t, result);
  CHECK(result.tours[0].arrival == 10000);
  CHECK(result.tours[1].arrival < 8000);
}

TEST_CASE("A robot that nobody lets out is stuck alone, and that is said of him alone") {
  Obstacles o = hall(20, 12);
  o.segments.push_back({{10, 0}, {10, 12}});
  Setting t;
  t.models.push_back(rover(rectangle(1.6, 1.6), o));
  t.add({4, 3, 0}, {to({4, 9, 0})});
  t.add({4, 6, 0}, {to({16, 6, 0})});
  t.add({16, 3, 0}, {to({16, 9, 0})});
  const TeamResult result = t.run();
  CHECK(result.status == Status::kStuck);
  CHECK(result.concerned == std::vector<int>{1});
  check_apart(t, result);
}

TEST_CASE("When effort runs out the best plan so far is kept and says whom it lacks") {
  Setting t = team(hall(12, 12));
  for (int i = 0; i < 5; ++i) {
    const double y = 1.5 + 2.0 * i;
    t.add({1.5, y, 0}, {to({10.5, 9.5 - 2.0 * i, 0}), to({1.5, y, 0})});
  }
  t.budget.expansions = -1;
  const TeamResult whole = t.run();
  REQUIRE(whole.status == Status::kSolved);
  std::size_t fewest = t.agents.size();
  for (const std::int64_t effort : {whole.expansions / 2, whole.expansions / 4, std::int64_t{1}}) {
    t.budget.expansions = effort;
    const TeamResult result = t.run();
    CHECK(result.status == Status::kStopped);
    CHECK(result.expansions <= effort + 1);
    const auto planned =
        static_cast<std::size_t>(std::count(result.planned.begin(), result.planned.end(), true));
    CHECK(planned <= fewest);
    CHECK(planned + result.concerned.size() == t.agents.size());
    fewest = planned;
    check_visits(t, result);
    check_apart(t, result);
  }
}

TEST_CASE("Asked to stop, it stops") {
  Setting t = team(hall(20, 1.3));
  t.add({2, 0.65, 0}, {to({18, 0.65, 0})});
  t.add({18, 0.65, kPi}, {to({2, 0.65, kPi})});
  t.budget.expansions = -1;
  t.budget.stop = [] { return true; };
  const TeamResult result = t.run();
  CHECK(result.status == Status::kStopped);
  CHECK(result.expansions <= 512);
}

TEST_CASE("The same seed gives the same plan to the tick") {
  Setting t = team(lane_with_siding());
  t.add({2, 0.65, 0}, {to({18, 0.65, 0}), to({10, 0.65, 0})});
  t.add({18, 0.65, kPi}, {to({2, 0.65, kPi})});
  for (const std::uint32_t seed : {1U, 7U}) {
    t.seed = seed;
    CHECK(same(t.run(), t.run()));
  }
}

TEST_CASE("A robot without visits and one that is fixed are avoided, not moved") {
  Setting t = team(hall(20, 12));
  t.add({2, 6, 0}, {to({17, 6, 0})});
  t.add({8, 6, 1.0}, {});
  t.add({12, 1, kPi / 2}, {});
  t.agents[2].fixed = true;
  t.agents[2].committed = {wait(0, 5000, {12, 1, kPi / 2}),
                           drive(5000, 15000, {12, 1, kPi / 2}, {10, 0, 0})};
  const TeamResult result = t.run();
  check_solved(t, result);
  CHECK(result.tours[1].pieces.empty());
  CHECK(result.tours[2].pieces.empty());
  CHECK(result.tours[0].arrival > 15000);  // not straight through
}

TEST_CASE("A fixed robot that runs over one without a way says until when the plan holds") {
  Obstacles o = hall(20, 12);
  o.segments.push_back({{15, 0}, {15, 12}});
  Setting t;
  t.models.push_back(rover(rectangle(1.6, 1.6), o));
  t.add({8, 6, 0}, {to({18, 6, 0})});  // behind a wall
  t.add({2, 6, 0}, {});
  t.agents[1].fixed = true;
  t.agents[1].committed = {drive(0, 8000, {2, 6, 0}, {8, 0, 0})};
  const TeamResult result = t.run();
  CHECK(result.status == Status::kStuck);
  // From x = 2 at 1 m/s the noses meet at x = 8 - 1.6: at 4.4 s, less the margin of 1 cm.
  CHECK(result.conflict_free_until <= 4400);
  CHECK(result.conflict_free_until >= 4350);
}

TEST_CASE("A robot goes on from where its commitment leaves it") {
  Setting t = team(hall(20, 12));
  t.add({2, 6, 0}, {to({12, 6, 0})});
  t.agents[0].committed = {drive(0, 3000, {2, 6, 0}, {3, 0, 0})};
  t.agents[0].ready = 3000;
  t.add({4, 2, kPi / 2}, {to({17, 10, 0})});
  const TeamResult result = t.run();
  check_solved(t, result);
  CHECK(result.tours[0].arrival == 10000);
}

TEST_CASE("Starts that touch may part, and visits that touch may be made") {
  Setting t = team(hall(20, 12));
  t.add({2, 6, 0}, {to({12, 6, 0})});
  t.add({2, 6.6, 0}, {to({12, 6.6, 0})});  // side by side, no gap, at both ends
  check_solved(t, t.run());
}

TEST_CASE("Clearance is kept where the poses of the scenario leave it") {
  Setting t = team(hall(20, 12), 0.25);
  t.add({2, 6, 0}, {to({17, 6, 0})});
  t.add({10, 1.5, kPi / 2}, {to({10, 10.5, kPi / 2})});
  const TeamResult result = t.run();
  check_solved(t, result);
  const Track a = track_of(t, result, 0), b = track_of(t, result, 1);
  // Up to half the slack of 5 cm may be lost between two tests.
  CHECK(least_gap(a, b, 40000, 5) >= 0.25 - 0.025 - 1e-3);
}

TEST_CASE("Crowds in open halls and between shelves never overlap") {
  Dice dice(111);
  int solved = 0;
  for (int round = 0; round < 4; ++round) {
    Obstacles o = hall(14, 14);
    if (round % 2) {
      add_solid(o, box_points(4, 4, 6, 10));
      add_solid(o, box_points(9, 4, 11, 10));
    }
    Setting t = team(o);
    t.models.push_back(model_of(rectangle(1.4, 0.8), o, car_table(16), car_table(32)));
    t.budget.expansions = 60000;
    std::vector<Pose> starts, goals;
    const auto pick = [&](std::vector<Pose>& taken) {
      while (true) {
        const Pose p{dice.between(1.2, 12.8), dice.between(1.2, 12.8), dice.between(-kPi, kPi)};
        bool free = t.models[0].statics[0]->clearance(p.x, p.y) > 1.0;
        for (const Pose& q : taken) free = free && std::hypot(p.x - q.x, p.y - q.y) > 1.9;
        if (!free) continue;
        taken.push_back(p);
        return p;
      }
    };
    for (int i = 0; i < 7; ++i) {
      t.add(pick(starts), {});
      t.agents.back().model = i % 2;
      t.agents.back().legs = {to(pick(goals), 1000 * (i % 3))};
    }
    const TeamResult result = t.run();
    solved += result.status == Status::kSolved;
    check_visits(t, result);
    check_apart(t, result);
  }
  CHECK(solved >= 3);
}

TEST_CASE("Progress is told while planning") {
  Setting t = team(hall(20, 12));
  t.add({2, 3, 0}, {to({12, 3, 0})});
  t.add({2, 9, 0}, {to({15, 9, 0})});
  std::vector<int> told;
  t.budget.expansions = -1;
  plan_team(t.models, t.agents, t.params, 1, t.budget,
            [&](int planned, int total, std::int64_t, std::int64_t cost) {
              told.push_back(planned);
              CHECK(total == 2);
              CHECK((cost > 0) == (told.size() == 3));
            });
  CHECK(told == std::vector<int>{1, 2, 2});
}
