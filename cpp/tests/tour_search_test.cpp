#include "clearway/search/tour_search.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;
using Outcome = TourResult::Outcome;

namespace {

// A search with everything it points to.
struct Errand {
  Model model;
  Pose start;
  std::vector<Leg> legs;
  std::vector<std::shared_ptr<const Track>> others;
  double gap = 0.01;
  Objective objective;
  SearchParams params;
  std::vector<double> penalty;
  Ticks ready = 0;
  int rest_body = 0;
  std::int64_t limit = 20000;
  double below = std::numeric_limits<double>::infinity();
  std::vector<Expanded> trace;
  Budget budget;

  TourResult run() {
    Traffic traffic(model.statics[0]->box(), 2.0, std::max(1.0, model.table.reach()), gap);
    for (std::size_t i = 0; i < others.size(); ++i) traffic.insert(static_cast<int>(i), others[i]);
    const std::vector<double> required(others.size(), gap);
    TourQuery query;
    query.model = &model;
    query.start = start;
    query.ready = ready;
    query.rest_body = rest_body;
    query.legs = &legs;
    query.traffic = others.empty() ? nullptr : &traffic;
    query.required = &required;
    query.penalty = penalty.empty() ? nullptr : &penalty;
    query.below = below;
    query.trace = &trace;
    trace.clear();
    TourSearch search(params, objective);
    return search(query, limit, budget);
  }
};

Errand errand(const Body& body, const Obstacles& o, const Pose& start, std::vector<Leg> legs) {
  Errand e;
  e.model = rover(body, o);
  e.start = start;
  e.legs = std::move(legs);
  return e;
}

// Everything that must hold for a way: joined pieces, obstacles kept off, visits in order.
void check_tour(const Errand& e, const TourResult& tour) {
  REQUIRE(tour.outcome == Outcome::kFound);
  Pose at = e.start;
  Ticks t = tour.pieces.front().begin;
  CHECK((t == 0 || t == e.ready));
  for (const TimedPiece& p : tour.pieces) {
    CHECK(p.begin == t);
    CHECK(p.end > p.begin);
    CHECK(std::abs(p.start.x - at.x) < 1e-5);
    CHECK(std::abs(p.start.y - at.y) < 1e-5);
    CHECK(std::abs(wrap(p.start.theta - at.theta)) < 1e-5);
    if (p.mode < 0) CHECK((p.twist.length() == 0.0 && p.twist.c == 0.0));
    const auto body = static_cast<std::size_t>(p.body);
    for (int i = 0; i <= 20; ++i) {
      const Frame f = moved(Frame(p.start), p.twist.part(i / 20.0));
      CHECK(e.model.statics[body]->gap(e.model.bodies[body], f) >= -0.001);
    }
    t = p.end;
    at = moved(p.start, p.twist);
  }
  REQUIRE(tour.stops.size() == e.legs.size());
  Ticks left = e.ready;
  for (std::size_t i = 0; i < e.legs.size(); ++i) {
    const TourStop& stop = tour.stops[i];
    CHECK(stop.leg == static_cast<int>(i));
    CHECK(stop.arrive >= std::max(left, e.legs[i].not_before));
    CHECK(stop.leave == stop.arrive + e.legs[i].service);
    for (const Ticks when : {stop.arrive, stop.leave}) {
      const Pose there = pose_at(e.start, tour.pieces, when);
      CHECK(std::abs(there.x - e.legs[i].goal.x) < 1e-5);
      CHECK(std::abs(there.y - e.legs[i].goal.y) < 1e-5);
      CHECK(std::abs(wrap(there.theta - e.legs[i].goal.theta)) < 1e-5);
    }
    left = stop.leave;
  }
  CHECK(std::max(tour.arrival, e.legs.back().not_before) == tour.stops.back().arrive);
}

void check_apart(const Errand& e, const TourResult& tour, const std::vector<int>& spared = {}) {
  const Track own(&e.model.bodies, e.start, tour.pieces);
  for (std::size_t i = 0; i < e.others.size(); ++i) {
    if (std::count(spared.begin(), spared.end(), static_cast<int>(i))) continue;
    const Ticks last = std::max(own.settled(), e.others[i]->settled()) + 1000;
    CHECK(least_gap(own, *e.others[i], last, 5) >= -0.001);
  }
}

const std::vector<Body> kBlocks{rectangle(1.0, 0.6), rectangle(1.0, 0.6)};

std::shared_ptr<const Track> track(const Pose& start, std::vector<TimedPiece> pieces) {
  return std::make_shared<const Track>(&kBlocks, start, std::move(pieces));
}

bool same(const TourResult& a, const TourResult& b) {
  if (a.outcome != b.outcome || a.pieces.size() != b.pieces.size() || a.hits != b.hits)
    return false;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const TimedPiece &p = a.pieces[i], &q = b.pieces[i];
    if (p.begin != q.begin || p.end != q.end || p.mode != q.mode || p.start.x != q.start.x ||
        p.start.y != q.start.y || p.start.theta != q.start.theta || p.twist.a != q.twist.a) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("Alone on the site a robot reaches any pose exactly, round what stands there") {
  Obstacles o = hall(16, 12);
  add_solid(o, {{5, 3}, {9, 3}, {9, 8}, {8, 8}, {8, 4}, {5, 4}});
  o.segments.push_back({{12, 0}, {12, 7}});
  Dice dice(101);
  int asked = 0;
  for (const bool car : {false, true}) {
    const Body body = rectangle(1.0, 0.6);
    const Model model = car ? model_of(body, o, car_table(16), car_table(32)) : rover(body, o);
    for (int i = 0; i < 25; ++i) {
      const Pose from{dice.between(1, 15), dice.between(1, 11), dice.between(-kPi, kPi)};
      const Pose to{dice.between(1, 15), dice.between(1, 11), dice.between(-kPi, kPi)};
      if (model.statics[0]->gap(body, Frame(from)) < 0.3 ||
          model.statics[0]->gap(body, Frame(to)) < 0.3 ||
          model.statics[0]->clearance(from.x, from.y) == 0.0 ||
          model.statics[0]->clearance(to.x, to.y) == 0.0) {
        continue;
      }
      ++asked;
      Errand e;
      e.model = model;
      e.start = from;
      e.legs = {{to, 0, 0, 0.0}};
      const TourResult tour = e.run();
      check_tour(e, tour);
      // Never faster than the air line at the top speed of 1 m/s.
      CHECK(tour.arrival >= 1000.0 * std::hypot(to.x - from.x, to.y - from.y) - 1.0);
    }
  }
  CHECK(asked > 25);
}

TEST_CASE("Straight ahead in the open a robot takes its length over its speed") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 6), {2, 3, 0}, {{{17, 3, 0}, 0, 0, 0.0}});
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.arrival == 15000);
}

