#include "clearway/motion/ramp.hpp"

#include <doctest/doctest.h>

#include "clearway/search/tour_search.hpp"
#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

namespace {

constexpr int kFastForward = 4, kFastReverse = 5;
constexpr double kRate = 0.5;  // m/s^2, faster and slower

Primitive ramped(int ends_in, int driven_in, double way, double enter, double leave,
                 std::uint64_t from) {
  Primitive p{ends_in, {way, 0.0, 0.0}, 0, 0, from, {}};
  Ramp::make(std::abs(way), enter, leave, 1.0, kRate, kRate)->cut({driven_in, p.twist, 0}, p.steps);
  for (const Step& step : p.steps) p.duration += step.duration;
  return p;
}

// The rover, with a level of 1 m/s both ways: 1 m to get there and 1 m to stop.
MotionTable heavy_rover_table(int headings = 16) {
  MotionTable t = rover_table(headings);
  t.rest = {true, true, true, true, false, false};
  t.paces = {{kForward, 0, 0.0}, {kReverse, 1, 0.0}, {kLeft, 2, 0.0},
             {kRight, 3, 0.0},   {kForward, 0, 1.0}, {kReverse, 1, 1.0}};
  t.acceleration = t.deceleration = kRate;
  const std::uint64_t at_rest = 1ULL << 63 | 0xF;
  const std::vector<Primitive> turns(t.primitives.begin() + 2, t.primitives.end());
  t.primitives.clear();
  for (const int way : {1, -1}) {
    const int slow = way > 0 ? kForward : kReverse, fast = way > 0 ? kFastForward : kFastReverse;
    t.primitives.push_back(ramped(slow, slow, 0.5 * way, 0.0, 0.0, at_rest));
    t.primitives.push_back(ramped(fast, slow, way, 0.0, 1.0, at_rest));
    t.primitives.push_back(ramped(fast, slow, 0.5 * way, 1.0, 1.0, 1ULL << fast));
    t.primitives.push_back(ramped(slow, slow, way, 1.0, 0.0, 1ULL << fast));
  }
  for (Primitive turn : turns) {
    turn.from = at_rest;
    t.primitives.push_back(turn);
  }
  return t;
}

double speed_of(const TimedPiece& p) { return p.twist.a / (p.end - p.begin) * kTicksPerSecond; }

// Speeds change no faster than the limit, between the middles of neighbouring pieces.
void check_ramps(const std::vector<TimedPiece>& pieces) {
  double speed = 0.0, half = 0.05;
  for (const TimedPiece& p : pieces) {
    const double seconds = (p.end - p.begin) / kTicksPerSecond;
    // From standing on, a ramp begins at the piece's own start.
    const bool stands = p.twist.length() == 0.0;
    const double between = (stands ? 0.0 : 0.5 * seconds) + half;
    CHECK(std::abs(speed_of(p) - speed) <= kRate * between + 2e-3);
    speed = speed_of(p);
    half = stands ? 0.0 : 0.5 * seconds;
  }
}

}  // namespace

TEST_CASE("A ramp goes up, holds and comes down") {
  // 1 m/s from rest at 1 m/s^2 takes 0.5 m; at 0.5 m/s^2 down to rest 1 m; 1.5 m are held.
  const auto ramp = Ramp::make(3.0, 0.0, 0.0, 1.0, 1.0, 0.5);
  REQUIRE(ramp);
  CHECK(ramp->rising() == doctest::Approx(1.0));
  CHECK(ramp->falling() == doctest::Approx(2.0));
  CHECK(ramp->seconds() == doctest::Approx(4.5));
  CHECK(ramp->way(0.5) == doctest::Approx(0.125));
  CHECK(ramp->way(2.0) == doctest::Approx(1.5));
  CHECK(ramp->way(3.5) == doctest::Approx(2.75));
  CHECK(ramp->way(4.5) == doctest::Approx(3.0));
}

TEST_CASE("A stretch too short for a change of speed has no ramp") {
  CHECK(!Ramp::make(1.9, 2.0, 0.0, 2.0, 1.0, 1.0));
  CHECK(!Ramp::make(1.9, 0.0, 2.0, 2.0, 1.0, 1.0));
  CHECK(Ramp::make(2.0, 2.0, 0.0, 2.0, 1.0, 1.0));
  CHECK(!Ramp::make(9.0, 2.0, 0.0, 1.5, 1.0, 1.0));
}

