#include "clearway/geometry/body.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using scenes::kFar;
using scenes::kPi;

namespace {

Frame at(double x, double y, double theta = 0.0) { return Frame(Pose{x, y, theta}); }

}  // namespace

TEST_CASE("Rectangles side by side are as far apart as their facing edges") {
  const Body a = scenes::rectangle(2.0, 1.0), b = scenes::rectangle(4.0, 2.0);
  // Half lengths 1 and 2, centres 3.5 apart: 0.5 left.
  CHECK(gap(a, at(0, 0), b, at(3.5, 0.2), kFar) == doctest::Approx(0.5));
  // Half widths 0.5 and 1, centres 1.5 apart: they touch.
  CHECK(gap(a, at(0, 0), b, at(1.0, 1.5), kFar) == doctest::Approx(0.0));
  // A quarter turn swaps length and width: 3.5 - 0.5 - 2 = 1.
  CHECK(gap(a, at(0, 0, kPi / 2), b, at(3.5, 0), kFar) == doctest::Approx(1.0));
}

TEST_CASE("The depth of an overlap is the shortest push that ends it") {
  const Body a = scenes::rectangle(2.0, 1.0);
  // Overlap 0.3 along x and 0.9 along y: pushing 0.3 is enough.
  CHECK(gap(a, at(0, 0), a, at(1.7, 0.1), kFar) == doctest::Approx(-0.3));
  CHECK(gap(a, at(0, 0), a, at(0, 0), kFar) == doctest::Approx(-1.0));
}

TEST_CASE("Corner against corner the gap is a lower bound, not below distance over root 2") {
  const Body a = scenes::rectangle(2.0, 2.0);
  // Corners (1, 1) and (4, 5): distance 5, the larger of 3 and 4 along an axis.
  const double corner = gap(a, at(0, 0), a, at(5, 6), kFar);
  CHECK(corner == doctest::Approx(4.0));
  CHECK(scenes::true_gap(a, at(0, 0), a, at(5, 6)) == doctest::Approx(5.0));
}

TEST_CASE("Gaps of convex bodies are exact in depth and never above the distance") {
  scenes::Dice dice(11);
  const std::vector<Body> bodies{scenes::rectangle(2.2, 0.9), scenes::kite(5, 0.8, 0.4),
                                 scenes::kite(3, 1.1, -0.3), scenes::disc(0.6)};
  int overlapping = 0;
  for (int i = 0; i < 4000; ++i) {
    const Body& a = bodies[static_cast<std::size_t>(dice.below(4))];
    const Body& b = bodies[static_cast<std::size_t>(dice.below(4))];
    const Frame fa(dice.pose(2.5)), fb(dice.pose(2.5));
    const double found = gap(a, fa, b, fb, kFar), truth = scenes::true_gap(a, fa, b, fb);
    CHECK(std::abs(found - gap(b, fb, a, fa, kFar)) < 1e-9);
    if (truth < 0.0) {
      ++overlapping;
      CHECK(std::abs(found - truth) < 1e-9);
    } else {
      CHECK(found <= truth + 1e-9);
      CHECK(found >= -1e-9);
    }
  }
  CHECK(overlapping > 500);
}

TEST_CASE("A gap cut short is still a lower bound and at least what was enough") {
  scenes::Dice dice(12);
  const Body a = scenes::rectangle(2.2, 0.9), b = scenes::kite(5, 0.8, 0.4);
  for (int i = 0; i < 2000; ++i) {
    const Frame fa(dice.pose(5.0)), fb(dice.pose(5.0));
    const double whole = gap(a, fa, b, fb, kFar), cut = gap(a, fa, b, fb, 0.3);
    CHECK(cut <= whole + 1e-12);
    if (whole < 0.3) {
      CHECK(cut == doctest::Approx(whole));
    } else {
      CHECK(cut >= 0.3);
    }
  }
}

TEST_CASE("A union is as near as its nearest part") {
  const Body lift = scenes::forklift(), box = scenes::rectangle(0.3, 0.3);
  // Between the forks there is 0.4 of room: a box of 0.3 has 0.05 on either side.
  CHECK(gap(lift, at(0, 0), box, at(-1.2, 0), kFar) == doctest::Approx(0.05));
  CHECK(gap(lift, at(0, 0), box, at(-1.2, 0.1), kFar) == doctest::Approx(-0.05));
  // The forks end at -1.7.
  CHECK(gap(lift, at(0, 0), box, at(-2.0, 0.275), kFar) == doctest::Approx(0.15));
}