TEST_CASE("Visits are made in order, each for its whole service") {
  Errand e = errand(
      rectangle(1.0, 0.6), hall(20, 12), {2, 3, 0},
      {{{10, 9, 1.0}, 4000, 0, 0.0}, {{3, 9, -2.0}, 2500, 1, 0.0}, {{17, 3, 0.3}, 700, 0, 0.0}});
  const TourResult tour = e.run();
  check_tour(e, tour);
  // Each piece carries the body of the visit it leads to, and keeps it through the service.
  for (const TimedPiece& p : tour.pieces) {
    int body = 0;
    if (p.begin >= tour.stops[0].leave && p.end <= tour.stops[1].leave) body = 1;
    CHECK(p.body == body);
  }
}

TEST_CASE("After its last visit a robot rests with its new body, where that has room") {
  // It picks up a load 3 m long across its way; somebody passes 1 m beside it from 20 s on.
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 3, 0}, {{{10, 6, 0}, 1000, 0, 0.0}});
  e.model = rover(rectangle(0.6, 3.0), hall(20, 12));
  e.model.bodies[0] = rectangle(1.0, 0.6);
  e.others = {track({1, 7.2, 0},
                    {wait(0, 20000, {1, 7.2, 0}), drive(20000, 38000, {1, 7.2, 0}, {18, 0, 0})})};
  const TourResult empty = e.run();
  check_tour(e, empty);
  CHECK(empty.arrival < 12000);
  e.rest_body = 1;
  const TourResult loaded = e.run();
  check_tour(e, loaded);
  // The passer's tail has left the load when its centre is at 10 + 0.3 + 0.5: at 29.8 s.
  CHECK(loaded.stops[0].leave >= 29800);
  CHECK(loaded.arrival < 32000);
  const Track own(&e.model.bodies, e.start, loaded.pieces);
  CHECK(own.at(loaded.stops[0].leave - 1).body == &e.model.bodies[0]);
  CHECK(own.at(loaded.stops[0].leave + 10).body == &e.model.bodies[1]);
  check_apart(e, loaded);
}

