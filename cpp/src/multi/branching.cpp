#include "clearway/multi/branching.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

constexpr Ticks kBefore = 100;    // a stretch of a long drive begins so long before a meeting,
constexpr Ticks kLongest = 3000;  // and is at most so long
constexpr Ticks kLook = 20;       // between looks at two robots that meet
constexpr Ticks kLongestMeeting = 10'000;
constexpr int kMoments = 9;       // of a meeting that are tried
constexpr double kCloser = 1e-6;  // than required, in all doubt (m)
constexpr double kFinest = 1e-6;  // of looking for a point (m)

// What a robot does at some moment.
struct Act {
  enum class Kind { kMotion, kStand, kRest } kind;
  int leg;
  std::int32_t node, motion;
  Slot from, to;
};

// The point that lies deepest in both of two bodies, or nearest to both, and how far outside; with
// more care until it is within `near`.
double deepest(const Body& a, const Frame& fa, const Body& b, const Frame& fb, double near,
               Point* where) {
  const auto outside = [&](Point p) {
    const Circle c{p.x, p.y, 0.0};
    return std::max(gap(a, fa, c), gap(b, fb, c));
  };
  const Point ca = fa.to_world({a.bound().x, a.bound().y});
  const Point cb = fb.to_world({b.bound().x, b.bound().y});
  Point best{0.5 * (ca.x + cb.x), 0.5 * (ca.y + cb.y)};
  double least = outside(best);
  for (double step = 0.5 * std::max(a.bound().r, b.bound().r);
       step > (least > near ? kFinest : 0.005);) {
    bool better = false;
    for (int k = 0; k < 8; ++k) {
      const double angle = kTau / 8.0 * k;
      const Point p{best.x + step * std::cos(angle), best.y + step * std::sin(angle)};
      const double value = outside(p);
      if (value < least - 1e-9) {
        least = value;
        best = p;
        better = true;
      }
    }
    if (!better) step *= 0.5;
  }
  *where = best;
  return least;
}

Act act_at(const Route& route, double tick, Ticks slot_length) {
  const double slot = tick / slot_length;
  Slot since = 0;
  for (const Move& move : route.moves) {
    if (slot < move.depart) {
      return {Act::Kind::kStand, move.leg, move.node, -1, since, move.depart - 1};
    }
    if (slot <= move.arrive) {
      return {Act::Kind::kMotion, move.leg, move.node, move.motion, move.depart, move.arrive};
    }
    since = move.arrive;
  }
  return {Act::Kind::kRest, -1, -1, -1, route.rest, kEver};
}

// The steady stretch that a motion drives at some tick: from a little before to the end of its
// step, and when it begins.
Stretch stretch_at(const Routing& r, int robot, const Act& act, double tick, Ticks* begin) {
  Lattice& lattice = r.searches[static_cast<std::size_t>(robot)]->lattice(act.leg);
  const Lattice::Way way = lattice.way(act.node, static_cast<std::size_t>(act.motion));
  Pose at = lattice.pose(act.node);
  Ticks t = act.from * r.slot;
  for (std::size_t k = 0; k < way.drive.size; ++k) {
    const Step& step = way.drive.steps[k];
    if (tick <= t + step.duration && step.mode >= 0) {
      const Ticks first = std::clamp(static_cast<Ticks>(tick) - kBefore, t, t + step.duration - 1);
      const bool whole = act.motion < static_cast<std::int32_t>(lattice.num_primitives());
      const Ticks from = whole ? t : first;
      const Ticks until = whole ? t + step.duration : std::min(t + step.duration, from + kLongest);
      const double duration = step.duration;
      const Pose start = moved(at, step.twist.part((from - t) / duration));
      *begin = from;
      return {step.mode,
              {start.x, start.y, wrap(start.theta)},
              step.twist.part((until - from) / duration),
              until - from};
    }
    at = moved(at, step.twist);
    t += step.duration;
  }
  *begin = act.from * r.slot + way.drive.duration;
  return {-1, lattice.leg().goal, {}, act.to * r.slot - *begin};
}

TimedPiece piece_of(const Routing& r, int robot, const Act& act, const Stretch& stretch,
                    Ticks begin) {
  const int body =
      r.team->agent(static_cast<std::size_t>(robot)).legs[static_cast<std::size_t>(act.leg)].body;
  return {begin, begin + std::max(1, stretch.duration), stretch.start, stretch.twist, stretch.mode,
          body};
}

