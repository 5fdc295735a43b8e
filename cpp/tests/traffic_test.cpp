#include "clearway/space/traffic.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

namespace {

// A random ride with reversals, arcs, turns on the spot and waits, gap-free from tick 0.
std::vector<TimedPiece> ride(Dice& dice, const Pose& start, int pieces, bool loads) {
  std::vector<TimedPiece> out;
  Pose at = start;
  Ticks t = 0;
  for (int i = 0; i < pieces; ++i) {
    const int body = loads && i > pieces / 2 ? 1 : 0;
    const auto duration = static_cast<Ticks>(dice.between(200, 1500));
    switch (dice.below(4)) {
      case 0:
        out.push_back(wait(t, t + duration, at, body));
        break;
      case 1:
        out.push_back(drive(t, t + duration, at, {0.0, 0.0, dice.between(-1.5, 1.5)}, body));
        break;
      default: {
        const double way = dice.below(2) ? 1.0 : -1.0;
        out.push_back(
            drive(t, t + duration, at,
                  {way * duration / 1000.0, 0.0, dice.below(2) ? dice.between(-1, 1) : 0.0}, body));
      }
    }
    t += duration;
    at = moved(at, out.back().twist);
  }
  return out;
}

std::vector<Body> empty_and_loaded() { return {rectangle(1.2, 0.8), rectangle(1.6, 1.4)}; }

}  // namespace

TEST_CASE("A track is where its pieces say, through cusps, waits and a change of load") {
  const std::vector<Body> bodies = empty_and_loaded();
  Dice dice(51);
  for (int i = 0; i < 40; ++i) {
    const Pose start = dice.pose(10.0);
    const auto pieces = ride(dice, start, 14, i % 2);
    const Track track(&bodies, start, pieces);
    for (int k = 0; k < 500; ++k) {
      const double t = dice.between(0.0, pieces.back().end + 2000.0);
      const Pose expected = pose_at(start, pieces, t);
      const Track::Sight seen = track.at(t);
      CHECK(std::abs(seen.frame.x - expected.x) < 1e-9);
      CHECK(std::abs(seen.frame.y - expected.y) < 1e-9);
      CHECK(std::abs(seen.frame.c - std::cos(expected.theta)) < 1e-9);
      CHECK(std::abs(seen.frame.s - std::sin(expected.theta)) < 1e-9);
      int body = pieces.back().body;
      for (const TimedPiece& p : pieces) {
        if (t >= p.begin && t < p.end) body = p.body;
      }
      CHECK(seen.body == &bodies[static_cast<std::size_t>(body)]);
      CHECK(seen.until > t);
    }
    CHECK(track.at(kNever).frame.x ==
          doctest::Approx(moved(pieces.back().start, pieces.back().twist).x));
  }
}

TEST_CASE("At a border between pieces the later one begins") {
  const std::vector<Body> bodies = empty_and_loaded();
  const Track track(
      &bodies, {0, 0, 0},
      {drive(0, 1000, {0, 0, 0}, {1, 0, 0}, 0), drive(1000, 2000, {1, 0, 0}, {-1, 0, 0}, 1)});
  CHECK(track.at(1000).frame.x == doctest::Approx(1.0));
  CHECK(track.at(999.999).body == &bodies[0]);
  CHECK(track.at(1000).body == &bodies[1]);
  CHECK(track.at(2000).frame.x == doctest::Approx(0.0));
  CHECK(track.settled() == 2000);
}

TEST_CASE("A robot without pieces stands at its start; waiting at the end changes nothing") {
  const std::vector<Body> bodies = empty_and_loaded();
  const Track still(&bodies, {3, 4, 0.5}, {});
  CHECK(still.settled() == 0);
  CHECK(still.at(12345).frame.x == 3.0);
  CHECK(still.at(0).body == &bodies[0]);
  const Track track(&bodies, {0, 0, 0},
                    {drive(0, 1000, {0, 0, 0}, {1, 0, 0}), wait(1000, 5000, {1, 0, 0})});
  CHECK(track.settled() == 1000);
  CHECK(track.at(3000).frame.x == 1.0);
}