TEST_CASE("Discs: centre to centre, and centre to the nearest point of an outline") {
  const Body small = scenes::disc(0.5), box = scenes::rectangle(2.0, 2.0);
  CHECK(gap(small, at(0, 0), scenes::disc(1.0), at(3, 4), kFar) == doctest::Approx(3.5));
  // Corner (1, 1) to (4, 5): 5; exact here, unlike corner against corner.
  CHECK(gap(box, at(0, 0), small, at(4, 5), kFar) == doctest::Approx(4.5));
  CHECK(gap(small, at(0.2, 0), box, at(0, 0), kFar) == doctest::Approx(-0.8 - 0.5));
  CHECK(gap(box, at(0, 0), Circle{4, 5, 0.5}) == doctest::Approx(4.5));
  CHECK(gap(small, at(1, 1), Circle{4, 5, 0.5}) == doctest::Approx(4.0));
}

TEST_CASE("A segment that cuts a body is as deep as the shortest push across") {
  const Body box = scenes::rectangle(4.0, 2.0);
  // A wall along the whole middle: push by half the width.
  CHECK(gap(box, at(0, 0), Segment{{-9, 0}, {9, 0}}) == doctest::Approx(-1.0));
  // The tip of a wall reaches 0.25 into the front.
  CHECK(gap(box, at(0, 0), Segment{{1.75, 0}, {9, 0}}) == doctest::Approx(-0.25));
  CHECK(gap(box, at(0, 0), Segment{{2.0, -5}, {2.0, 5}}) == doctest::Approx(0.0));
  CHECK(gap(box, at(0, 0), Segment{{2.5, -5}, {2.5, 5}}) == doctest::Approx(0.5));
  CHECK(gap(scenes::disc(0.5), at(0, 0), Segment{{3, 4}, {30, 40}}) == doctest::Approx(4.5));
  CHECK(gap(scenes::disc(0.5), at(0, 0), Segment{{-3, 0.2}, {3, 0.2}}) == doctest::Approx(-0.3));
}

TEST_CASE("Gaps to segments are exact in depth and never above the distance") {
  scenes::Dice dice(13);
  const std::vector<Body> bodies{scenes::rectangle(2.2, 0.9), scenes::kite(5, 0.8, 0.4)};
  int cut = 0;
  for (int i = 0; i < 4000; ++i) {
    const Body& body = bodies[static_cast<std::size_t>(dice.below(2))];
    const Frame f(dice.pose(2.0));
    const Segment s{{dice.between(-1, 3), dice.between(-1, 3)},
                    {dice.between(-1, 3), dice.between(-1, 3)}};
    const double found = gap(body, f, s);
    const double truth =
        scenes::true_gap(scenes::placed(body.parts()[0].vertices(), f), {s.p, s.q});
    if (truth < 0.0) {
      ++cut;
      CHECK(std::abs(found - truth) < 1e-9);
    } else {
      CHECK(found <= truth + 1e-9);
      CHECK(found >= -1e-9);
    }
  }
  CHECK(cut > 500);
}

TEST_CASE("A segment without length is a point") {
  const Body box = scenes::rectangle(2.0, 2.0);
  CHECK(gap(box, at(0, 0), Segment{{4, 5}, {4, 5}}) == doctest::Approx(5.0));
  CHECK(gap(box, at(0, 0), Segment{{0.9, 0}, {0.9, 0}}) == doctest::Approx(-0.1));
}

TEST_CASE("Cover circles hold every point of a body") {
  scenes::Dice dice(14);
  for (const Body& body :
       {scenes::rectangle(6.0, 1.0), scenes::rectangle(0.8, 3.0), scenes::forklift(),
        scenes::kite(3, 1.0, 0.5), scenes::kite(12, 1.0, 0.0)}) {
    for (int i = 0; i < 4000; ++i) {
      const Point p{dice.between(-4, 4), dice.between(-4, 4)};
      bool inside = false;
      for (const Convex& part : body.parts()) inside = inside || part.gap(p) <= 0.0;
      if (!inside) continue;
      bool covered = false;
      for (const Circle& c : body.cover()) {
        covered = covered || std::hypot(p.x - c.x, p.y - c.y) <= c.r + 1e-12;
      }
      CHECK(covered);
    }
  }
}

