#include "clearway/multi/neighbourhoods.hpp"

#include <doctest/doctest.h>

#include <utility>

#include "teams.hpp"

using namespace clearway;
using namespace scenes;

namespace {

TeamResult planned(Setting& t, std::int64_t expansions) {
  t.budget = {};
  t.budget.expansions = expansions;
  return plan_team(t.models, t.agents, t.params, t.seed, t.budget, {});
}

std::int64_t sum_of(const TeamResult& result) {
  std::int64_t sum = 0;
  for (const TourResult& tour : result.tours) sum += tour.arrival;
  return sum;
}

Ticks last_of(const TeamResult& result) {
  Ticks last = 0;
  for (const TourResult& tour : result.tours) last = std::max(last, tour.arrival);
  return last;
}

// In a lane of 1.3 m one robot serves for a while, 1.75 m out of its pocket and back; another wants
// to pass. The first has the shorter tour, so that it is planned first.
Setting gate(Ticks service) {
  Setting t = team(
      hall({{0, 0}, {20, 0}, {20, 1.3}, {7.6, 1.3}, {7.6, 3.3}, {6.4, 3.3}, {6.4, 1.3}, {0, 1.3}}));
  const Pose home{7, 2.4, -kPi / 2};
  t.add(home, {to({7, 0.65, -kPi / 2}, service), to(home)});
  t.add({2, 0.65, 0}, {to({18, 0.65, 0})});
  return t;
}

// Robots that all cross the middle of a hall.
Setting crossing(int robots) {
  Setting t = team(hall(12, 12));
  for (int i = 0; i < robots; ++i) {
    const double angle = kTau * i / robots;
    const double x = 4.8 * std::cos(angle), y = 4.8 * std::sin(angle);
    t.add({6 + x, 6 + y, wrap(angle + kPi)}, {to({6 - x, 6 - y, wrap(angle + kPi)})});
  }
  return t;
}

}  // namespace

TEST_CASE("Who only wants to pass need not wait for a long service") {
  // Planned first, the one that serves is back at 1.75 + 20 + 1.75 = 23.5 s. Its nose has left the
  // other's way (y = 0.95) after 0.8 m, at 22.55 s; the other then starts with its nose at 6.7,
  // 11.8 m short of its goal: 34.35 s. In all 57.85 s.
  // The other way round the passer takes its 16 s, and its tail is past x = 7.3 at 5.8 s. The one
  // that serves may be 0.95 m on its way by then: 4.85 s late, 28.35 s. In all 44.35 s.
  Setting t = gate(20000);
  const TeamResult result = planned(t, 20000);
  check_solved(t, result);
  CHECK(result.first_cost >= 57850);
  CHECK(result.first_cost < 59000);
  CHECK(sum_of(result) >= 44350);
  CHECK(sum_of(result) < 44600);
  CHECK(result.tours[1].arrival == 16000);
  CHECK(result.repaired >= 1);
  CHECK(result.repairs >= result.repaired);
}

TEST_CASE("Without a limit to the effort the first plan is the answer") {
  Setting t = gate(20000);
  const TeamResult endless = planned(t, -1);
  check_solved(t, endless);
  CHECK(endless.repairs == 0);
  CHECK(endless.expansions == endless.first_expansions);
  CHECK(sum_of(endless) == endless.first_cost);
}

TEST_CASE("Nobody who comes as early as alone is planned anew") {
  Setting t = team(hall(20, 12));
  t.add({2, 3, 0}, {to({12, 3, 0})});
  t.add({2, 9, 0}, {to({15, 9, 0}, 1000)});
  t.agents[0].bound = 10000;
  t.agents[1].bound = 13000;
  const TeamResult result = planned(t, 100000);
  check_solved(t, result);
  CHECK(result.repairs == 0);
  CHECK(result.expansions < 1000);
}

TEST_CASE("For the makespan the sum may rise") {
  // A short service is over at 1.75 + 5 s; 0.8 m later, at 7.55 s, the lane is free, and the passer
  // comes at 19.35 s; in all 8.5 + 19.35 = 27.85 s. If it goes first it comes at 16 s, and the
  // other 4.85 s later than it could, at 13.35 s: 29.35 s in all.
  Setting t = gate(5000);
  const TeamResult least = planned(t, 20000);
  check_solved(t, least);
  CHECK(last_of(least) >= 19350);
  CHECK(sum_of(least) < 29350);
  t.params.aim = Aim::kMakespan;
  const TeamResult soonest = planned(t, 20000);
  check_solved(t, soonest);
  CHECK(last_of(soonest) == 16000);
  CHECK(sum_of(soonest) >= 29350);
  CHECK(sum_of(soonest) < 29600);
}