TEST_CASE("Where it stands already a robot only serves") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 3, 0.4}, {{{2, 3, 0.4}, 4000, 0, 0.0}});
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.arrival == 0);
}

TEST_CASE("Who is ready late starts late") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 6), {2, 3, 0}, {{{7, 3, 0}, 0, 0, 0.0}});
  e.ready = 3000;
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.arrival == 8000);
}

TEST_CASE("A robot lets crossing traffic pass") {
  // A lane of 1.2 m along x; somebody crosses it at x = 10 through doors while it would be there.
  Obstacles o = hall(20, 12);
  add_solid(o, box_points(0, 0, 9, 5.4));
  add_solid(o, box_points(11, 0, 20, 5.4));
  add_solid(o, box_points(0, 6.6, 9, 12));
  add_solid(o, box_points(11, 6.6, 20, 12));
  for (const double gap : {0.0, 0.01, 0.05}) {
    Errand e = errand(rectangle(1.0, 0.6), o, {2, 6, 0}, {{{18, 6, 0}, 0, 0, 0.0}});
    e.gap = gap;
    e.others = {track({10, 1, kPi / 2}, {wait(0, 3000, {10, 1, kPi / 2}),
                                         drive(3000, 13000, {10, 1, kPi / 2}, {10, 0, 0})})};
    const TourResult tour = e.run();
    check_tour(e, tour);
    check_apart(e, tour);
    // Undisturbed 16 s. The lane is free when the crosser's tail has left it: its centre at
    // y = 6 + 0.3 + 0.5 = 6.8, at 3 + 5.8 = 8.8 s; then from nose at 9.7, x = 9.2, on: 8.8 s more.
    CHECK(tour.arrival > 16000);
    CHECK(tour.arrival < 19500);
  }
}

TEST_CASE("A service that somebody would drive into is begun after he has passed") {
  // Undisturbed from 9 s to 29 s at x = 10; the crosser reaches y = 5.2 (6 less two half lengths
  // and widths: 0.3 + 0.5) at 20 + 4.2 s, and is past y = 6.8 at 25.8 s.
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {1, 6, 0},
                    {{{10, 6, 0}, 20000, 0, 0.0}, {{18, 6, 0}, 0, 0, 0.0}});
  e.others = {track({10, 1, kPi / 2}, {wait(0, 20000, {10, 1, kPi / 2}),
                                       drive(20000, 30000, {10, 1, kPi / 2}, {10, 0, 0})})};
  const TourResult tour = e.run();
  check_tour(e, tour);
  check_apart(e, tour);
  CHECK(tour.stops[0].arrive >= 25800);
  // With 15 s of service less it is done before.
  e.legs[0].service = 5000;
  const TourResult brief = e.run();
  check_tour(e, brief);
  check_apart(e, brief);
  CHECK(brief.stops[0].leave < 24200);
}

