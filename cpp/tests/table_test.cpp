#include "clearway/motion/table.hpp"

#include <doctest/doctest.h>

#include <set>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

namespace {

// Everything that holds for each way from one pose to another.
void check_shot(const Shot& shot, const Pose& from, const Pose& to) {
  Pose at = from;
  Ticks total = 0;
  for (const Step& step : shot.steps) {
    at = moved(at, step.twist);
    total += step.duration;
    CHECK(step.duration >= 1);
  }
  CHECK(std::abs(at.x - to.x) < 3e-6);
  CHECK(std::abs(at.y - to.y) < 3e-6);
  CHECK(std::abs(wrap(at.theta - to.theta)) < 1e-6);
  CHECK(shot.duration == total);
}

// Where the turn's centre lies: 1 left of the body, -1 right.
int side(const Twist& t) { return t.c == 0.0 ? 0 : (t.a > 0.0) == (t.c > 0.0) ? 1 : -1; }

MotionTable sideways_table() {
  MotionTable t = car_table();
  t.connections[0].direction = kPi / 2;
  return t;
}

// Goes in any body direction at 2 m/s and turns at 1 rad/s.
MotionTable floating_table(double reverse_speed) {
  MotionTable t = rover_table();
  t.connections[0].family = Family::kTranslate;
  t.connections[0].forward_speed = 2.0;
  t.connections[0].reverse_speed = reverse_speed;
  return t;
}

}  // namespace

TEST_CASE("Seconds become ticks without losing one to rounding") {
  CHECK(to_ticks(0.0) == 0);
  CHECK(to_ticks(0.1) == 100);
  CHECK(to_ticks(0.1 + 0.2) == 300);  // a hair above 0.3
  CHECK(to_ticks(0.3001) == 301);
}

TEST_CASE("Every way ends at its goal, the cheapest first") {
  scenes::Dice dice(31);
  for (const MotionTable& table : {car_table(), rover_table(), sideways_table()}) {
    for (int i = 0; i < 2000; ++i) {
      const Pose from = dice.pose(10.0), to = dice.pose(10.0);
      std::vector<Shot> shots;
      connect(table, Objective{}, from, to, 4, shots);
      REQUIRE(!shots.empty());
      for (std::size_t k = 0; k < shots.size(); ++k) {
        check_shot(shots[k], from, to);
        // Rounding up to ticks may swap equals: at most a tick a step.
        if (k) CHECK(shots[k].cost >= shots[k - 1].cost - 5.0);
      }
    }
  }
}

TEST_CASE("A drive takes its length over its speed, rounded up to ticks") {
  scenes::Dice dice(32);
  MotionTable table = car_table();
  table.connections[0].forward_speed = 2.0;
  table.connections[0].reverse_speed = 0.5;
  table.connections[0].forward_arc_speed = 1.25;
  table.connections[0].reverse_arc_speed = 0.25;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Shot> shots;
    connect(table, Objective{}, dice.pose(10.0), dice.pose(10.0), 3, shots);
    for (const Shot& shot : shots) {
      for (const Step& step : shot.steps) {
        const double speed = step.twist.c == 0.0 ? (step.twist.a > 0.0 ? 2.0 : 0.5)
                                                 : (step.twist.a > 0.0 ? 1.25 : 0.25);
        const double ticks = step.twist.length() / speed * 1000.0;
        CHECK(step.duration >= ticks - 1e-6);
        CHECK(step.duration <= std::max(1.0, ticks + 1.0));
      }
    }
  }
}

TEST_CASE("A mode says which way the body goes and on which side the turn's centre lies") {
  scenes::Dice dice(33);
  std::set<int> seen;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Shot> shots;
    connect(car_table(), Objective{}, dice.pose(8.0), dice.pose(8.0), 6, shots);
    for (const Shot& shot : shots) {
      for (const Step& step : shot.steps) {
        const int turn = side(step.twist);
        const int mode = (step.twist.a > 0.0 ? 0 : 3) + (turn == 0 ? 0 : turn > 0 ? 1 : 2);
        CHECK(step.mode == mode);
        seen.insert(step.mode);
      }
    }
  }
  CHECK(seen.size() == 6);
}

TEST_CASE("A sideways car travels across its body and turns as sharply as along it") {
  std::vector<Shot> shots;
  // 4 m to the left without turning: straight across.
  connect(sideways_table(), Objective{}, {0, 0, 0}, {0, 4, 0}, 1, shots);
  REQUIRE(shots[0].steps.size() == 1);
  CHECK(shots[0].steps[0].mode == kAhead);
  CHECK(shots[0].steps[0].twist.b == doctest::Approx(4.0));
  CHECK(std::abs(shots[0].steps[0].twist.a) < 1e-12);
  scenes::Dice dice(34);
  for (int i = 0; i < 500; ++i) {
    connect(sideways_table(), Objective{}, dice.pose(8.0), dice.pose(8.0), 1, shots);
    for (const Step& step : shots[0].steps) {
      CHECK(std::abs(step.twist.a) < 1e-9);
      if (step.twist.c != 0.0) {
        CHECK(step.twist.length() / std::abs(step.twist.c) == doctest::Approx(1.5));
      }
    }
  }
}