// Whether two stretches meet when they begin at these ticks.
bool clash(const Routing& r, int robot_a, const Act& a, const Stretch& way_a, Ticks begin_a,
           int robot_b, const Act& b, const Stretch& way_b, Ticks begin_b) {
  if (robot_a > robot_b) return clash(r, robot_b, b, way_b, begin_b, robot_a, a, way_a, begin_a);
  const Ticks earlier = std::min(begin_a, begin_b);
  const TimedPiece p = piece_of(r, robot_a, a, way_a, begin_a - earlier);
  const TimedPiece q = piece_of(r, robot_b, b, way_b, begin_b - earlier);
  const Track track(&r.team->model(static_cast<std::size_t>(robot_b)).bodies, q.start, {q}, q.end);
  const double required =
      r.team->required(static_cast<std::size_t>(robot_a))[static_cast<std::size_t>(robot_b)];
  const auto& bodies = r.team->model(static_cast<std::size_t>(robot_a)).bodies;
  const Mover mover{&bodies[static_cast<std::size_t>(p.body)], Frame(p.start), p.twist,
                    static_cast<double>(p.begin), static_cast<double>(p.end - p.begin)};
  return meeting<true>(track, q.begin, q.end, mover, required) >= 0.0;
}

// At one moment of the meeting, one robot or the other must be away from a point that both cover.
// Of some moments that is taken which delays the one that is delayed less the most.
bool part_at_point(const Routing& r, const Meeting& met, const Route& route_a, const Route& route_b,
                   Rule& rule_a, Rule& rule_b) {
  const auto ia = static_cast<std::size_t>(met.a), ib = static_cast<std::size_t>(met.b);
  const Track &a = *route_a.track, &b = *route_b.track;
  const double required = r.team->required(ia)[ib];
  const double near = 0.5 * required - kCloser;
  const auto first = static_cast<Ticks>(std::ceil(met.tick));
  const auto apart = [&](Ticks t) {
    const Track::Sight x = a.at(t), y = b.at(t);
    return gap(*x.body, x.frame, *y.body, y.frame, required + 1.0) >= required;
  };
  Ticks last = first;
  while (last < first + kLongestMeeting && !apart(last + kLook)) last += kLook;
  double best = 0.0;
  for (int i = 0; i < kMoments; ++i) {
    const Ticks t = first + (last - first) * i / (kMoments - 1);
    const Track::Sight x = a.at(t), y = b.at(t);
    Point p;
    if (deepest(*x.body, x.frame, *y.body, y.frame, near, &p) > near) continue;
    const auto since = [&](const Track& track) {
      Ticks back = 0;
      while (back < kLongestMeeting && t - back > 0) {
        const Track::Sight s = track.at(t - back - kLook);
        if (gap(*s.body, s.frame, Circle{p.x, p.y, 0.0}) > near) break;
        back += kLook;
      }
      return back;
    };
    const double wait_a = since(a), wait_b = since(b);
    const double worth = 1.0 + std::min(wait_a, wait_b) + 0.1 * std::max(wait_a, wait_b);
    if (worth <= best) continue;
    best = worth;
    rule_a = Rule{};
    rule_a.kind = Rule::Kind::kPoint;
    rule_a.from = t;
    rule_a.point = p;
    rule_a.gap = near;
    rule_b = rule_a;
  }
  return best > 0.0;
}

}  // namespace

// First tick at which two routes meet; negative if never. The same for (a, b) and (b, a).
double first_meeting(const Routing& routing, const Route& a, int robot_a, const Route& b,
                     int robot_b) {
  if (robot_a > robot_b) return first_meeting(routing, b, robot_b, a, robot_a);
  const double required =
      routing.team->required(static_cast<std::size_t>(robot_a))[static_cast<std::size_t>(robot_b)];
  const Track& track = *b.track;
  const auto& bodies = routing.team->model(static_cast<std::size_t>(robot_a)).bodies;
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    const TimedPiece& p = a.pieces[i];
    const bool at_rest = i + 1 == a.pieces.size();
    const Ticks end = at_rest ? std::max(p.end, track.settled()) + 1 : p.end;
    const Mover mover{&bodies[static_cast<std::size_t>(p.body)], Frame(p.start), p.twist,
                      static_cast<double>(p.begin), static_cast<double>(end - p.begin)};
    const Circle mine = mover.around(), other = track.around(p.begin, end);
    const double apart = mine.r + other.r + required;
    if (std::hypot(mine.x - other.x, mine.y - other.y) > apart) continue;
    const double when = meeting<false>(track, 0, kNever, mover, required);
    if (when >= 0.0) return when;
  }
  return -1.0;
}