TEST_CASE("No body point of a track is faster than its speed") {
  const std::vector<Body> bodies{rectangle(2.0, 2.0)};
  // Half a turn a second at circumradius root 2, and 1 m: 1 + pi / 2 * root 2 per 1000 ticks.
  const Track track(&bodies, {0, 0, 0}, {drive(0, 1000, {0, 0, 0}, {1, 0, kPi / 2})});
  CHECK(track.speed() == doctest::Approx((1.0 + kPi / 2 * std::sqrt(2.0)) / 1000.0));
}

TEST_CASE("A conflict is found exactly when dense sampling finds one, up to the slack") {
  const std::vector<Body> bodies = empty_and_loaded();
  const std::vector<Body> movers{rectangle(1.4, 0.7), disc(0.5), forklift()};
  const Box box{0, 0, 12, 12};
  Dice dice(52);
  int met = 0, clear = 0, grazed = 0;
  for (int i = 0; i < 1500; ++i) {
    const Pose start = dice.pose(6.0);
    Traffic traffic(box, 2.0, 2.0, 0.1);
    const auto track =
        std::make_shared<const Track>(&bodies, start, ride(dice, start, 6, i % 3 == 0));
    traffic.insert(0, track);
    const Body& body = movers[static_cast<std::size_t>(i % 3)];
    const double duration = std::floor(dice.between(300, 2000));
    const Twist twist = i % 4 == 0 ? Twist{} : Twist{dice.between(-2, 2), 0.0, dice.between(-1, 1)};
    const Mover mover{&body, Frame(dice.pose(6.0)), twist, std::floor(dice.between(0, 4000)),
                      duration};
    const double required = i % 2 ? 0.0 : 0.05, slack = step_slack(required);
    double last_clear = -1.0;
    const double when = traffic.first_conflict({0, 0, kNever}, mover, required, &last_clear);
    // Dense sampling up to the conflict, or to the end.
    double least = 1e300;
    const auto gap_at = [&](double t) {
      const Track::Sight s = track->at(t);
      const Frame self = moved(mover.start, twist.part((t - mover.begin) / duration));
      return gap(body, self, *s.body, s.frame, kFar);
    };
    for (double t = mover.begin; t <= mover.begin + duration; t += 1.0) {
      if (when >= 0.0 && t >= when) break;
      least = std::min(least, gap_at(t));
    }
    if (when < 0.0) {
      ++clear;
      CHECK(least >= required - slack - 1e-6);
      CHECK(least >= -0.001);
    } else {
      ++met;
      CHECK(when >= mover.begin);
      CHECK(when <= mover.begin + duration);
      CHECK(gap_at(when) < required);
      CHECK(least >= required - slack - 1e-6);  // none was missed before
      CHECK(last_clear <= when);
      if (when > mover.begin) {
        CHECK(last_clear < when);
        CHECK(gap_at(last_clear) >= required - 1e-6);
      }
    }
    grazed += std::abs(least - required) < 0.1;
  }
  CHECK(met > 200);
  CHECK(clear > 200);
  CHECK(grazed > 100);
}

TEST_CASE("Two bodies that touch while one slides past do not conflict") {
  const std::vector<Body> bodies{rectangle(2.0, 1.0)};
  Traffic traffic({0, 0, 20, 20}, 2.0, 2.0, 0.0);
  traffic.insert(0,
                 std::make_shared<const Track>(&bodies, Pose{5, 5, 0}, std::vector<TimedPiece>{}));
  const Mover past{&bodies[0], Frame(Pose{2, 6, 0}), {6, 0, 0}, 0, 6000};
  CHECK(traffic.first_conflict({0, 0, kNever}, past, 0.0) < 0.0);
  const Mover scraping{&bodies[0], Frame(Pose{2, 5.998, 0}), {6, 0, 0}, 0, 6000};
  // Noses meet when 1 m is driven.
  CHECK(traffic.first_conflict({0, 0, kNever}, scraping, 0.0) ==
        doctest::Approx(1000).epsilon(0.01));
}