TEST_CASE("Turning on the spot: to the left counter-clockwise, never more than half a turn") {
  scenes::Dice dice(35);
  for (int i = 0; i < 2000; ++i) {
    std::vector<Shot> shots;
    connect(rover_table(), Objective{}, dice.pose(8.0), dice.pose(8.0), 2, shots);
    for (const Shot& shot : shots) {
      for (const Step& step : shot.steps) {
        if (step.twist.length() == 0.0) {
          CHECK(step.mode == (step.twist.c > 0.0 ? kLeft : kRight));
          CHECK(std::abs(step.twist.c) <= kPi + 1e-9);
        } else {
          CHECK(step.mode == (step.twist.a > 0.0 ? kForward : kReverse));
          CHECK(step.twist.c == 0.0);
        }
      }
    }
  }
  std::vector<Shot> shots;
  connect(rover_table(), Objective{}, {1, 1, 0.3}, {1, 1, 0.3 + kPi / 2}, 1, shots);
  // A quarter turn at 1 rad/s: 1570.8 ms, rounded up.
  REQUIRE(shots[0].steps.size() == 1);
  CHECK(shots[0].duration == 1571);
}

TEST_CASE("A speed of zero forbids a direction") {
  scenes::Dice dice(36);
  MotionTable no_reverse = car_table();
  no_reverse.connections[0].reverse_speed = no_reverse.connections[0].reverse_arc_speed = 0.0;
  std::vector<Shot> ahead;
  connect(no_reverse, Objective{}, {0, 0, 0}, {5, 2, 0.5}, 1, ahead);
  CHECK(!ahead.empty());
  MotionTable straight_back_only = car_table();
  straight_back_only.connections[0].reverse_arc_speed = 0.0;
  for (const bool by_time : {true, false}) {
    Objective objective;
    objective.time = by_time;
    for (int i = 0; i < 1000; ++i) {
      const Pose from = dice.pose(10.0), to = dice.pose(10.0);
      std::vector<Shot> shots;
      connect(no_reverse, objective, from, to, 6, shots);
      for (const Shot& shot : shots) {
        for (const Step& step : shot.steps) CHECK(step.twist.a > 0.0);
      }
      connect(straight_back_only, objective, from, to, 6, shots);
      for (const Shot& shot : shots) {
        for (const Step& step : shot.steps) CHECK((step.twist.a > 0.0 || step.twist.c == 0.0));
      }
    }
  }
}

TEST_CASE("Between unlike modes a robot stands while it switches, and nowhere else") {
  scenes::Dice dice(37);
  MotionTable table = car_table();
  table.switch_duration = 700;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Shot> shots;
    connect(table, Objective{}, dice.pose(10.0), dice.pose(10.0), 2, shots);
    for (const Shot& shot : shots) {
      int last = -1;
      bool stood = false;
      for (const Step& step : shot.steps) {
        if (step.mode < 0) {
          CHECK(step.duration == 700);
          CHECK(step.twist.length() == 0.0);
          CHECK(step.twist.c == 0.0);
          CHECK(last >= 0);
          stood = true;
          continue;
        }
        if (last >= 0) CHECK(stood == (step.mode != last));
        last = step.mode;
        stood = false;
      }
      CHECK(!stood);
      CHECK(shot.cost == shot.duration);
    }
  }
}

TEST_CASE("The objective other than time adds lengths, dearer in turns, and changes of mode") {
  Objective objective;
  objective.time = false;
  objective.turning = 2.0;
  objective.mode_switch = 3.0;
  MotionTable table = rover_table();
  table.turn_arm = 0.5;
  CHECK(objective_of(table, objective, {0, {4.0, 0.0, 0.0}, 10}) == doctest::Approx(4.0));
  CHECK(objective_of(table, objective, {0, {4.0, 0.0, 0.1}, 10}) == doctest::Approx(8.0));
  CHECK(objective_of(table, objective, {0, {0.0, 0.0, -1.0}, 10}) == doctest::Approx(1.0));
  std::vector<Shot> shots;
  // Quarter turn (pi/2 * 0.5 * 2), drive 5, no turn at the end: two modes, one change.
  connect(table, objective, {0, 0, 0}, {0, 5, kPi / 2}, 1, shots);
  CHECK(shots[0].cost == doctest::Approx(kPi / 2 + 5.0 + 3.0));
}

