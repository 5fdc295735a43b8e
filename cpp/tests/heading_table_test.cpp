#include "clearway/search/heading_table.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

TEST_CASE("Headings go round from the one asked for in even steps") {
  const std::vector<Body> bodies{rectangle(1, 1)};
  for (const double theta : {0.0, 0.1, -2.0, 3.1, -kPi, kPi, 1e-12, -1e-12}) {
    const HeadingTable table(rover_table(16), bodies, theta);
    CHECK(table.headings() == 16);
    const int k = table.index(theta);
    CHECK(std::abs(wrap(table.theta(k) - theta)) < 1e-9);
    for (int i = 0; i < 16; ++i) {
      CHECK(table.index(table.theta(i)) == i);
      CHECK(table.index(table.theta(i) + kTau) == i);
      CHECK(table.index(table.theta(i) - kTau + 0.15) == i);  // half a step is 0.196
      CHECK(table.frame(1, 2, i).c == doctest::Approx(std::cos(table.theta(i))));
      CHECK(table.frame(1, 2, i).s == doctest::Approx(std::sin(table.theta(i))));
    }
  }
}

TEST_CASE("A primitive lands where its motion ends, on a heading of the table") {
  const std::vector<Body> bodies{rectangle(1, 1)};
  const MotionTable motions = car_table(16);
  const HeadingTable table(motions, bodies, 0.3);
  for (int k = 0; k < 16; ++k) {
    for (std::size_t i = 0; i < motions.primitives.size(); ++i) {
      const Pose end = moved(Pose{0, 0, table.theta(k)}, motions.primitives[i].twist);
      const HeadingTable::Landing& landing = table.landing(k, i);
      CHECK(std::abs(landing.dx - end.x) < 1e-12);
      CHECK(std::abs(landing.dy - end.y) < 1e-12);
      CHECK(std::abs(wrap(table.theta(landing.k) - end.theta)) < 1e-9);
    }
  }
}

TEST_CASE("What the discs of a motion call clear is clear") {
  Obstacles o = hall(12, 12);
  add_solid(o, {{4, 4}, {7, 5}, {5, 8}});
  o.discs.push_back({9, 3, 0.5});
  const std::vector<Body> bodies{rectangle(1.6, 0.8), forklift()};
  const Statics statics(o, 2.0);
  const MotionTable motions = car_table(16);
  const HeadingTable table(motions, bodies, 0.3);
  Dice dice(81);
  int sure = 0;
  for (int i = 0; i < 6000; ++i) {
    const double x = dice.between(0, 12), y = dice.between(0, 12);
    const int k = dice.below(16), body = dice.below(2);
    const auto p = static_cast<std::size_t>(dice.below(6));
    if (!table.surely_clear(statics, body, x, y, k, p, 0.05)) continue;
    ++sure;
    const Body& b = bodies[static_cast<std::size_t>(body)];
    CHECK(statics.clear(b, table.frame(x, y, k), motions.primitives[p].twist, 0.05, 0.0008));
  }
  CHECK(sure > 1000);
}

TEST_CASE("The table of connections says about what a connection costs") {
  const MotionTable motions = car_table(16);
  ConnectTable table(motions, Objective{});
  Dice dice(82);
  std::vector<Shot> shots;
  int close = 0;
  const int asked = 500;
  for (int i = 0; i < asked; ++i) {
    const Pose from{dice.between(-8, 8), dice.between(-8, 8), dice.between(-kPi, kPi)};
    connect(motions, Objective{}, from, {}, 1, shots);
    // Half a cell and half a heading step off: some 0.3 m and 0.1 rad of 1.5 m, at 1 m/s. Some
    // curves grow by jumps.
    close += std::abs(table(from.x, from.y, from.theta) - shots[0].cost) < 700.0;
  }
  CHECK(close > 0.95 * asked);
  CHECK(table(30.0, 0.0, 0.0) < 0.0);
}

TEST_CASE("Connections cost the same mirrored, and driven backwards where speeds are equal") {
  Dice dice(83);
  for (const bool slow_reverse : {false, true}) {
    MotionTable motions = car_table(16);
    if (slow_reverse) {
      motions.connections[0].reverse_speed = motions.connections[0].reverse_arc_speed = 0.25;
    }
    ConnectTable table(motions, Objective{});
    for (int i = 0; i < 300; ++i) {
      const double x = dice.between(-8, 8), y = dice.between(-8, 8), turn = dice.between(-kPi, kPi);
      CHECK(table(x, y, turn) == table(x, -y, -turn));
      if (!slow_reverse) CHECK(table(x, y, turn) == table(-x, y, -turn));
    }
    // 6 m straight ahead of the goal means 6 m backwards: 6 s, or 24 s at a quarter of the speed.
    CHECK(std::abs(table(6.0, 0.0, 0.0) - (slow_reverse ? 24000.0 : 6000.0)) <
          (slow_reverse ? 6000 : 700));
  }
}