TEST_CASE("Two sharp corners that pass do not slip through one another") {
  // As with things at rest: 1.5 mm of overlap are 1.1 mm deep, for 1.5 ticks at 2 m/s.
  const std::vector<Body> bodies{kite(4, 0.5, 0.0)};
  Dice dice(56);
  for (int i = 0; i < 300; ++i) {
    const double x = dice.between(7.0, 9.0);
    Traffic traffic({0, 0, 20, 20}, 1.0, 4.0, 0.0);
    traffic.insert(0, std::make_shared<const Track>(
                          &bodies, Pose{x, 6.0, 0},
                          std::vector<TimedPiece>{drive(0, 2000, {x, 6, 0}, {2, 0, 0})}));
    const Mover deep{&bodies[0], Frame(Pose{10.5, 5.0015, kPi}), {2, 0, 0}, 0, 2000};
    const Mover clear{&bodies[0], Frame(Pose{10.5, 5.0, kPi}), {2, 0, 0}, 0, 2000};
    CHECK(traffic.first_conflict({0, 0, kNever}, deep, 0.0) >= 0.0);
    CHECK(traffic.first_conflict({0, 0, kNever}, clear, 0.0) < 0.0);
  }
}

TEST_CASE("A load that sticks out is met only once it is there") {
  const std::vector<Body> bodies{rectangle(1.0, 1.0), rectangle(1.0, 3.0)};
  Traffic traffic({0, 0, 20, 20}, 3.0, 2.0, 0.0);
  traffic.insert(
      0, std::make_shared<const Track>(
             &bodies, Pose{5, 5, 0},
             std::vector<TimedPiece>{wait(0, 3000, {5, 5, 0}, 0), wait(3000, 4000, {5, 5, 0}, 1),
                                     drive(4000, 9000, {5, 5, 0}, {5, 0, 0}, 1)}));
  const Mover beside{&bodies[0], Frame(Pose{5, 6.2, 0}), {}, 0, 20000};
  CHECK(traffic.first_conflict({0, 0, kNever}, beside, 0.0) == doctest::Approx(3000));
  const Mover brief{&bodies[0], Frame(Pose{5, 6.2, 0}), {}, 0, 2999};
  CHECK(traffic.first_conflict({0, 0, kNever}, brief, 0.0) < 0.0);
}

TEST_CASE("Whoever stands in the way is told when he is clear") {
  const std::vector<Body> bodies{rectangle(2.0, 1.0)};
  Traffic traffic({0, 0, 40, 20}, 2.0, 2.0, 0.0);
  // Passes x = 10 at 1 m/s: its nose from tick 4000 on, its tail (half 1 + half 1) until 8000.
  traffic.insert(0, std::make_shared<const Track>(
                        &bodies, Pose{4, 5, 0},
                        std::vector<TimedPiece>{drive(0, 20000, {4, 5, 0}, {20, 0, 0})}));
  const Frame here(Pose{10, 5, 0});
  const Ticks clear = traffic.clear_after(0, bodies[0], here, 5000, 0.0);
  CHECK(clear >= 8000);
  CHECK(clear <= 8000 + 50);
  // Somebody who comes to rest in the way is never clear, somebody who vanishes is, then.
  traffic.insert(1,
                 std::make_shared<const Track>(&bodies, Pose{10, 5, 0}, std::vector<TimedPiece>{}));
  CHECK(traffic.clear_after(1, bodies[0], here, 100, 0.0) >= kNever);
  traffic.insert(
      2, std::make_shared<const Track>(&bodies, Pose{10, 5, 0}, std::vector<TimedPiece>{}, 7000));
  CHECK(traffic.clear_after(2, bodies[0], here, 100, 0.0) == 7000);
}