TEST_CASE("For the makespan neither it nor, where it stays, the sum ever rises") {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    Setting t = crossing(7);
    t.seed = seed;
    t.params.aim = Aim::kMakespan;
    const auto value = [](const TeamResult& r) { return std::make_pair(last_of(r), sum_of(r)); };
    const TeamResult first = planned(t, -1);
    auto least = value(first);
    for (const std::int64_t more : {300, 1000, 3000, 10000, 20000}) {
      const TeamResult result = planned(t, first.expansions + more);
      check_solved(t, result);
      CHECK(value(result) <= least);
      least = value(result);
    }
  }
}

TEST_CASE("Wherever the effort ends the plan is whole and right, and no dearer for more of it") {
  for (const std::uint32_t seed : {1U, 2U}) {
    Setting t = crossing(7);
    t.seed = seed;
    const TeamResult first = planned(t, -1);
    check_solved(t, first);
    std::int64_t least = first.first_cost;
    for (const std::int64_t more : {0, 1, 30, 100, 300, 1000, 3000, 10000, 30000}) {
      const TeamResult result = planned(t, first.expansions + more);
      check_solved(t, result);
      CHECK(result.first_cost == first.first_cost);
      CHECK(result.first_expansions == first.expansions);
      CHECK(result.expansions <= first.expansions + more);
      CHECK(sum_of(result) <= least);
      least = sum_of(result);
    }
    CHECK(least < first.first_cost);
  }
}

TEST_CASE("A stop at any question leaves a whole plan") {
  Setting t = crossing(7);
  const std::int64_t first = planned(t, -1).first_cost;
  for (const int last : {10, 11, 20, 40}) {
    t.budget = {};
    t.budget.timed = true;
    int asked = 0;
    t.budget.stop = [&] { return ++asked >= last; };
    const TeamResult result = plan_team(t.models, t.agents, t.params, t.seed, t.budget, {});
    if (result.status == TeamResult::Status::kSolved) {
      check_solved(t, result);
      CHECK(sum_of(result) <= first);
    }
    CHECK(asked == last);
  }
}

TEST_CASE("The same seed improves a plan in the same way") {
  Setting t = crossing(7);
  for (const std::uint32_t seed : {3U, 4U}) {
    t.seed = seed;
    const TeamResult once = planned(t, 20000), again = planned(t, 20000);
    CHECK(same(once, again));
    CHECK(once.repairs == again.repairs);
    CHECK(once.repaired == again.repaired);
  }
}

TEST_CASE("Told costs fall from the first plan's to the last one's") {
  Setting t = crossing(7);
  t.budget = {};
  t.budget.expansions = 40000;
  std::vector<std::int64_t> told;
  const TeamResult result = plan_team(t.models, t.agents, t.params, 1, t.budget,
                                      [&](int planned, int total, std::int64_t, std::int64_t cost) {
                                        if (cost < 0) return;
                                        CHECK(planned == total);
                                        if (!told.empty()) CHECK(cost < told.back());
                                        told.push_back(cost);
                                      });
  REQUIRE(static_cast<int>(told.size()) == 1 + result.repaired);
  CHECK(told.front() == result.first_cost);
  CHECK(told.back() == sum_of(result));
}

TEST_CASE("Plans are improved for the objective in metres too") {
  Setting t = crossing(6);
  t.params.objective.time = false;
  const auto metres = [](const TeamResult& result) {
    double sum = 0.0;
    for (const TourResult& tour : result.tours) sum += tour.cost;
    return sum;
  };
  const TeamResult first = planned(t, -1);
  const TeamResult better = planned(t, first.expansions + 20000);
  check_solved(t, better);
  CHECK(better.repairs > 0);
  CHECK(metres(better) <= metres(first));
}

TEST_CASE("What is fixed or committed stays as it is while others are planned anew") {
  // The passer is committed to its first 3 m; somebody fixed drives off before it.
  Setting t = gate(20000);
  t.agents[1].committed = {drive(0, 3000, {2, 0.65, 0}, {3, 0, 0})};
  t.agents[1].ready = 3000;
  t.agents[1].legs = {to({16, 0.65, 0})};
  t.add({10, 0.65, 0}, {});
  t.agents[2].fixed = true;
  t.agents[2].committed = {wait(0, 3000, {10, 0.65, 0}),
                           drive(3000, 11500, {10, 0.65, 0}, {8.5, 0, 0})};
  const TeamResult result = planned(t, 20000);
  check_solved(t, result);
  CHECK(result.repaired >= 1);
  CHECK(result.tours[1].arrival == 14000);
  CHECK(result.tours[1].pieces.front().begin == 3000);
  CHECK(result.tours[1].pieces.front().start.x == doctest::Approx(5.0));
  CHECK(result.tours[2].pieces.empty());
}