TEST_CASE("Who comes too early waits at the visit, and looks for no other way meanwhile") {
  // It is there after 9 s, is served from 60 s on, and drives 8 m more in 8 s.
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {1, 6, 0},
                    {{{10, 6, 0}, 2000, 0, 0.0, 60000}, {{18, 6, 0}, 0, 0, 0.0}});
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.stops[0].arrive == 60000);
  CHECK(tour.arrival == 70000);
  CHECK(tour.cost == doctest::Approx(70000));
  CHECK(e.trace.size() < 10);
  // It has stood at its start for most of the time, and was there long before.
  REQUIRE(tour.pieces.front().mode < 0);
  CHECK(tour.pieces.front().end >= 40000);
  CHECK(tour.pieces.front().end <= 51000);
  // The first of three visits need not be hurried to either: 2 m before, 2 m after.
  e.legs.insert(e.legs.begin(), {{3, 6, 0}, 0, 0, 0.0});
  const TourResult longer = e.run();
  check_tour(e, longer);
  CHECK(longer.arrival == 70000);
  CHECK(e.trace.size() < 10);
}

TEST_CASE("Where somebody passes, nobody waits for the time of his visit") {
  // The crosser is at the visit from 24.2 s to 25.8 s; that is served from 40 s on.
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {1, 6, 0},
                    {{{10, 6, 0}, 1000, 0, 0.0, 40000}, {{18, 6, 0}, 0, 0, 0.0}});
  e.others = {track({10, 1, kPi / 2}, {wait(0, 20000, {10, 1, kPi / 2}),
                                       drive(20000, 30000, {10, 1, kPi / 2}, {10, 0, 0})})};
  const TourResult tour = e.run();
  check_tour(e, tour);
  check_apart(e, tour);
  CHECK(tour.stops[0].arrive == 40000);
  CHECK(tour.arrival == 49000);
}

TEST_CASE("A final rest is not later for a service that is") {
  for (const bool time : {true, false}) {
    Errand e =
        errand(rectangle(1.0, 0.6), hall(20, 12), {1, 6, 0}, {{{10, 6, 0}, 1000, 0, 0.0, 40000}});
    e.objective.time = time;
    const TourResult tour = e.run();
    check_tour(e, tour);
    CHECK(tour.arrival == 9000);
    CHECK(tour.stops[0].arrive == 40000);
    CHECK(tour.cost == doctest::Approx(time ? 10000 : 9));
  }
}

TEST_CASE("Waiting for a visit costs what waiting costs") {
  // 17 m, and 0.1 for each of the 51 s at the visit.
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {1, 6, 0},
                    {{{10, 6, 0}, 2000, 0, 0.0, 60000}, {{18, 6, 0}, 0, 0, 0.0}});
  e.objective.time = false;
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.cost == doctest::Approx(17 + 5.1));
}

TEST_CASE("In a lane behind a slower robot one follows") {
  Obstacles o = hall(30, 1.2);
  Errand e = errand(rectangle(1.0, 0.6), o, {2, 0.6, 0}, {{{24, 0.6, 0}, 0, 0, 0.0}});
  // Half as fast, from 4 to 28: it passes 25 (24 and two half lengths) at 42 s.
  e.others = {track({4, 0.6, 0}, {drive(0, 48000, {4, 0.6, 0}, {24, 0, 0})})};
  const TourResult tour = e.run();
  check_tour(e, tour);
  check_apart(e, tour);
  CHECK(tour.arrival >= 41900);
  CHECK(tour.arrival < 46000);
}

TEST_CASE("A final rest is begun when nobody passes there any more") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 3, 0}, {{{10, 6, 0}, 0, 0, 0.0}});
  e.others = {track({10, 1, kPi / 2}, {wait(0, 30000, {10, 1, kPi / 2}),
                                       drive(30000, 40000, {10, 1, kPi / 2}, {10, 0, 0})})};
  const TourResult tour = e.run();
  check_tour(e, tour);
  check_apart(e, tour);
  // The crosser's tail leaves y = 6.3 with its centre at 6.8: at 35.8 s.
  CHECK(tour.arrival >= 35800);
  CHECK(tour.arrival < 38000);
}