TEST_CASE("Clear means clear: never a tick at which bodies still overlap") {
  const std::vector<Body> bodies = empty_and_loaded();
  const Body own = rectangle(1.4, 0.7);
  Dice dice(53);
  int asked = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose start = dice.pose(5.0);
    Traffic traffic({0, 0, 12, 12}, 2.0, 2.0, 0.1);
    const auto track = std::make_shared<const Track>(&bodies, start, ride(dice, start, 8, i % 2));
    traffic.insert(0, track);
    const Frame here(dice.pose(5.0));
    const auto gap_at = [&](Ticks t) {
      const Track::Sight s = track->at(t);
      return gap(own, here, *s.body, s.frame, kFar);
    };
    for (Ticks t = 0; t < track->settled(); t += 97) {
      if (gap_at(t) >= 0.02) continue;
      ++asked;
      const Ticks clear = traffic.clear_after(0, own, here, t, 0.02);
      if (clear >= kNever) {
        CHECK(gap_at(track->settled()) < 0.02);
      } else {
        CHECK(clear > t);
        CHECK(gap_at(clear) >= 0.02 - 1e-9);
        // Steps of 100 ticks may pass over short gaps, not over long ones.
        int free = 0;
        for (Ticks between = t; between < clear - 110; ++between) {
          free = gap_at(between) >= 0.02 ? free + 1 : 0;
          CHECK(free <= 110);
          if (free > 110) break;
        }
      }
    }
  }
  CHECK(asked > 1000);
}

TEST_CASE("Tiles never hide a track that a mover can run into") {
  const std::vector<Body> bodies = empty_and_loaded();
  const Body own = rectangle(1.4, 0.7);
  const double reach = 3.0, required = 0.05;
  Dice dice(54);
  int met = 0;
  for (int round = 0; round < 12; ++round) {
    Traffic traffic({0, 0, 20, 20}, bodies[1].circumradius(), reach, required);
    std::vector<std::shared_ptr<const Track>> tracks;
    for (int id = 0; id < 6; ++id) {
      const Pose start{dice.between(2, 18), dice.between(2, 18), dice.between(-kPi, kPi)};
      tracks.push_back(
          std::make_shared<const Track>(&bodies, start, ride(dice, start, 10, id % 2)));
      traffic.insert(id, tracks.back());
    }
    for (int i = 0; i < 500; ++i) {
      const Pose p{dice.between(0, 20), dice.between(0, 20), dice.between(-kPi, kPi)};
      const Twist twist{dice.between(-reach, reach), 0.0, dice.between(-1, 1)};
      const Mover mover{&own, Frame(p), twist, std::floor(dice.between(0, 12000)), 3000};
      for (int id = 0; id < 6; ++id) {
        const double when = traffic.first_conflict({id, 0, kNever}, mover, required);
        double told = -1.0;
        for (const Traffic::Presence& who : traffic.near(p.x, p.y)) {
          if (who.track != id) continue;
          const double t = traffic.first_conflict(who, mover, required);
          if (t >= 0.0 && (told < 0.0 || t < told)) told = t;
        }
        // Windows begin at other ticks, so that grazes may be seen by one and not the other.
        double least = 1e300;
        for (double t = mover.begin; t <= mover.begin + mover.duration; t += 4.0) {
          const Track::Sight s = tracks[static_cast<std::size_t>(id)]->at(t);
          const Frame self = moved(mover.start, twist.part((t - mover.begin) / mover.duration));
          if (std::hypot(self.x - s.frame.x, self.y - s.frame.y) > 3.0) continue;
          least = std::min(least, gap(own, self, *s.body, s.frame, kFar));
        }
        if (least < required - step_slack(required)) {
          CHECK(told >= 0.0);
          CHECK(when >= 0.0);
          ++met;
        }
        if (told >= 0.0) CHECK(least < required + 0.005);
      }
    }
  }
  CHECK(met > 300);
}

