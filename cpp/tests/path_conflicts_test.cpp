#include "clearway/multi/path_conflicts.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

namespace {

// A ride from a side of a room into it, with arcs, turns, waits and reversals in it.
std::vector<TimedPiece> ride(Dice& dice, const Pose& start, Ticks begin, int body) {
  std::vector<TimedPiece> out;
  Ticks t = begin;
  Pose at = start;
  if (begin > 0) out.push_back(wait(0, begin, at, body));
  for (int i = 0; i < 8; ++i) {
    const auto duration = static_cast<Ticks>(dice.between(300, 2500));
    const double way = i == 0 ? 3.0 : (dice.below(3) ? 1.0 : -1.0) * duration / 1000.0;
    if (dice.below(5) == 0) out.push_back(wait(t, t + duration, at, body));
    if (dice.below(5) == 0) {
      t = out.empty() ? t : out.back().end;
      out.push_back(drive(t, t + duration, at, {0.0, 0.0, dice.between(-1.5, 1.5)}, body));
    } else {
      t = out.empty() ? t : out.back().end;
      out.push_back(drive(t, t + duration, at, {way, 0.0, dice.between(-1.0, 1.0)}, body));
    }
    t = out.back().end;
    at = moved(at, out.back().twist);
  }
  return out;
}

bool forbidden(const std::vector<Passage>& waits, Ticks own, Ticks other) {
  return std::any_of(waits.begin(), waits.end(),
                     [&](const Passage& p) { return own > p.at && other < p.passed; });
}

}  // namespace

TEST_CASE("What two robots wait for keeps their bodies apart at all pairs of ticks") {
  const std::vector<Body> bodies = {forklift(), disc(0.6), rectangle(1.2, 0.8)};
  Dice dice(7);
  int met = 0, touching = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose here{-5.0, dice.between(-1.0, 1.0), 0.0}, there{5.0, dice.between(-1.0, 1.0), kPi};
    const int body_a = dice.below(3), body_b = dice.below(3);
    const auto pieces_a = ride(dice, here, 0, body_a);
    const auto pieces_b = ride(dice, there, static_cast<Ticks>(dice.between(1, 9000)), body_b);
    const CommittedPath a(bodies, here, pieces_a, 0.5), b(bodies, there, pieces_b, 0.5);
    const PathConflicts found = path_conflicts(a, 0, b, 0, PathParams{});
    const Ticks last = std::max(pieces_a.back().end, pieces_b.back().end);
    if (found.meeting >= 0) {
      ++met;
      const Pose pa = pose_at(here, pieces_a, found.meeting);
      const Pose pb = pose_at(there, pieces_b, found.meeting);
      CHECK(true_gap(bodies[static_cast<std::size_t>(body_a)], Frame(pa),
                     bodies[static_cast<std::size_t>(body_b)], Frame(pb)) < 0.001);
      continue;
    }
    for (const auto* waits : {&found.first, &found.second}) {
      for (const Passage& p : *waits) CHECK(p.passed <= p.at);
    }
    for (Ticks ta = 0; ta <= last; ta += 97) {
      const Frame fa(pose_at(here, pieces_a, ta));
      for (Ticks tb = 0; tb <= last; tb += 89) {
        const Frame fb(pose_at(there, pieces_b, tb));
        const bool held = forbidden(found.first, ta, tb) || forbidden(found.second, tb, ta);
        const double apart = std::hypot(fa.x - fb.x, fa.y - fb.y);
        const double gap = apart > 5.0 ? apart
                                       : true_gap(bodies[static_cast<std::size_t>(body_a)], fa,
                                                  bodies[static_cast<std::size_t>(body_b)], fb);
        if (gap < -0.002) {
          ++touching;
          CHECK(held);
        }
      }
    }
  }
  CHECK(met > 5);
  CHECK(met < 50);
  CHECK(touching > 1000);
}

TEST_CASE("Ways that pass each other in contact with nobody need no order") {
  const std::vector<Body> bodies = {rectangle(1.0, 1.0)};
  const Pose here{-5.0, 0.0, 0.0}, there{5.0, 1.1, kPi};
  const CommittedPath a(bodies, here, {drive(0, 10000, here, {10.0, 0.0, 0.0})}, 0.5);
  const CommittedPath b(bodies, there, {drive(0, 10000, there, {10.0, 0.0, 0.0})}, 0.5);
  const PathConflicts found = path_conflicts(a, 0, b, 0, PathParams{});
  CHECK(found.first.empty());
  CHECK(found.second.empty());
  CHECK(found.meeting < 0);
  PathParams wide;
  wide.margin = 0.2;  // more than there is
  CHECK(!path_conflicts(a, 0, b, 0, wide).first.empty());
}

TEST_CASE("Stretches overlap where some tick of each has bodies in each other") {
  const std::vector<Body> bodies = {disc(0.5)};
  const Pose here{-5.0, 0.0, 0.0}, there{0.0, -5.0, kPi / 2};
  const CommittedPath a(bodies, here, {drive(0, 10000, here, {10.0, 0.0, 0.0})}, 0.5);
  const CommittedPath b(bodies, there, {drive(0, 10000, there, {10.0, 0.0, 0.0})}, 0.5);
  CHECK(!paths_overlap(a, 0, 3900, b, 0, 5000));
  CHECK(paths_overlap(a, 0, 4100, b, 0, 5000));
  CHECK(paths_overlap(a, 5000, 5000, b, 5000, 5000));
  CHECK(!paths_overlap(a, 6100, 10000, b, 5000, 5000));
  CHECK(paths_overlap(b, 20000, 30000, b, 10000, 10000));
}