TEST_CASE("A slide turns, drives along and slips across, in either order") {
  MotionTable table = rover_table();
  Connection& how = table.connections[0];
  how.family = Family::kSlide;
  how.sideways_speed = 0.5;
  how.left = 4;
  how.right = 5;
  std::vector<Shot> shots;
  // 3 m along at 1 m/s, 2 m to the right at 0.5 m/s.
  connect(table, Objective{}, {1, 1, 0}, {4, -1, 0}, 2, shots);
  REQUIRE(shots.size() == 2);
  for (const Shot& shot : shots) {
    check_shot(shot, {1, 1, 0}, {4, -1, 0});
    CHECK(shot.duration == 7000);
  }
  CHECK(shots[0].steps[0].mode != shots[1].steps[0].mode);
  scenes::Dice dice(38);
  for (int i = 0; i < 500; ++i) {
    const Pose from = dice.pose(10.0), to = dice.pose(10.0);
    connect(table, Objective{}, from, to, 2, shots);
    for (const Shot& shot : shots) {
      check_shot(shot, from, to);
      for (const Step& step : shot.steps) {
        if (step.twist.b != 0.0) CHECK(step.mode == (step.twist.b > 0.0 ? 4 : 5));
        if (step.twist.a != 0.0) CHECK(step.mode == (step.twist.a > 0.0 ? kForward : kReverse));
        if (step.twist.c != 0.0) CHECK(step.mode == (step.twist.c > 0.0 ? kLeft : kRight));
      }
    }
  }
}

TEST_CASE("A translation goes straight and turns before, after or on its way") {
  const MotionTable table = floating_table(2.0);
  std::vector<Shot> shots;
  // 4 m to the left at 2 m/s, a quarter turn at 1 rad/s.
  connect(table, Objective{}, {1, 1, 0}, {1, 5, kPi / 2}, 3, shots);
  REQUIRE(shots.size() == 3);
  REQUIRE(shots[0].steps.size() == 1);
  // An arc of 4 m / (2 sin(pi/4)) * pi/2 = 4.443 m.
  CHECK(shots[0].duration == 2222);
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
    REQUIRE(shots[k].steps.size() == 2);
    CHECK(shots[k].duration == 2000 + 1571);
  }
  CHECK((shots[1].steps[0].twist.c == 0.0) != (shots[2].steps[0].twist.c == 0.0));
  scenes::Dice dice(39);
  for (int i = 0; i < 1000; ++i) {
    const Pose from = dice.pose(10.0), to = dice.pose(10.0);
    connect(table, Objective{}, from, to, 6, shots);
    REQUIRE(shots.size() == 3);
    for (const Shot& shot : shots) {
      check_shot(shot, from, to);
      for (const Step& step : shot.steps) {
        CHECK(step.twist.length() <= 2.0 * step.duration / 1000.0 + 1e-9);
        CHECK(std::abs(step.twist.c) <= step.duration / 1000.0 + 1e-9);
        CHECK(step.mode == (step.twist.length() > 0.0 ? kForward
                            : step.twist.c > 0.0      ? kLeft
                                                      : kRight));
      }
    }
  }
}

TEST_CASE("Of a translation only the part that goes backwards is slowed, or forbidden") {
  std::vector<Shot> shots;
  // 3 m back and 4 m to the side: 0.6 of its speed goes backwards, so 0.5 / 0.6 m/s.
  connect(floating_table(0.5), Objective{}, {0, 0, 0}, {-3, 4, 0}, 1, shots);
  CHECK(shots[0].duration == 6000);
  connect(floating_table(0.5), Objective{}, {0, 0, 0}, {3, 4, 0}, 1, shots);
  CHECK(shots[0].duration == 2500);
  scenes::Dice dice(40);
  for (const bool by_time : {true, false}) {
    Objective objective;
    objective.time = by_time;
    for (int i = 0; i < 1000; ++i) {
      connect(floating_table(0.0), objective, dice.pose(10.0), dice.pose(10.0), 6, shots);
      for (const Shot& shot : shots) {
        for (const Step& step : shot.steps) CHECK(step.twist.a >= -1e-9 * step.twist.length());
      }
    }
  }
  // Straight to the side is not backwards.
  connect(floating_table(0.0), Objective{}, {0, 0, 0}, {0, 4, 0}, 1, shots);
  REQUIRE(!shots.empty());
  CHECK(shots[0].duration == 2000);
}

TEST_CASE("To where it is already a robot need not drive") {
  for (const MotionTable& table : {car_table(), rover_table(), floating_table(1.0)}) {
    std::vector<Shot> shots;
    connect(table, Objective{}, {2, 3, 1}, {2, 3, 1 + kTau}, 1, shots);
    REQUIRE(shots.size() == 1);
    CHECK(shots[0].steps.empty());
    CHECK(shots[0].duration == 0);
    CHECK(shots[0].cost == 0.0);
  }
}

TEST_CASE("The reach of a table is its longest primitive, its step the shortest that travels") {
  CHECK(rover_table().shortest_step() == doctest::Approx(0.5));
  MotionTable mixed = rover_table();
  mixed.primitives[kReverse].twist.a = -0.3;
  CHECK(mixed.shortest_step() == doctest::Approx(0.3));
  CHECK(rover_table().reach() == doctest::Approx(0.5));
  CHECK(car_table().reach() == doctest::Approx(1.5 * kTau / 16));
}