TEST_CASE("Walled in, or bound for where somebody rests for ever, no way is left") {
  Obstacles o = hall(20, 12);
  o.segments.push_back({{10, 0}, {10, 12}});
  Errand walled = errand(rectangle(1.6, 1.6), o, {4, 6, 0}, {{{16, 6, 0}, 0, 0, 0.0}});
  CHECK(walled.run().outcome == Outcome::kExhausted);
  Errand taken = errand(rectangle(1.0, 0.6), hall(20, 12), {4, 6, 0}, {{{16, 6, 0}, 0, 0, 0.0}});
  taken.others = {track({16.3, 6, 1.0}, {})};
  CHECK(taken.run().outcome == Outcome::kExhausted);
  CHECK(taken.budget.spent == 0);
}

TEST_CASE("A limit or a budget stops a search, and that is not called exhausted") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 3, 0}, {{{17, 9, 2.0}, 0, 0, 0.0}});
  e.limit = 1;
  Obstacles o = hall(20, 12);
  add_solid(o, box_points(9, 0, 10, 10));
  e.model = rover(rectangle(1.0, 0.6), o);
  CHECK(e.run().outcome == Outcome::kStopped);
  CHECK(!e.budget.ended);
  e.limit = 100000;
  e.budget.expansions = 3;
  e.budget.spent = 0;
  CHECK(e.run().outcome == Outcome::kStopped);
  CHECK(e.budget.ended);
}

TEST_CASE("Soft search runs into those it must and says into whom") {
  // A lane held by somebody at rest, and a second one that is in nobody's way.
  Obstacles o = hall(20, 1.2);
  Errand e = errand(rectangle(1.0, 0.6), o, {2, 0.6, 0}, {{{17, 0.6, 0}, 0, 0, 0.0}});
  e.others = {track({19, 0.6, 0}, {}), track({10, 0.6, 0}, {})};
  CHECK(e.run().outcome != Outcome::kFound);
  e.penalty = {5000.0, 5000.0};
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.hits == std::vector<int>{1});
  check_apart(e, tour, tour.hits);
  e.penalty = {5000.0, -1.0};  // that one does not move away
  CHECK(e.run().outcome == Outcome::kExhausted);
}

TEST_CASE("Soft search would rather go round or wait than pay more for a hit") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 6, 0}, {{{17, 6, 0}, 0, 0, 0.0}});
  e.others = {track({10, 6, 0}, {})};
  e.penalty = {60000.0};
  const TourResult round = e.run();
  check_tour(e, round);
  CHECK(round.hits.empty());
  check_apart(e, round);
  e.penalty = {1.0};
  const TourResult through = e.run();
  CHECK(through.hits == std::vector<int>{0});
  CHECK(through.arrival < round.arrival);
}

TEST_CASE("Resting in somebody's way counts as hitting him") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 6, 0}, {{{10, 6, 0}, 0, 0, 0.0}});
  e.others = {track({10, 1, kPi / 2}, {wait(0, 200000, {10, 1, kPi / 2}),
                                       drive(200000, 210000, {10, 1, kPi / 2}, {10, 0, 0})})};
  e.penalty = {5000.0};
  const TourResult tour = e.run();
  check_tour(e, tour);
  CHECK(tour.hits == std::vector<int>{0});
  CHECK(tour.arrival < 20000);
}

