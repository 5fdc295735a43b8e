#include <doctest/doctest.h>

#include "teams.hpp"

using namespace clearway;
using namespace scenes;
using Status = TeamResult::Status;

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
