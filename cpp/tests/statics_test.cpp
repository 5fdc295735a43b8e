#include "clearway/space/statics.hpp"

#include <doctest/doctest.h>

#include "clearway/space/traffic.hpp"
#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

namespace {

bool inside(Point p, const std::vector<Point>& polygon) {
  bool in = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
  }
  return in;
}

// True distance from a point to what stands there; 0 inside solids and outside the bounds.
double true_clearance(const Obstacles& o, Point p) {
  double least = 1e300;
  for (const auto& solid : o.solids) {
    if (inside(p, solid)) return 0.0;
  }
  if (!o.bounds.empty() && !inside(p, o.bounds)) return 0.0;
  for (const Segment& s : o.segments) least = std::min(least, to_segment(p, s.p, s.q));
  for (const Circle& c : o.discs) least = std::min(least, std::hypot(p.x - c.x, p.y - c.y) - c.r);
  return std::max(0.0, least);
}

// Signed gap of a placed body to all of it, asked of every obstacle in turn.
double every_gap(const Obstacles& o, const Body& body, const Frame& f) {
  double least = 1e300;
  for (const Segment& s : o.segments) least = std::min(least, gap(body, f, s));
  for (const Circle& c : o.discs) least = std::min(least, gap(body, f, c));
  return least;
}

// True distance of a placed body to the nearest edge or disc, 0 where it touches one.
double true_distance(const Obstacles& o, const Body& body, const Frame& f) {
  double least = 1e300;
  for (const Segment& s : o.segments) {
    if (body.parts().empty()) least = std::min(least, gap(body, f, s));
    for (const Convex& part : body.parts()) {
      least = std::min(least, true_gap(placed(part.vertices(), f), {s.p, s.q}));
    }
  }
  for (const Circle& c : o.discs) least = std::min(least, gap(body, f, c));
  return std::max(0.0, least);
}

// A hall in the shape of an L, a U-shaped shelf, a triangle, a free wall and two pillars.
Obstacles cluttered() {
  Obstacles o = hall({{0, 0}, {20, 0}, {20, 8}, {12, 8}, {12, 14}, {0, 14}});
  add_solid(o, {{3, 3}, {7, 3}, {7, 7}, {6, 7}, {6, 4}, {4, 4}, {4, 7}, {3, 7}});
  add_solid(o, {{14, 2}, {17, 3}, {15, 5}});
  o.segments.push_back({{8.5, 9.0}, {11.5, 12.0}});
  o.discs.push_back({9.5, 2.5, 0.8});
  o.discs.push_back({2.0, 11.0, 0.3});
  return o;
}

double least_on_the_way(const Obstacles& o, const Body& body, const Frame& start,
                        const Twist& motion, double spacing) {
  const double travel = motion.length() + std::abs(motion.c) * body.circumradius();
  const int samples = std::max(1, static_cast<int>(std::ceil(travel / spacing)));
  double least = 1e300;
  for (int i = 0; i <= samples; ++i) {
    least = std::min(least, every_gap(o, body, moved(start, motion.part(1.0 * i / samples))));
  }
  return least;
}

}  // namespace

TEST_CASE("The field never promises more room than there is, and not much less") {
  const Obstacles o = cluttered();
  const Statics statics(o, 1.5);
  Dice dice(41);
  int compared = 0;
  for (int i = 0; i < 40000; ++i) {
    const Point p{dice.between(0, 20), dice.between(0, 14)};
    const double told = statics.clearance(p.x, p.y), truth = true_clearance(o, p);
    CHECK(told <= truth + 1e-9);
    CHECK(told <= statics.saturation() + 1e-9);
    if (truth < statics.saturation()) {
      // Cells of 0.1 m lose twice half a diagonal, 256 steps of 4 m lose 0.016 m.
      CHECK(told >= truth - 2.0 * 0.0708 - 0.016);
      ++compared;
    }
  }
  CHECK(compared > 30000);
}