TEST_CASE("Another objective buys another way") {
  // Round a block: by time a rover turns and drives; where a change of mode costs 3 m each, fewer
  // changes are worth a way that takes longer.
  Obstacles o = hall(20, 12);
  add_solid(o, box_points(6, 3, 14, 9));
  Errand e = errand(rectangle(1.0, 0.6), o, {3, 6, kPi / 2}, {{{17, 6, -kPi / 2}, 0, 0, 0.0}});
  e.params.weight = 1.0;
  const auto changes = [](const TourResult& tour) {
    int count = 0, last = -1;
    for (const TimedPiece& p : tour.pieces) {
      if (p.mode < 0) continue;
      count += last >= 0 && p.mode != last;
      last = p.mode;
    }
    return count;
  };
  const TourResult fast = e.run();
  check_tour(e, fast);
  e.objective.time = false;
  e.objective.mode_switch = 30.0;
  e.model.table.turn_arm = 0.1;
  e.limit = 200000;
  const TourResult calm = e.run();
  check_tour(e, calm);
  CHECK(changes(calm) <= changes(fast));
  CHECK(calm.arrival >= fast.arrival);
}

TEST_CASE("A change of mode takes its standing time wherever it happens") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 3, 0},
                    {{{10, 9, 1.0}, 1000, 0, 0.0}, {{3, 9, -2.0}, 0, 0, 0.0}});
  e.model.table.switch_duration = 800;
  const TourResult tour = e.run();
  check_tour(e, tour);
  int last = -1;
  Ticks stood_since = 0;
  int switches = 0;
  for (const TimedPiece& p : tour.pieces) {
    if (p.mode < 0) continue;
    if (last >= 0 && p.mode != last) {
      ++switches;
      CHECK(p.begin - stood_since >= 800);
    }
    last = p.mode;
    stood_since = p.end;
  }
  CHECK(switches > 1);
}

TEST_CASE("No robot waits in a mode in which it cannot rest") {
  Obstacles o = hall(30, 1.2);
  Errand e = errand(rectangle(1.0, 0.6), o, {2, 0.6, 0}, {{{24, 0.6, 0}, 0, 0, 0.0}});
  e.model.table.rest = {false, true, true, true};
  e.others = {track({26, 0.6, 0},
                    {wait(0, 9000, {26, 0.6, 0}), drive(9000, 11000, {26, 0.6, 0}, {2.5, 0, 0})})};
  const TourResult tour = e.run();
  check_tour(e, tour);
  check_apart(e, tour);
  for (std::size_t i = 1; i < tour.pieces.size(); ++i) {
    const bool at_end = tour.pieces[i].begin >= tour.arrival;
    if (tour.pieces[i].mode < 0 && !at_end) CHECK(tour.pieces[i - 1].mode != kForward);
  }
}

TEST_CASE("A primitive begins only in the modes that it may follow") {
  // A lane too narrow to turn in (half diagonal 0.58): who has driven in must back out.
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 0.8), {2, 0.4, 0},
                    {{{6, 0.4, 0}, 0, 0, 0.0}, {{3.25, 0.4, 0}, 0, 0, 0.0}});
  e.model.table.connections[0].reverse_speed = 0.0;
  check_tour(e, e.run());
  e.model.table.primitives[kReverse].from = ~(1ULL << kForward);
  CHECK(e.run().outcome == Outcome::kExhausted);
}

TEST_CASE("The same questions in the same order have the same answers, of any search") {
  Obstacles o = hall(20, 12);
  add_solid(o, box_points(8, 0, 9, 9));
  Errand e = errand(rectangle(1.0, 0.6), o, {4, 3, 0},
                    {{{14, 3, 0.5}, 1000, 0, 0.0}, {{3, 8, 2}, 0, 1, 0.0}});
  e.others = {track({10, 1, kPi / 2}, {drive(0, 10000, {10, 1, kPi / 2}, {10, 0, 0})})};
  const TourResult first = e.run(), second = e.run();
  check_tour(e, first);
  CHECK(same(first, second));
  Traffic traffic(e.model.statics[0]->box(), 2.0, 1.0, 0.01);
  traffic.insert(0, e.others[0]);
  const std::vector<double> required{0.01};
  TourQuery query;
  query.model = &e.model;
  query.start = e.start;
  query.legs = &e.legs;
  query.traffic = &traffic;
  query.required = &required;
  TourSearch one(e.params, e.objective), other(e.params, e.objective);
  Budget budget;
  CHECK(same(one(query, 20000, budget), first));
  CHECK(same(other(query, 20000, budget), first));
  // What a search has learnt of a site it keeps.
  CHECK(same(one(query, 20000, budget), other(query, 20000, budget)));
}