TEST_CASE("Circumradius holds the body, inradius is held by it") {
  const Body box = scenes::rectangle(4.0, 3.0);
  CHECK(box.circumradius() == doctest::Approx(2.5));  // 3-4-5 halved
  CHECK(box.inradius() == doctest::Approx(1.5));
  CHECK(scenes::disc(0.7).circumradius() == 0.7);
  CHECK(scenes::disc(0.7).inradius() == 0.7);
  const Body lift = scenes::forklift();
  CHECK(lift.circumradius() == doctest::Approx(std::hypot(1.7, 0.35)));
  CHECK(lift.inradius() == doctest::Approx(0.5));
  // A body that does not hold its own reference point covers nothing about it.
  CHECK(scenes::kite(4, 0.5, 2.0).inradius() == 0.0);
  CHECK(scenes::kite(4, 0.5, 2.0).circumradius() == doctest::Approx(2.5));
}

TEST_CASE("Repeated corners do no harm") {
  const Body plain = scenes::rectangle(2.0, 1.0);
  const Body doubled({{{-1, -0.5}, {1, -0.5}, {1, -0.5}, {1, 0.5}, {-1, 0.5}}}, 0.0);
  CHECK(gap(doubled, at(0, 0), plain, at(3, 0), kFar) == doctest::Approx(1.0));
  CHECK(gap(doubled, at(0, 0), Segment{{0.9, -5}, {0.9, 5}}) == doctest::Approx(-0.1));
}

TEST_CASE("More corners than a body may have are refused") {
  std::vector<Point> corners;
  for (int i = 0; i < 65; ++i) {
    corners.push_back({std::cos(kTau * i / 65), std::sin(kTau * i / 65)});
  }
  CHECK_THROWS_AS(Body({corners}, 0.0), std::invalid_argument);
  corners.pop_back();
  CHECK(Body({corners}, 0.0).parts()[0].vertices().size() == 64);
}

TEST_CASE("A rectangle is known as one however it lies, and nothing else is") {
  const auto known = [](std::vector<Point> points) {
    return Convex(std::move(points)).rectangle() != nullptr;
  };
  CHECK(known(scenes::box_points(-0.3, -0.4, 1.9, 0.5)));
  CHECK(known({{1, 0}, {3, 1}, {2, 3}, {0, 2}}));
  CHECK(!known({{-1, -1}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}}));  // a corner in a straight side
  CHECK(!known({{0, 0}, {2, 0}, {3, 1}, {1, 1}}));
  CHECK(!known({{0, 0}, {2, 0}, {1.5, 1}, {0.5, 1}}));
  CHECK(!known({{0, 0}, {2, 0}, {1, 1}}));
  const Convex turned({{1, 0}, {3, 1}, {2, 3}, {0, 2}});
  const Rectangle& box = *turned.rectangle();
  CHECK(box.centre.x == doctest::Approx(1.5));
  CHECK(box.centre.y == doctest::Approx(1.5));
  CHECK(box.along == doctest::Approx(std::sqrt(5.0) / 2));
  CHECK(box.across == doctest::Approx(std::sqrt(5.0) / 2));
}

TEST_CASE("Rectangles have the gap that they have as any other polygon") {
  scenes::Dice dice(15);
  int overlapping = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<Body> boxes, polygons;
    for (int k = 0; k < 2; ++k) {
      // Off the reference point and turned, and once more with a corner amid its first side.
      const double x = dice.between(-1, 1), y = dice.between(-1, 1);
      auto points = scenes::placed(
          scenes::box_points(x, y, x + dice.between(0.1, 2), y + dice.between(0.1, 2)),
          at(0, 0, dice.between(-kPi, kPi)));
      boxes.push_back(Body({points}, 0.0));
      points.insert(points.begin() + 1,
                    {(points[0].x + points[1].x) / 2, (points[0].y + points[1].y) / 2});
      polygons.push_back(Body({points}, 0.0));
    }
    REQUIRE(boxes[0].parts()[0].rectangle());
    REQUIRE(!polygons[0].parts()[0].rectangle());
    const Frame fa(dice.pose(3.0)), fb(dice.pose(3.0));
    const double found = gap(boxes[0], fa, boxes[1], fb, kFar);
    CHECK(std::abs(found - gap(polygons[0], fa, polygons[1], fb, kFar)) < 1e-9);
    CHECK(std::abs(found - gap(boxes[0], fa, polygons[1], fb, kFar)) < 1e-9);
    const double truth = scenes::true_gap(boxes[0], fa, boxes[1], fb);
    overlapping += truth < 0.0;
    CHECK((truth < 0.0 ? std::abs(found - truth) < 1e-9 : found <= truth + 1e-9 && found >= -1e-9));
  }
  CHECK(overlapping > 500);
}