TEST_CASE("What is taken out is gone from every tile, and nobody else is") {
  const std::vector<Body> bodies = empty_and_loaded();
  Dice dice(55);
  Traffic traffic({0, 0, 20, 20}, 2.0, 1.0, 0.1);
  CHECK(traffic.empty());
  const auto count = [&](int id) {
    int found = 0;
    for (double x = 1.25; x < 20; x += 2.5) {
      for (double y = 1.25; y < 20; y += 2.5) {
        for (const auto& who : traffic.near(x, y)) found += who.track == id;
      }
    }
    return found;
  };
  for (const int id : {4, 0, 9}) {
    const Pose start{dice.between(2, 18), dice.between(2, 18), 0};
    traffic.insert(id, std::make_shared<const Track>(&bodies, start, ride(dice, start, 10, false)));
  }
  CHECK(traffic.has(4));
  CHECK(!traffic.has(3));
  CHECK(!traffic.has(100));
  const int others = count(0) + count(9);
  CHECK(count(4) > 0);
  traffic.remove(4);
  CHECK(!traffic.has(4));
  CHECK(count(4) == 0);
  CHECK(count(0) + count(9) == others);
  CHECK(!traffic.empty());
  traffic.remove(0);
  traffic.remove(9);
  CHECK(traffic.empty());
}

TEST_CASE("After it is gone nobody meets a track") {
  const std::vector<Body> bodies{rectangle(2.0, 1.0)};
  Traffic traffic({0, 0, 20, 20}, 2.0, 2.0, 0.0);
  traffic.insert(
      0, std::make_shared<const Track>(&bodies, Pose{5, 5, 0}, std::vector<TimedPiece>{}, 3000));
  bool early = false, late = false;
  for (const auto& who : traffic.near(5, 5)) {
    const Mover before{&bodies[0], Frame(Pose{5, 5, 0}), {}, 2000, 500};
    const Mover after{&bodies[0], Frame(Pose{5, 5, 0}), {}, 3001, 500};
    early = early || traffic.first_conflict(who, before, 0.0) >= 0.0;
    late = late || traffic.first_conflict(who, after, 0.0) >= 0.0;
  }
  CHECK(early);
  CHECK(!late);
}

TEST_CASE("A conservative step can lose half its slack, never a millimetre of contact") {
  for (const double required : {0.0, 0.0005, 0.01, 0.05, 0.3}) {
    CHECK(required - step_slack(required) / 2 >= -0.0005);
    CHECK(step_slack(required) > 0.0);
  }
}

TEST_CASE("The circle around a track holds its body all the while") {
  const std::vector<Body> bodies{Body({box_points(-0.3, -0.4, 1.9, 0.5)}, 0.0), forklift()};
  Dice dice(57);
  for (int i = 0; i < 60; ++i) {
    const Pose start = dice.pose(10.0);
    const Track track(&bodies, start, ride(dice, start, 10, i % 2));
    for (int k = 0; k < 40; ++k) {
      // Every fourth time just when it has come to rest.
      const double begin =
          k % 4 ? dice.between(0.0, track.settled()) : track.settled() + dice.between(0.0, 100.0);
      const double end = begin + dice.between(0.0, k % 8 < 5 ? 100.0 : 3000.0);
      const Circle around = track.around(begin, end);
      double furthest = 0.0;
      for (int n = 0; n <= 60; ++n) {
        const Track::Sight seen = track.at(begin + (end - begin) * n / 60.0);
        for (const Convex& part : seen.body->parts()) {
          for (const Point& p : placed(part.vertices(), seen.frame)) {
            furthest = std::max(furthest, std::hypot(p.x - around.x, p.y - around.y));
          }
        }
      }
      CHECK(furthest <= around.r + 1e-9);
    }
  }
}

