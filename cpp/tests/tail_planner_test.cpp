#include "clearway/multi/tail_planner.hpp"

#include <doctest/doctest.h>

#include "teams.hpp"

using namespace clearway;
using namespace scenes;

namespace {

constexpr Pose kWest{2, 3, 0}, kCentre{8, 3, 0}, kEast{14, 3, 0};

TailQuery from(int robot, const Pose& start, std::vector<Leg> legs, std::vector<Pose> rests) {
  TailQuery query;
  query.robot = robot;
  query.start = start;
  query.legs = std::move(legs);
  query.rests = std::move(rests);
  query.limit = 20000;
  return query;
}

// Two rovers in a hall, one at its left end and one in its middle.
struct Hall {
  Obstacles walls = hall(20, 6);
  TailPlanner planner{{rover(rectangle(1.0, 0.6), walls)}, {0, 0}, {}};
  Budget budget;

  Hall() {
    planner.place(0, 0, kWest, {}, 0);
    planner.place(1, 0, kCentre, {}, 0);
  }
};

}  // namespace

TEST_CASE("a track that forgets the past tells the same of what comes") {
  const std::vector<Body> bodies{rectangle(1.0, 0.6)};
  const Ticks begin = 7'000'123;
  const std::vector<TimedPiece> pieces{{begin, begin + 4000, {2, 3, 0}, {4, 0, 0}, 0, 0},
                                       {begin + 5000, begin + 9000, {6, 3, 0}, {3, 0, 1}, 0, 0}};
  std::vector<TimedPiece> whole{
      pieces[0], {begin + 4000, begin + 5000, {6, 3, 0}, {}, -1, 0}, pieces[1]};
  const Track all(&bodies, {2, 3, 0}, whole);
  const Track rest(&bodies, {2, 3, 0}, whole, kNever, begin + 1000);
  for (Ticks t = begin + 1000; t < begin + 12000; t += 170) {
    const Track::Sight a = all.at(t), b = rest.at(t);
    CHECK(a.frame.x == doctest::Approx(b.frame.x));
    CHECK(a.frame.y == doctest::Approx(b.frame.y));
    const Circle around = rest.around(t, t + 50);
    CHECK(std::hypot(around.x - b.centre().x, around.y - b.centre().y) <= around.r);
  }
  const Mover standing{&bodies[0], Frame(Pose{5, 3, 0}), {}, begin + 1000.0, 9000.0};
  const double when = meeting<false>(all, begin, kNever, standing, 0.01);
  CHECK(when > begin + 1000);
  CHECK(meeting<false>(rest, begin, kNever, standing, 0.01) == doctest::Approx(when));
}

TEST_CASE("a tail ends in the nearest rest that is free for ever") {
  Hall h;
  // The middle one is nearer, but there the other robot stands.
  const Tail tail =
      h.planner.plan(from(0, kWest, {to({5, 4.5, 0}, 1000)}, {kCentre, kEast}), h.budget);
  REQUIRE(tail.tour.outcome == TourResult::Outcome::kFound);
  CHECK(tail.rest == 1);
  REQUIRE(tail.tour.stops.size() == 1);
  CHECK(tail.tour.stops[0].leave - tail.tour.stops[0].arrive == 1000);
  CHECK(tail.tour.pieces.back().start.x == doctest::Approx(kEast.x));
}

TEST_CASE("a tail that is not found leaves the robot to what it does") {
  Hall h;
  const Tail tail = h.planner.plan(from(0, kWest, {to(kCentre)}, {kWest}), h.budget);
  CHECK(tail.tour.outcome == TourResult::Outcome::kExhausted);
  // It is still there for the other one.
  const Tail other = h.planner.plan(from(1, kCentre, {to(kWest)}, {kEast}), h.budget);
  CHECK(other.tour.outcome == TourResult::Outcome::kExhausted);
}

TEST_CASE("a new tail replaces the old one at once") {
  Hall h;
  REQUIRE(h.planner.plan(from(1, kCentre, {}, {kEast}), h.budget).rest == 0);
  // The place that the other one has left is free for good, once it has left.
  const Tail tail = h.planner.plan(from(0, kWest, {}, {kCentre}), h.budget);
  REQUIRE(tail.rest == 0);
  CHECK(h.planner.settled(0) == tail.tour.arrival);
  // Going on from there, it now meets the other one at its new rest.
  const std::vector<TimedPiece> on{{0, 6000, kCentre, {6, 0, 0}, 0, 0}};
  const std::vector<TailMeeting> met = h.planner.meetings(0, on, -30000);
  REQUIRE(met.size() == 1);
  CHECK(met[0].robot == 1);
  CHECK(met[0].at.x == doctest::Approx(kEast.x - 1.0).epsilon(0.01));
}

TEST_CASE("motion is clear of what stands until it is not") {
  Hall h;
  REQUIRE(h.planner.plan(from(1, kCentre, {}, {kEast}), h.budget).rest == 0);
  Obstacles wall = h.walls;
  wall.segments.push_back({{11, 0}, {11, 6}});
  const auto statics = std::make_shared<const Statics>(wall, 1.0);
  const Ticks until = h.planner.clear_until(1, 0, {statics, statics});
  CHECK(until > 0);
  CHECK(until < h.planner.settled(1));
  CHECK(h.planner.clear_until(0, 0, {statics, statics}) == kNever);
}