TEST_CASE("Through random traffic whatever way is found keeps off everybody") {
  Dice dice(102);
  int found = 0;
  for (int round = 0; round < 12; ++round) {
    Obstacles o = hall(16, 16);
    add_solid(o, box_points(6, 6, 10, 10));
    Errand e = errand(rectangle(1.0, 0.6), o, {2, 2, 0.3},
                      {{{13, 13, -1}, 2000, 0, 0.0}, {{3, 12, 2}, 0, 1, 0.0}});
    e.gap = round % 2 ? 0.01 : 0.0;
    for (int i = 0; i < 6; ++i) {
      const bool across = dice.below(2);
      const double at = dice.below(2) ? dice.between(3.5, 5) : dice.between(11, 12.5);
      const Pose start = across ? Pose{1, at, 0} : Pose{at, 1, kPi / 2};
      std::vector<TimedPiece> pieces;
      Ticks t = 0;
      for (int k = 0; k < 6; ++k) {
        const auto hold = static_cast<Ticks>(dice.between(0, 4000));
        const Pose here = k % 2 ? moved(start, Twist{14, 0, 0}) : start;
        pieces.push_back(wait(t, t + hold, here));
        pieces.push_back(drive(t + hold, t + hold + 14000, here, {k % 2 ? -14.0 : 14.0, 0, 0}));
        t += hold + 14000;
      }
      e.others.push_back(track(start, pieces));
    }
    const TourResult tour = e.run();
    if (tour.outcome != Outcome::kFound) continue;
    ++found;
    check_tour(e, tour);
    check_apart(e, tour);
  }
  CHECK(found >= 8);
}

namespace {

// Round a block, and to be sought with care.
Errand detour() {
  Obstacles o = hall(20, 12);
  add_solid(o, box_points(9, 0, 10, 10));
  Errand e = errand(rectangle(1.0, 0.6), o, {4, 3, 0}, {{{15, 3, 2.0}, 1500, 0, 0.0}});
  e.params.weight = e.params.tail_weight = 1.0;
  e.params.greed = 0.0;
  e.limit = 200000;
  return e;
}

}  // namespace

TEST_CASE("A search that would keep too much stops and says so") {
  Errand e = detour();
  const TourResult whole = e.run();
  check_tour(e, whole);
  CHECK(!whole.is_full);
  e.params.most_nodes = 60;
  const TourResult full = e.run();
  CHECK(full.outcome == Outcome::kStopped);
  CHECK(full.is_full);
  CHECK(full.pieces.empty());
  e.params.most_nodes = 2'000'000;
  e.limit = 3;
  const TourResult brief = e.run();
  CHECK(brief.outcome == Outcome::kStopped);
  CHECK(!brief.is_full);
}

TEST_CASE("A search that may keep no distances answers every time as if it were new") {
  Errand e = detour();
  e.params.most_cells = 1;
  TourSearch forgetful(e.params, e.objective);
  Dice dice(103);
  for (int i = 0; i < 12; ++i) {
    e.legs[0].goal = {dice.between(11, 18), dice.between(2, 10), dice.between(-kPi, kPi)};
    TourQuery query;
    query.model = &e.model;
    query.start = e.start;
    query.legs = &e.legs;
    const TourResult fresh = e.run();
    check_tour(e, fresh);
    for (int again = 0; again < 2; ++again) {
      Budget budget;
      CHECK(same(forgetful(query, e.limit, budget), fresh));
      CHECK(budget.spent == static_cast<std::int64_t>(e.trace.size()));
    }
  }
}