TEST_CASE("The circle around a mover holds its body all the while") {
  const std::vector<Body> bodies{Body({box_points(-0.3, -0.4, 1.9, 0.5)}, 0.0), forklift(),
                                 disc(0.4)};
  Dice dice(58);
  for (int i = 0; i < 600; ++i) {
    const Body& body = bodies[static_cast<std::size_t>(i % 3)];
    const Twist twist{dice.between(-3, 3), dice.between(-1, 1), dice.between(-kPi, kPi)};
    const Mover mover{&body, Frame(dice.pose(10.0)), twist, 0.0, 1000.0};
    const Circle around = mover.around();
    double furthest = 0.0;
    for (int n = 0; n <= 60; ++n) {
      const Frame f = moved(mover.start, twist.part(n / 60.0));
      if (body.parts().empty()) {
        furthest = std::max(furthest, std::hypot(f.x - around.x, f.y - around.y) + body.disc());
      }
      for (const Convex& part : body.parts()) {
        for (const Point& p : placed(part.vertices(), f)) {
          furthest = std::max(furthest, std::hypot(p.x - around.x, p.y - around.y));
        }
      }
    }
    CHECK(furthest <= around.r + 1e-9);
  }
}

TEST_CASE("A track is never near before it is told that it may be") {
  const std::vector<Body> bodies{Body({box_points(-0.3, -0.4, 1.9, 0.5)}, 0.0), forklift()};
  Dice dice(59);
  int near = 0, never = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose start = dice.pose(6.0);
    const Track track(&bodies, start, ride(dice, start, 10, i % 2));
    for (int k = 0; k < 40; ++k) {
      const double from = dice.between(0.0, track.settled() + 500.0);
      const double to = k % 4 ? from + dice.between(0.0, 5000.0) : kNever;
      const double apart = dice.between(0.0, 1.0);
      const Point p{dice.between(-2, 8), dice.between(-2, 8)};
      const double told = track.may_be_near(from, to, p, apart);
      CHECK(told >= from);
      never += told > to;
      for (double t = from; t <= std::min(to, track.settled() + 500.0); t += 9.0) {
        const Track::Sight seen = track.at(t);
        if (true_gap(*seen.body, seen.frame, disc(1e-9), Frame(Pose{p.x, p.y, 0})) > apart)
          continue;
        ++near;
        CHECK(told <= t);
        break;
      }
    }
  }
  CHECK(near > 200);
  CHECK(never > 200);
}

TEST_CASE("Who is as near as asked about is told of at once") {
  const std::vector<Body> bodies{disc(0.4), disc(0.4)};
  Dice dice(60);
  for (int i = 0; i < 3000; ++i) {
    const Pose start = dice.pose(6.0);
    const Track track(&bodies, start, ride(dice, start, 4, i % 2));
    const double when = dice.between(0.0, track.settled() + 500.0);
    const Track::Sight seen = track.at(when);
    const Point p{dice.between(-2, 8), dice.between(-2, 8)};
    const double apart = std::hypot(seen.frame.x - p.x, seen.frame.y - p.y) - 0.4;
    CHECK(track.may_be_near(when, when, p, apart + 1e-9) == when);
  }
}