TEST_CASE("There is no room inside solids, outside the bounds or off the map") {
  const Obstacles o = cluttered();
  const Statics statics(o, 1.5);
  Dice dice(42);
  int blocked = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point p{dice.between(-3, 23), dice.between(-3, 17)};
    if (true_clearance(o, p) > 0.0) continue;
    ++blocked;
    CHECK(statics.clearance(p.x, p.y) == 0.0);
  }
  CHECK(blocked > 2000);
  CHECK(statics.clearance(5.0, 5.5) > 0.0);  // between the arms of the U
  CHECK(statics.clearance(std::nan(""), 1.0) == 0.0);
}

TEST_CASE("A body's gap is that to its nearest obstacle, wherever it stands in a bucket") {
  const Obstacles o = cluttered();
  const double reach = 2.0;
  const Statics statics(o, reach);
  Dice dice(43);
  for (const Body& body : {rectangle(2.4, 1.0), forklift(), disc(0.6)}) {
    const double limit = reach + 0.5 - body.circumradius();
    for (int i = 0; i < 3000; ++i) {
      Pose p{dice.between(0, 20), dice.between(0, 14), dice.between(-kPi, kPi)};
      if (i % 3 == 0) p.x = 2.0 * std::floor(p.x / 2.0);  // on the border of a bucket
      if (i % 5 == 0) p.y = 2.0 * std::floor(p.y / 2.0);
      const Frame f(p);
      const double truth = every_gap(o, body, f), told = statics.gap(body, f);
      CHECK(told == doctest::Approx(std::min(truth, limit)));
      // Cover circles promise no more than the body has.
      if (true_clearance(o, {p.x, p.y}) > 0.0) {
        CHECK(statics.cover_gap(body, f) <= true_distance(o, body, f) + 1e-9);
      }
    }
  }
}

TEST_CASE("A motion is clear exactly when dense sampling says so, up to the slack") {
  const Obstacles o = cluttered();
  const Statics statics(o, 2.0);
  Dice dice(44);
  int accepted = 0, refused = 0, close = 0;
  for (const Body& body : {rectangle(2.4, 1.0), forklift(), disc(0.6)}) {
    for (int i = 0; i < 220; ++i) {
      Pose p{dice.between(1, 19), dice.between(1, 13), dice.between(-kPi, kPi)};
      if (true_clearance(o, {p.x, p.y}) < 0.3) continue;
      const Twist motion{dice.between(-1.5, 1.5), i % 3 ? 0.0 : dice.between(-1, 1),
                         i % 4 ? dice.between(-1, 1) : 0.0};
      const double required = i % 2 ? 0.0 : 0.05, slack = step_slack(required);
      const double least = least_on_the_way(o, body, Frame(p), motion, 0.002);
      const bool clear = statics.clear(body, Frame(p), motion, required, slack);
      if (clear) {
        ++accepted;
        CHECK(least >= required - slack / 2 - 1e-6);
        CHECK(least >= -0.001);
      } else {
        ++refused;
        CHECK(least < required + 0.002);
      }
      close += least > required && least < required + 0.3;
    }
  }
  CHECK(accepted > 80);
  CHECK(refused > 80);
  CHECK(close > 40);
}

TEST_CASE("A body may slide along a wall that it touches, not into it") {
  Obstacles o = hall(20, 10);
  const Statics statics(o, 2.0);
  const Body box = rectangle(2.0, 1.0);
  const double slack = step_slack(0.0);
  const Frame along(Pose{3.0, 0.5, 0.0});
  CHECK(statics.gap(box, along) == doctest::Approx(0.0));
  CHECK(statics.clear(box, along, {10.0, 0.0, 0.0}, 0.0, slack));
  CHECK(!statics.clear(box, along, {10.0, -0.002, 0.0}, 0.0, slack));
  CHECK(!statics.clear(box, along, {0.0, 0.0, 0.3}, 0.0, slack));
  CHECK(!statics.clear(box, along, {10.0, 0.0, 0.0}, 0.01, step_slack(0.01)));
}

