#include "assign.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "clearway/assign/exact.hpp"
#include "clearway/assign/memetic.hpp"
#include "clearway/assign/ruin_recreate.hpp"
#include "clearway/assign/schedule.hpp"
#include "clearway/assign/spanning_bound.hpp"

using namespace clearway;
using namespace clearway::assign;
using namespace scenes;

namespace {

Routes improved(const Costs& costs, int seats, const Routes& start, std::int64_t rounds) {
  RuinRecreateParams params;
  params.rounds = rounds;
  Budget budget;
  return RuinRecreate(costs, seats, params)(start, 1, budget).routes;
}

std::size_t longest_count(const Routes& routes) {
  std::size_t count = 0;
  for (const auto& route : routes) count = std::max(count, route.size());
  return count;
}

}  // namespace

TEST_CASE("Two robots at the ends of a line meet in the middle") {
  // 0 -> 1 -> 2 and 10 -> 9 -> 8: 2 m each, so 2 + 4 = 6.
  const Costs costs(on_a_line());
  const Routes best{{0, 1}, {3, 2}};
  CHECK(costs.value(best) == doctest::Approx(6.0));
  Budget budget;
  const Routes start = dealt(2, 4);
  CHECK(solve_exactly(costs, 2, start, budget).routes == best);
  CHECK(solve_exactly(costs, 4, start, budget).routes == best);
  CHECK(improved(costs, 4, start, 100) == best);
  CHECK(swarm_memetically(costs, 2, start, {}, 1, budget).routes == best);
}

TEST_CASE("A task that comes too late counts, and one that waits comes later") {
  // At 1 m/s robot 0 is at task 0 after 1 s and at task 1 after 2 s.
  Tables t = on_a_line();
  t.due = {0.5, 5.0, 5.0, 5.0};
  t.service = {0.0, 1.0, 0.0, 0.0};
  const Routes routes{{0, 1}, {3, 2}};
  CHECK(Schedule(Costs(t)).tardiness(routes) == doctest::Approx(0.5));
  // Task 3 waits for task 1, done after 3 s; then 1 m to task 2, which is due at 3.5 s.
  t.before = {{1, 3}};
  t.due = {9.0, 9.0, 3.5, 9.0};
  CHECK(Schedule(Costs(t)).tardiness(routes) == doctest::Approx(0.5));
  CHECK(Costs(t).value(routes) == doctest::Approx(6.5));
}

TEST_CASE("Routes that wait for each other are worth nothing") {
  Tables t = on_a_line();
  t.before = {{1, 3}, {2, 0}};
  const Costs costs(t);
  CHECK(std::isinf(costs.value({{0, 1}, {3, 2}})));
  CHECK(std::isfinite(costs.value({{1, 0}, {2, 3}})));
  Schedule schedule(costs);
  schedule.tardiness({{0, 1}, {3, 2}});
  CHECK(schedule.left() == 4);
}

TEST_CASE("What must wait for a follower waits for its forerunner, too") {
  // 0 before 1 before 2: with 1 not placed yet, 2 may not go before 0 on one route.
  Tables t = on_a_line();
  t.before = {{0, 1}, {1, 2}};
  const Costs costs(t);
  CHECK(costs.followers(0) == std::vector<int>{1, 2});
  CHECK(std::isinf(Schedule(costs).tardiness({{2, 0}, {}})));
}

TEST_CASE("Spanning trees bound the sum of legs, whatever the longest route weighs") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Tables t = among_points(3, 8, seed);
    t.weights.longest = 0.0;
    const Costs costs(t);
    Budget budget;
    const double least = costs.value(solve_exactly(costs, 8, dealt(3, 8), budget).routes);
    CHECK(spanning_bound(costs) <= least + 1e-9);
    CHECK(spanning_bound(costs) >= 0.6 * least);
  }
}

TEST_CASE("No search finds anything below the proven optimum, and each splits evenly if told") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Tables t = among_points(4, 11, seed);
    t.allowed[0] = t.allowed[13] = 0;
    const Costs costs(t);
    for (const int seats : {3, 11}) {
      Budget budget;
      Routes start = improved(costs, seats, {{1, 2, 3}, {4, 5, 6}, {0, 7, 8}, {9, 10}}, 300);
      const ExactResult best = solve_exactly(costs, seats, start, budget);
      CHECK(best.proven);
      CHECK(costs.value(best.routes) <= costs.value(start) + 1e-9);
      CHECK(longest_count(best.routes) <= static_cast<std::size_t>(seats));
      if (seats == 3) {
        const MemeticResult swarm = swarm_memetically(costs, seats, start, {}, seed, budget);
        CHECK(costs.value(swarm.routes) >= costs.value(best.routes) - 1e-9);
        CHECK(longest_count(swarm.routes) <= 3);
      }
    }
  }
}

TEST_CASE("Ruin and recreate keeps a mixed, timed problem legal") {
  Tables t = among_points(3, 12, 5);
  t.before = {{0, 5}, {5, 7}, {8, 1}, {2, 11}};
  t.due.assign(12, 25.0);
  t.allowed[3] = t.allowed[12 + 4] = 0;
  const Costs costs(t);
  const Routes start{{0, 5, 7, 8}, {1, 2, 3, 11}, {4, 6, 9, 10}};
  for (const int seats : {4, 12}) {
    const Routes routes = improved(costs, seats, start, 300);
    CHECK(costs.value(routes) < costs.value(start));
    CHECK(longest_count(routes) <= static_cast<std::size_t>(seats));
  }
}

TEST_CASE("Effort ends where the budget says stop") {
  const Costs costs(among_points(4, 16, 3));
  Budget none;
  none.expansions = 0;
  CHECK_FALSE(solve_exactly(costs, 16, dealt(4, 16), none).proven);
  none = {};
  none.expansions = 0;
  const MemeticResult swarm = swarm_memetically(costs, 4, dealt(4, 16), {}, 1, none);
  CHECK(longest_count(swarm.routes) == 4);
  CHECK(swarm.evaluations < 500);  // a whole descent prices thousands
}

TEST_CASE("A doubled number keeps one of its places, each as often as the other") {
  // Spec A-24: 5 twice, 0 missing.
  Random random(1);
  int first = 0;
  for (int i = 0; i < 1000; ++i) {
    Permutation p{5, 4, 2, 3, 1, 5};
    repair(p, random);
    if (p == Permutation{0, 4, 2, 3, 1, 5}) {
      ++first;
    } else {
      CHECK(p == Permutation{5, 4, 2, 3, 1, 0});
    }
  }
  CHECK(first > 430);
  CHECK(first < 570);
}

TEST_CASE("Random numbers are the same everywhere and fill their range evenly") {
  Random random(42), again(42);
  std::vector<int> drawn(10, 0);
  for (int i = 0; i < 10000; ++i) {
    const int number = random.below(10);
    CHECK(number == again.below(10));
    ++drawn[static_cast<std::size_t>(number)];
  }
  for (const int times : drawn) {
    CHECK(times > 880);
    CHECK(times < 1120);
  }
}