TEST_CASE("Whoever stands between the ends and the middle of a drive is met") {
  const std::vector<Body> bodies{disc(0.2)};
  const Body block = rectangle(1.0, 0.6), bar = rectangle(2.0, 0.2);
  const auto met = [&](const Pose& at, const Mover& mover) {
    Traffic traffic({0, 0, 20, 20}, 2.0, 8.0, 0.0);
    traffic.insert(0, std::make_shared<const Track>(&bodies, at, std::vector<TimedPiece>{}));
    return traffic.first_conflict({0, 0, kNever}, mover, 0.0);
  };
  // 8 m along x from x = 1: the nose, 0.5 m ahead, meets a disc's edge 0.2 m before its centre.
  const Mover along{&block, Frame(Pose{1, 5, 0}), {8, 0, 0}, 0, 8000};
  CHECK(met({3, 5, 0}, along) == doctest::Approx(1300).epsilon(0.001));
  CHECK(met({5, 5, 0}, along) == doctest::Approx(3300).epsilon(0.001));
  CHECK(met({7, 5, 0}, along) == doctest::Approx(5300).epsilon(0.001));
  CHECK(met({7, 5.51, 0}, along) < 0.0);  // 0.3 + 0.2 beside its line, and a centimetre
  // Half a turn on the spot: a bar 0.1 m to either side comes within 0.2 m of a centre 0.8 m away
  // at 60 degrees when it is at 60 - asin(0.3 / 0.8) = 37.98 of the 180 degrees.
  const Mover turning{&bar, Frame(Pose{5, 5, 0}), {0, 0, kPi}, 0, 3000};
  const Pose beside{5 + 0.8 * std::cos(kPi / 3), 5 + 0.8 * std::sin(kPi / 3), 0};
  CHECK(
      met(beside, turning) ==
      doctest::Approx(3000.0 * (60.0 - std::asin(0.3 / 0.8) * 180.0 / kPi) / 180.0).epsilon(0.002));
}

TEST_CASE("Somebody who crosses is met in the middle of a drive that begins and ends clear") {
  // Both at 1 m/s; the crosser's centre is on the line when the mover's is 4 m on its way.
  const std::vector<Body> bodies{rectangle(1.0, 0.6)};
  Traffic traffic({0, 0, 20, 20}, 2.0, 8.0, 0.0);
  traffic.insert(0, std::make_shared<const Track>(
                        &bodies, Pose{5, 1, kPi / 2},
                        std::vector<TimedPiece>{drive(0, 8000, {5, 1, kPi / 2}, {8, 0, 0})}));
  // Seen along x its front is at 1.5 + t and the crosser's side at 4.7: 3.2 s; along y the
  // crosser's front is at 1.5 + t and its own side at 4.7: 3.2 s as well.
  const Mover at_once{&bodies[0], Frame(Pose{1, 5, 0}), {8, 0, 0}, 0, 8000};
  CHECK(traffic.first_conflict({0, 0, kNever}, at_once, 0.0) ==
        doctest::Approx(3200).epsilon(0.001));
  // 1.6 s later its front reaches the line's side when the crosser's tail (at t + 0.5) leaves it.
  const Mover late{&bodies[0], Frame(Pose{1, 5, 0}), {8, 0, 0}, 1610, 8000};
  CHECK(traffic.first_conflict({0, 0, kNever}, late, 0.0) < 0.0);
}

TEST_CASE("Bodies that stand in exact contact do not conflict, and the question ends") {
  const std::vector<Body> bodies{rectangle(2.0, 1.0), rectangle(2.0, 1.0)};
  const Body& body = bodies[0];
  const std::vector<std::vector<TimedPiece>> others{
      {},
      {wait(0, 4000, {5, 5, 0}, 0), wait(4000, 8000, {5, 5, 0}, 1)},
      {wait(0, 4000, {5, 5, 0}), drive(4000, 6000, {5, 5, 0}, {2, 0, 0})},
      {drive(0, 2000, {3, 5, 0}, {2, 0, 0})}};
  for (const auto& pieces : others) {
    Traffic traffic({0, 0, 20, 20}, 2.0, 2.0, 0.1);
    const Pose start = pieces.empty() ? Pose{5, 5, 0} : pieces.front().start;
    traffic.insert(0, std::make_shared<const Track>(&bodies, start, pieces));
    for (const double required : {0.0, 0.01, 0.1}) {
      for (const double begin : {2000.0, 2500.5}) {
        const Mover beside{&body, Frame(Pose{5, 6 + required, 0}), {}, begin, kNever - begin};
        double last_clear = -1.0;
        CHECK(traffic.first_conflict({0, 0, kNever}, beside, required, &last_clear) < 0.0);
        CHECK(last_clear == kNever);
      }
    }
  }
}