TEST_CASE("Below the cost of the best way nothing is found, above it the same way is") {
  // 15 m at 1 m/s, and 2 s of service: 17,000 ticks from when it is ready.
  Errand straight = errand(rectangle(1.0, 0.6), hall(20, 6), {2, 3, 0}, {{{17, 3, 0}, 2000, 0, 0}});
  straight.ready = 3000;
  straight.params.weight = 1.0;
  straight.limit = 5000;
  const TourResult best = straight.run();
  check_tour(straight, best);
  CHECK(best.cost == 17000.0);
  straight.below = 17000.0;
  CHECK(straight.run().outcome != Outcome::kFound);
  straight.below = 17001.0;
  CHECK(same(straight.run(), best));
  Errand round = detour();
  const TourResult found = round.run();
  check_tour(round, found);
  const auto effort = round.trace.size();
  round.below = found.cost + 1.0;
  CHECK(same(round.run(), found));
  CHECK(round.trace.size() <= effort);
  round.below = found.cost;
  CHECK(round.run().outcome == Outcome::kExhausted);
  round.below = 0.7 * found.cost;
  CHECK(round.run().outcome == Outcome::kExhausted);
  CHECK(round.trace.size() < effort);
}

TEST_CASE("A trace tells of each state once, the start first, with the time it is safe there") {
  Errand e = errand(rectangle(1.0, 0.6), hall(20, 12), {2, 6, 0.3},
                    {{{10, 6, 0}, 3000, 0, 0.0}, {{17, 6, 1.0}, 0, 0, 0.0}});
  e.ready = 1000;
  // One drives over where it starts, another crosses its way.
  e.others = {track({2, 1, kPi / 2}, {drive(0, 10000, {2, 1, kPi / 2}, {10, 0, 0})}),
              track({14, 11, -kPi / 2}, {drive(0, 10000, {14, 11, -kPi / 2}, {10, 0, 0})})};
  const TourResult tour = e.run();
  check_tour(e, tour);
  check_apart(e, tour);
  REQUIRE(!e.trace.empty());
  CHECK(static_cast<std::int64_t>(e.trace.size()) == e.budget.spent);
  const Expanded& first = e.trace.front();
  CHECK(first.pose.x == 2.0);
  CHECK(first.pose.y == 6.0);
  CHECK(first.pose.theta == doctest::Approx(0.3));
  CHECK(first.begin == 1000);
  CHECK(first.leg == 0);
  int limited = 0;
  for (const Expanded& state : e.trace) {
    CHECK(state.begin <= state.end);
    CHECK(state.begin >= e.ready);
    CHECK((state.leg == 0 || state.leg == 1));
    limited += state.end < kNever;
    // Nobody comes while it stands there, and everybody is at rest after 10 s.
    const Track standing(&kBlocks, state.pose, {});
    for (const auto& other : e.others) {
      for (Ticks t = state.begin; t <= std::min(state.end, 11000); t += 20) {
        const Track::Sight seen = other->at(t);
        CHECK(gap(kBlocks[0], Frame(state.pose), *seen.body, seen.frame, kFar) >= -0.001);
      }
    }
  }
  CHECK(limited > 0);
  CHECK(first.end < 5000);  // the nose is half a metre ahead at 1 + t
}

TEST_CASE("With greed a long search ends sooner, with a way that may be longer") {
  Errand e = detour();
  const TourResult careful = e.run();
  check_tour(e, careful);
  const auto effort = e.trace.size();
  CHECK(effort > 256);
  e.params.greed = 1.0;
  const TourResult greedy = e.run();
  check_tour(e, greedy);
  CHECK(e.trace.size() < effort);
  CHECK(greedy.cost >= careful.cost);
  CHECK(greedy.cost < 1.5 * careful.cost);
}