TEST_CASE("Along the axis of a separation the two are as far apart as is told") {
  scenes::Dice dice(16);
  const std::vector<Body> bodies{scenes::rectangle(2.2, 0.9), scenes::rectangle(0.5, 1.7),
                                 scenes::kite(5, 0.8, 0.4), scenes::disc(0.6), scenes::disc(0.3)};
  // How far a body reaches along a direction.
  const auto reach = [](const Body& body, const Frame& f, Point axis) {
    double most = body.parts().empty() ? dot(axis, {f.x, f.y}) + body.disc() : -1e300;
    for (const Convex& part : body.parts()) {
      for (const Point& p : scenes::placed(part.vertices(), f)) most = std::max(most, dot(axis, p));
    }
    return most;
  };
  for (int i = 0; i < 4000; ++i) {
    const Body& a = bodies[static_cast<std::size_t>(dice.below(5))];
    const Body& b = bodies[static_cast<std::size_t>(dice.below(5))];
    const Frame fa(dice.pose(4.0)), fb(dice.pose(4.0));
    for_each_separation(a, fa, b, fb, i % 2 ? kFar : 0.3, [&](const Separation& s) {
      CHECK(length(s.axis) == doctest::Approx(1.0));
      const Point back{-s.axis.x, -s.axis.y};
      CHECK(std::abs(-reach(b, fb, back) - reach(a, fa, s.axis) - s.gap) < 1e-9);
    });
  }
}

TEST_CASE("Each pair of parts is told of once") {
  const Body lift = scenes::forklift(), box = scenes::rectangle(0.3, 0.3);
  int pairs = 0;
  double least = kFar;
  for_each_separation(lift, at(0, 0), lift, at(4, 1, 2.0), kFar, [&](const Separation& s) {
    ++pairs;
    least = std::min(least, s.gap);
  });
  CHECK(pairs == 9);
  CHECK(least == gap(lift, at(0, 0), lift, at(4, 1, 2.0), kFar));
  for_each_separation(lift, at(0, 0), box, at(3, 0), kFar, [&](const Separation&) { ++pairs; });
  CHECK(pairs == 12);
}

TEST_CASE("The bounding circle holds all corners and lies where the body does") {
  for (const Body& body :
       {scenes::rectangle(6.0, 1.0), scenes::forklift(), scenes::kite(3, 1.0, 0.5),
        scenes::kite(12, 1.0, -2.0), Body({scenes::box_points(-0.3, -0.4, 1.9, 0.5)}, 0.0)}) {
    const Circle& bound = body.bound();
    for (const Convex& part : body.parts()) {
      for (const Point& p : part.vertices()) {
        CHECK(std::hypot(p.x - bound.x, p.y - bound.y) <= bound.r + 1e-12);
      }
    }
  }
  // From the forks' ends at -1.7 to the front at 0.5, 1 m wide: about (-0.6, 0).
  const Circle lift = scenes::forklift().bound();
  CHECK(lift.x == doctest::Approx(-0.6));
  CHECK(lift.y == doctest::Approx(0.0));
  CHECK(lift.r == doctest::Approx(std::hypot(1.1, 0.5)));
  const Circle box = Body({scenes::box_points(-0.3, -0.4, 1.9, 0.5)}, 0.0).bound();
  CHECK(box.x == doctest::Approx(0.8));
  CHECK(box.y == doctest::Approx(0.05));
  CHECK(box.r == doctest::Approx(std::hypot(1.1, 0.45)));
  const Circle disc = scenes::disc(0.7).bound();
  CHECK(disc.r == 0.7);
}
