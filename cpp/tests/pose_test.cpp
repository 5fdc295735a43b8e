#include "clearway/geometry/pose.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using scenes::kPi;

namespace {

void check_same(const Pose& a, const Pose& b, double tolerance) {
  CHECK(std::abs(a.x - b.x) < tolerance);
  CHECK(std::abs(a.y - b.y) < tolerance);
  CHECK(std::abs(wrap(a.theta - b.theta)) < tolerance);
}

}  // namespace

TEST_CASE("A quarter turn to the left on radius 2 ends two ahead and two to the left") {
  // The arc is as long as 2 * pi / 2 = pi.
  check_same(displacement({kPi, 0.0, kPi / 2}), {2.0, 2.0, kPi / 2}, 1e-12);
  // Backwards round the same centre the heading falls.
  check_same(displacement({-kPi, 0.0, -kPi / 2}), {-2.0, 2.0, -kPi / 2}, 1e-12);
}

TEST_CASE("A sideways quarter turn is the forward one seen from the side") {
  // Travel along +y while turning left: forward is now -x of the travel direction's left.
  check_same(displacement({0.0, kPi, kPi / 2}), {-2.0, 2.0, kPi / 2}, 1e-12);
}

TEST_CASE("Turning on the spot moves nothing, driving straight turns nothing") {
  check_same(displacement({0.0, 0.0, 1.25}), {0.0, 0.0, 1.25}, 1e-15);
  check_same(displacement({3.0, -1.0, 0.0}), {3.0, -1.0, 0.0}, 1e-15);
  CHECK(Twist{0.0, 0.0, 1.25}.length() == 0.0);
  CHECK(Twist{3.0, -4.0, 1.25}.length() == doctest::Approx(5.0));
}

TEST_CASE("A tiny turn bends a motion a tiny bit, without a jump where formulas change") {
  for (double c = 1e-13; c < 1e-3; c *= 1.07) {
    for (const double turn : {c, -c}) {
      // To first order: (a - b c / 2, b + a c / 2).
      const Pose p = displacement({10.0, 4.0, turn});
      CHECK(std::abs(p.x - (10.0 - 2.0 * turn)) < 1e-7 + 10.0 * c * c);
      CHECK(std::abs(p.y - (4.0 + 5.0 * turn)) < 1e-7 + 10.0 * c * c);
      const Frame f = moved(Frame(Pose{}), Twist{10.0, 4.0, turn});
      CHECK(std::abs(f.x - p.x) < 1e-12);
      CHECK(std::abs(f.y - p.y) < 1e-12);
    }
  }
}

TEST_CASE("A twist is what many small steps along the body's own axes add up to") {
  scenes::Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    const Pose start = dice.pose(5.0);
    const Twist twist{dice.between(-3, 3), dice.between(-3, 3), dice.between(-4, 4)};
    const int steps = 4000;
    double x = start.x, y = start.y;
    for (int k = 0; k < steps; ++k) {
      const double heading = start.theta + twist.c * (k + 0.5) / steps;
      x += (std::cos(heading) * twist.a - std::sin(heading) * twist.b) / steps;
      y += (std::sin(heading) * twist.a + std::cos(heading) * twist.b) / steps;
    }
    check_same(moved(start, twist), {x, y, start.theta + twist.c}, 1e-5);
  }
}

TEST_CASE("Two halves of a twist are the whole, for poses and frames alike") {
  scenes::Dice dice(2);
  for (int i = 0; i < 200; ++i) {
    const Pose start = dice.pose(5.0);
    const Twist twist{dice.between(-3, 3), dice.between(-3, 3), dice.between(-4, 4)};
    const Pose whole = moved(start, twist);
    check_same(moved(moved(start, twist.part(0.5)), twist.part(0.5)), whole, 1e-9);
    const Frame f = moved(Frame(start), twist);
    CHECK(std::abs(f.x - whole.x) < 1e-9);
    CHECK(std::abs(f.y - whole.y) < 1e-9);
    CHECK(std::abs(f.c - std::cos(whole.theta)) < 1e-9);
    CHECK(std::abs(f.s - std::sin(whole.theta)) < 1e-9);
  }
}

TEST_CASE("Going into a frame and out of it again changes no point") {
  scenes::Dice dice(3);
  for (int i = 0; i < 200; ++i) {
    const Frame f(dice.pose(9.0));
    const Point p{dice.between(-5, 5), dice.between(-5, 5)};
    const Point back = f.to_world(f.to_local(p));
    CHECK(std::abs(back.x - p.x) < 1e-12);
    CHECK(std::abs(back.y - p.y) < 1e-12);
  }
}

TEST_CASE("A frame seen from another carries points straight across, and back by its inverse") {
  scenes::Dice dice(4);
  for (int i = 0; i < 200; ++i) {
    const Frame a(dice.pose(9.0)), b(dice.pose(9.0));
    const Point p{dice.between(-5, 5), dice.between(-5, 5)};
    const Point seen = relative(a, b).to_world(p), expected = a.to_local(b.to_world(p));
    CHECK(std::abs(seen.x - expected.x) < 1e-12);
    CHECK(std::abs(seen.y - expected.y) < 1e-12);
    const Point back = inverse(relative(a, b)).to_world(seen);
    CHECK(std::abs(back.x - p.x) < 1e-12);
    CHECK(std::abs(back.y - p.y) < 1e-12);
  }
}

TEST_CASE("Angles wrap to half a turn either way") {
  CHECK(wrap(1.5 * kPi) == doctest::Approx(-0.5 * kPi));
  CHECK(wrap(-1.5 * kPi) == doctest::Approx(0.5 * kPi));
  CHECK(wrap(0.3 + 8.0 * kPi) == doctest::Approx(0.3));
}