// Two rules of which every pair of ways that do not meet keeps at least one: whatever the first
// forbids one robot meets whatever the second forbids the other.
Branching branch(const Routing& r, const Meeting& met, const Route& route_a, const Route& route_b) {
  Branching sides;
  Rule &rule_a = sides.rule[0], &rule_b = sides.rule[1];
  const Ticks slot = r.slot;
  const auto ia = static_cast<std::size_t>(met.a), ib = static_cast<std::size_t>(met.b);
  const Act a = act_at(route_a, met.tick, r.slot), b = act_at(route_b, met.tick, r.slot);
  const double required = r.team->required(ia)[ib];
  if (a.kind == Act::Kind::kRest || b.kind == Act::Kind::kRest) {
    // The one at rest comes to rest later, or the other is gone from there by then.
    const bool a_rests =
        a.kind == Act::Kind::kRest && (b.kind != Act::Kind::kRest || a.from <= b.from);
    const std::size_t still = a_rests ? ia : ib;
    const Route& passing = (a_rests ? route_b : route_a);
    const auto when = static_cast<Ticks>(met.tick);
    Ticks clear =
        clear_after(*passing.track, *r.rests[still].body, r.rests[still].at, when, required);
    if (clear >= kNever) clear = when + 1;
    const Ticks last = std::max(when, clear - 1);
    Rule later, gone;
    later.kind = Rule::Kind::kRest;
    later.to = last / slot;
    gone.kind = Rule::Kind::kAvoid;
    gone.other = static_cast<int>(still);
    gone.from = later.to * slot;
    gone.slot = later.to;
    (a_rests ? rule_a : rule_b) = later;
    (a_rests ? rule_b : rule_a) = gone;
    sides.bound[a_rests ? 1 : 0] = true;
    return sides;
  }
  if (part_at_point(r, met, route_a, route_b, rule_a, rule_b)) {
    sides.bound[1] = true;
    return sides;
  }
  const auto stand_off = [](const Act& act, Slot from, Slot to) {
    Rule rule;
    rule.kind = Rule::Kind::kStand;
    rule.leg = act.leg;
    rule.node = act.node;
    rule.from = from;
    rule.to = to;
    return rule;
  };
  const auto set_out_later = [](const Act& act, const Stretch& stretch, Ticks from, Ticks to) {
    Rule rule;
    rule.kind = Rule::Kind::kMotion;
    rule.leg = act.leg;
    rule.stretch = stretch;
    rule.from = from;
    rule.to = to;
    return rule;
  };
  if (a.kind == Act::Kind::kStand && b.kind == Act::Kind::kStand) {
    const auto at = static_cast<Slot>(met.tick / slot);
    rule_a = stand_off(a, at, at);
    rule_b = stand_off(b, at, at);
    return sides;
  }
  Ticks begin_a = 0, begin_b = 0;
  Stretch way_a, way_b;
  if (a.kind == Act::Kind::kMotion) way_a = stretch_at(r, met.a, a, met.tick, &begin_a);
  if (b.kind == Act::Kind::kMotion) way_b = stretch_at(r, met.b, b, met.tick, &begin_b);
  if (a.kind == Act::Kind::kMotion && b.kind == Act::Kind::kMotion) {
    Ticks more_a = 0, more_b = 0;
    while (clash(r, met.a, a, way_a, begin_a + more_a + slot, met.b, b, way_b, begin_b)) {
      more_a += slot;
    }
    while (clash(r, met.a, a, way_a, begin_a, met.b, b, way_b, begin_b + more_b + slot)) {
      more_b += slot;
    }
    rule_a = set_out_later(a, way_a, begin_a, begin_a + more_a);
    rule_b = set_out_later(b, way_b, begin_b, begin_b + more_b);
    return sides;
  }
  // One stands where the other passes during [in, out): half of the delay is asked of each.
  const bool a_stands = a.kind == Act::Kind::kStand;
  const Act& standing = a_stands ? a : b;
  const Act& driving = a_stands ? b : a;
  const Stretch& way = a_stands ? way_b : way_a;
  const Ticks begin = a_stands ? begin_b : begin_a;
  const std::size_t still = a_stands ? ia : ib, other = a_stands ? ib : ia;
  const TimedPiece piece = piece_of(r, static_cast<int>(other), driving, way, begin);
  const Track track(&r.team->model(other).bodies, piece.start, {piece}, piece.end);
  const Lattice& lattice = r.searches[still]->lattice(standing.leg);
  const Ticks when = std::clamp(static_cast<Ticks>(met.tick), begin, piece.end - 1);
  const Ticks clear =
      clear_after(track, lattice.body(), lattice.frame(standing.node), when, required, piece.end);
  const Slot in = when / slot;
  const Slot out = std::max(in + 1, std::min(clear, piece.end) / slot);
  const Slot left = std::min(out, standing.to + 1);
  const Slot delay = std::max(0, (left - 1 - in) / 2);
  (a_stands ? rule_a : rule_b) = stand_off(standing, in + delay, out - 1);
  (a_stands ? rule_b : rule_a) = set_out_later(driving, way, begin, begin + delay * slot);
  return sides;
}

double point_gap(const Routing& r, int robot, int other, double gap) {
  return r.team->required(static_cast<std::size_t>(robot))[static_cast<std::size_t>(other)] - gap -
         2.0 * kCloser;
}

Rule opposite(Rule rule) {
  if (rule.kind == Rule::Kind::kAvoid) {
    rule.kind = Rule::Kind::kRest;
    rule.to = rule.slot;
  }
  rule.must = true;
  return rule;
}

}  // namespace clearway