TEST_CASE("A body fits a passage of its own width, and none a centimetre narrower") {
  const Body box = rectangle(2.0, 1.0);
  for (const double width : {1.0, 0.99}) {
    Obstacles o = hall(20, 10);
    add_solid(o, box_points(5, 0, 15, 4));
    add_solid(o, box_points(5, 4 + width, 15, 10));
    const Statics statics(o, 2.0);
    const Frame mouth(Pose{2.0, 4 + width / 2, 0.0});
    CHECK(statics.clear(box, mouth, {16.0, 0.0, 0.0}, 0.0, step_slack(0.0)) == (width == 1.0));
  }
}

TEST_CASE("No motion jumps a thin wall or a pillar between two clear ends") {
  Obstacles o = hall(20, 10);
  o.segments.push_back({{10, 0}, {10, 9}});
  o.discs.push_back({5, 5, 0.01});
  const Statics statics(o, 2.0);
  const Body box = rectangle(1.0, 0.6);
  CHECK(!statics.clear(box, Frame(Pose{8, 2, 0}), {4.0, 0.0, 0.0}, 0.0, step_slack(0.0)));
  CHECK(!statics.clear(box, Frame(Pose{3, 5, 0}), {4.0, 0.0, 0.0}, 0.0, step_slack(0.0)));
  CHECK(statics.clear(box, Frame(Pose{3, 6, 0}), {4.0, 0.0, 0.0}, 0.0, step_slack(0.0)));
}

TEST_CASE("Two sharp corners do not slip past each other through one another") {
  // The lower corner of a diamond passes 1.5 mm below the upper one of another: 1.1 mm deep for 3
  // mm of the way. Steps of 0.8 mm must meet that from wherever they begin.
  const Body diamond = kite(4, 0.5, 0.0);
  Obstacles o = hall(20, 10);
  add_solid(o, {{10, 4.5}, {10.5, 5}, {10, 5.5}, {9.5, 5}});
  const Statics statics(o, 1.0);
  Dice dice(46);
  for (int i = 0; i < 300; ++i) {
    const double x = dice.between(7.0, 9.0);
    const Twist past{dice.between(3.2, 4.0), 0.0, 0.0};
    CHECK(!statics.clear(diamond, Frame(Pose{x, 6.0 - 0.0015, 0}), past, 0.0, step_slack(0.0)));
    CHECK(statics.clear(diamond, Frame(Pose{x, 6.0, 0}), past, 0.0, step_slack(0.0)));
  }
}

TEST_CASE("A bay in the shape of a U takes a body that fits between its arms") {
  const Obstacles o = cluttered();
  const Statics statics(o, 2.0);
  const double slack = step_slack(0.0);
  const Body narrow = rectangle(1.2, 1.6), wide = rectangle(1.2, 2.1);
  const Frame above(Pose{5.0, 9.0, -kPi / 2});
  CHECK(statics.clear(narrow, above, {4.2, 0.0, 0.0}, 0.0, slack));   // nose at 4.2
  CHECK(!statics.clear(narrow, above, {4.5, 0.0, 0.0}, 0.0, slack));  // nose at 3.9: bottom is 4
  CHECK(!statics.clear(wide, above, {4.2, 0.0, 0.0}, 0.0, slack));    // arms are 2 apart
}

TEST_CASE("A site without extent is refused") {
  Obstacles o;
  CHECK_THROWS_AS(Statics(o, 1.0), std::invalid_argument);
}

TEST_CASE("On a site of a square kilometre the field is coarser and still a lower bound") {
  Obstacles o = hall(1000, 1000);
  add_solid(o, {{400, 400}, {600, 420}, {580, 600}});
  const Statics statics(o, 2.0);
  Dice dice(45);
  for (int i = 0; i < 5000; ++i) {
    const Point p{dice.between(390, 610), dice.between(390, 610)};
    CHECK(statics.clearance(p.x, p.y) <= true_clearance(o, p) + 1e-6);
  }
}