TEST_CASE("Cut into steps a ramp is as long as before, and steps are even for 0.12 s at the most") {
  Dice dice(201);
  for (int round = 0; round < 300; ++round) {
    const double top = dice.between(0.3, 4.0), length = dice.between(0.001, 20.0);
    const double up = dice.between(0.2, 4.0), down = dice.between(0.2, 4.0);
    const auto ramp =
        Ramp::make(length, dice.between(0.0, top), dice.between(0.0, top), top, up, down);
    if (!ramp) continue;
    std::vector<Step> steps;
    ramp->cut({kLeft, {length, 0.0, 1.0}, 0}, steps);
    double way = 0.0, turn = 0.0;
    Ticks ticks = 0;
    for (const Step& step : steps) {
      CHECK(step.duration > 0);
      CHECK(step.twist.a / step.duration * kTicksPerSecond <= top * (1.0 + 1e-9));
      const bool holds = ticks >= ramp->rising() * 1000.0 - 2.0 &&
                         ticks + step.duration <= (ramp->seconds() - ramp->falling()) * 1000.0 + 3;
      CHECK((holds || step.duration < 120));
      way += step.twist.a;
      turn += step.twist.c;
      ticks += step.duration;
    }
    CHECK(way == doctest::Approx(length));
    CHECK(turn == doctest::Approx(1.0));
    CHECK(ticks == std::max(1, to_ticks(ramp->seconds())));
  }
}

TEST_CASE("A shot from speed goes on as one came, and is none where one cannot stop in time") {
  const MotionTable table = heavy_rover_table();
  std::vector<Shot> shots;
  connect(table, {}, {0, 0, 0}, {4, 0, 0}, 1, shots);
  REQUIRE(shots.size() == 1);
  CHECK(shots[0].duration == 6000);  // 2 s up, 2 m at 1 m/s, 2 s down
  connect(table, {}, {0, 0, 0}, {4, 0, 0}, 1, shots, kFastForward);
  REQUIRE(shots.size() == 1);
  CHECK(shots[0].duration == 5000);
  CHECK(shots[0].steps.front().mode == kForward);
  connect(table, {}, {0, 0, 0}, {0.9, 0, 0}, 1, shots, kFastForward);
  CHECK(shots.empty());
  connect(table, {}, {0, 0, 0}, {4, 0, 0}, 1, shots, kFastReverse);
  CHECK(shots.empty());
  connect(table, {}, {0, 0, 0}, {0, 0, 0}, 1, shots, kFastForward);
  CHECK(shots.empty());
}

TEST_CASE("No shot is quicker than the estimate") {
  const MotionTable table = heavy_rover_table();
  Dice dice(202);
  std::vector<Shot> shots;
  for (int round = 0; round < 200; ++round) {
    const Pose goal{dice.between(-9, 9), round % 3 ? dice.between(-9, 9) : 0.0, 0.0};
    const int mode = round % 2 ? kFastForward : kForward;
    connect(table, {}, {0, 0, 0}, goal, 1, shots, mode);
    if (shots.empty()) continue;
    const double least = table.least_ticks(std::hypot(goal.x, goal.y), table.speed(mode));
    CHECK(shots[0].duration >= least - 1e-6);
  }
}

TEST_CASE("Through traffic a heavy rover keeps its ramps and waits only at rest") {
  Dice dice(203);
  int found = 0, waits = 0;
  for (int round = 0; round < 20; ++round) {
    Obstacles o = hall(16, 16);
    add_solid(o, box_points(6, 6, 10, 10));
    const Body body = rectangle(1.0, 0.6);
    const Model model = model_of(body, o, heavy_rover_table(16), heavy_rover_table(32));
    Traffic traffic(model.statics[0]->box(), 2.0, 1.0, 0.01);
    for (int i = 0; i < 4; ++i) {
      const bool across = dice.below(2);
      const double at = dice.below(2) ? dice.between(3.5, 5) : dice.between(11, 12.5);
      const Pose start = across ? Pose{1, at, 0} : Pose{at, 1, kPi / 2};
      const auto hold = static_cast<Ticks>(dice.between(0, 15000));
      std::vector<TimedPiece> pieces{wait(0, hold, start),
                                     drive(hold, hold + 14000, start, {14.0, 0, 0})};
      traffic.insert(i, std::make_shared<const Track>(&model.bodies, start, pieces, hold + 20000));
    }
    const std::vector<double> required(4, 0.01);
    const std::vector<Leg> legs{{{13, 13, -1}, 2000, 0, 0.0}, {{3, 12, 2}, 0, 1, 0.0}};
    TourQuery query;
    query.model = &model;
    query.start = {2, 2, 0.3};
    query.legs = &legs;
    query.traffic = &traffic;
    query.required = &required;
    TourSearch search({}, {});
    Budget budget;
    const TourResult tour = search(query, 60000, budget);
    if (tour.outcome != TourResult::Outcome::kFound) continue;
    ++found;
    check_ramps(tour.pieces);
    for (const TimedPiece& p : tour.pieces) {
      CHECK(p.mode < 4);
      waits += p.mode < 0 && p.begin < tour.arrival;
    }
  }
  CHECK(found >= 15);
  CHECK(waits > found);  // more than the one service each
}
