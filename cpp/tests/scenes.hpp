// Small worlds, bodies and motion tables that the tests share, and a slow, obvious ruler.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "clearway/geometry/body.hpp"
#include "clearway/motion/table.hpp"
#include "clearway/search/tour_search.hpp"
#include "clearway/space/statics.hpp"
#include "clearway/space/traffic.hpp"

namespace scenes {

using namespace clearway;

constexpr double kPi = std::numbers::pi;
constexpr double kFar = 1e9;  // "tell me the gap whatever it is"

// Seeded numbers that are the same with every standard library.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : bits_(seed) {}
  double between(double low, double high) { return low + (high - low) * (bits_() / 4294967296.0); }
  int below(int n) { return static_cast<int>(between(0.0, n)); }
  Pose pose(double size) { return {between(0.0, size), between(0.0, size), between(-kPi, kPi)}; }

 private:
  std::mt19937 bits_;
};

inline std::vector<Point> box_points(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline Body rectangle(double length, double width) {
  return Body({box_points(-length / 2, -width / 2, length / 2, width / 2)}, 0.0);
}

inline Body disc(double radius) { return Body({}, radius); }

// A forklift: a mast 1 m square about the reference point and forks 1.2 m behind it.
inline Body forklift() {
  return Body({box_points(-0.5, -0.5, 0.5, 0.5), box_points(-1.7, 0.2, -0.5, 0.35),
               box_points(-1.7, -0.35, -0.5, -0.2)},
              0.0);
}

// Regular polygon, not centred on the reference point.
inline Body kite(int corners, double radius, double shift) {
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = kTau * i / corners;
    points.push_back({shift + radius * std::cos(angle), radius * std::sin(angle)});
  }
  return Body({points}, 0.0);
}

inline double to_segment(Point p, Point a, Point b) {
  const Point ab = b - a;
  const double square = dot(ab, ab);
  const double t = square > 0.0 ? std::clamp(dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * ab.x, p.y - a.y - t * ab.y);
}

inline std::vector<Point> placed(const std::vector<Point>& points, const Frame& f) {
  std::vector<Point> out;
  for (const Point& p : points) out.push_back(f.to_world(p));
  return out;
}

// Exact signed gap of two convex outlines in world coordinates (an outline of two points is a
// segment): depth along the best edge normal when they overlap, else the nearest pair of edges.
inline double true_gap(const std::vector<Point>& a, const std::vector<Point>& b) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const auto* outline : {&a, &b}) {
    for (std::size_t i = 0; i < outline->size(); ++i) {
      const Point d = (*outline)[(i + 1) % outline->size()] - (*outline)[i];
      const double length = std::hypot(d.x, d.y);
      for (const double side : {1.0, -1.0}) {
        const Point n{side * d.y / length, -side * d.x / length};
        double top = -1e300, bottom = 1e300;
        for (const Point& p : a) top = std::max(top, dot(n, p));
        for (const Point& p : b) bottom = std::min(bottom, dot(n, p));
        deepest = std::max(deepest, bottom - top);
      }
    }
  }
  if (deepest < 0.0) return deepest;
  double nearest = 1e300;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Point a0 = a[i], a1 = a[(i + 1) % a.size()], b0 = b[j], b1 = b[(j + 1) % b.size()];
      nearest = std::min({nearest, to_segment(a0, b0, b1), to_segment(a1, b0, b1),
                          to_segment(b0, a0, a1), to_segment(b1, a0, a1)});
    }
  }
  return nearest;
}

// Signed distance of a point to a convex outline.
inline double true_gap(Point p, const std::vector<Point>& outline) {
  double deepest = -1e300, nearest = 1e300;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = outline[i], b = outline[(i + 1) % outline.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    deepest = std::max(deepest, -cross(b - a, p - a) / length);
    nearest = std::min(nearest, to_segment(p, a, b));
  }
  return deepest < 0.0 ? deepest : nearest;
}

// Exact signed gap of two placed bodies.
inline double true_gap(const Body& a, const Frame& fa, const Body& b, const Frame& fb) {
  if (a.parts().empty() && b.parts().empty()) {
    return std::hypot(fa.x - fb.x, fa.y - fb.y) - a.disc() - b.disc();
  }
  if (a.parts().empty()) return true_gap(b, fb, a, fa);
  double least = 1e300;
  for (const Convex& part : a.parts()) {
    const auto outline = placed(part.vertices(), fa);
    if (b.parts().empty()) {
      least = std::min(least, true_gap(Point{fb.x, fb.y}, outline) - b.disc());
    }
    for (const Convex& other : b.parts()) {
      least = std::min(least, true_gap(outline, placed(other.vertices(), fb)));
    }
  }
  return least;
}

// A hall whose border is a closed polygon, everything else added by hand.
inline Obstacles hall(std::vector<Point> border) {
  Obstacles o;
  o.box = {1e300, 1e300, -1e300, -1e300};
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Point p = border[i];
    o.box = {std::min(o.box.x0, p.x), std::min(o.box.y0, p.y), std::max(o.box.x1, p.x),
             std::max(o.box.y1, p.y)};
    o.segments.push_back({p, border[(i + 1) % border.size()]});
  }
  o.bounds = std::move(border);
  return o;
}

inline Obstacles hall(double width, double height) { return hall(box_points(0, 0, width, height)); }

inline void add_solid(Obstacles& o, std::vector<Point> polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    o.segments.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  }
  o.solids.push_back(std::move(polygon));
}

enum RoverMode { kForward, kReverse, kLeft, kRight };

// Drives straight at 1 m/s both ways and turns on the spot at 1 rad/s.
inline MotionTable rover_table(int headings = 16) {
  MotionTable t;
  t.headings = headings;
  t.top_speed = 1.0;
  t.rest.assign(4, true);
  const double step = kTau / headings;
  t.primitives.push_back({kForward, {0.5, 0.0, 0.0}, 0, 500, ~0ULL});
  t.primitives.push_back({kReverse, {-0.5, 0.0, 0.0}, 0, 500, ~0ULL});
  t.primitives.push_back({kLeft, {0.0, 0.0, step}, 1, to_ticks(step), ~0ULL});
  t.primitives.push_back({kRight, {0.0, 0.0, -step}, -1, to_ticks(step), ~0ULL});
  Connection how;
  how.family = Family::kTurnDriveTurn;
  how.forward_speed = how.reverse_speed = 1.0;
  how.yaw_rate = 1.0;
  how.forward = kForward;
  how.reverse = kReverse;
  how.rotate_left = kLeft;
  how.rotate_right = kRight;
  t.connections.push_back(how);
  return t;
}

enum CarMode { kAhead, kAheadLeft, kAheadRight, kBack, kBackLeft, kBackRight };

// Reeds-Shepp car at 1 m/s both ways.
inline MotionTable car_table(int headings = 16, double radius = 1.5) {
  MotionTable t;
  t.headings = headings;
  t.top_speed = 1.0;
  t.rest.assign(6, true);
  const double step = kTau / headings, length = radius * step;
  for (const int way : {1, -1}) {
    for (const int turn : {0, 1, -1}) {
      // Backwards round a centre on the left the heading falls.
      const int steps = way * turn;
      const int mode = (way > 0 ? 0 : 3) + (turn == 0 ? 0 : turn > 0 ? 1 : 2);
      t.primitives.push_back(
          {mode, {way * length, 0.0, steps * step}, steps, to_ticks(length), ~0ULL});
    }
  }
  Connection how;
  how.family = Family::kReedsShepp;
  how.radius = radius;
  how.forward_speed = how.reverse_speed = how.forward_arc_speed = how.reverse_arc_speed = 1.0;
  how.forward = kAhead;
  how.forward_left = kAheadLeft;
  how.forward_right = kAheadRight;
  how.reverse = kBack;
  how.reverse_left = kBackLeft;
  how.reverse_right = kBackRight;
  t.connections.push_back(how);
  return t;
}

// A robot type that has the same body and sees the same obstacles empty and loaded.
inline Model model_of(const Body& body, const Obstacles& obstacles, MotionTable table,
                      MotionTable fine, double clearance = 0.0) {
  Model m;
  m.bodies = {body, body};
  const auto statics = std::make_shared<const Statics>(obstacles, body.circumradius());
  m.statics = {statics, statics};
  m.table = std::move(table);
  m.fine = std::move(fine);
  m.clearance = clearance;
  return m;
}

inline Model rover(const Body& body, const Obstacles& obstacles, double clearance = 0.0) {
  return model_of(body, obstacles, rover_table(16), rover_table(32), clearance);
}

inline TimedPiece drive(Ticks begin, Ticks end, const Pose& start, const Twist& twist,
                        int body = 0) {
  return {begin, end, start, twist, 0, body};
}

inline TimedPiece wait(Ticks begin, Ticks end, const Pose& at, int body = 0) {
  return {begin, end, at, {}, -1, body};
}

// Where a robot with these pieces is, looked up the slow way.
inline Pose pose_at(const Pose& start, const std::vector<TimedPiece>& pieces, double tick) {
  Pose at = start;
  for (const TimedPiece& p : pieces) {
    if (tick < p.begin) return at;
    const double progress =
        p.end > p.begin ? std::min(1.0, (tick - p.begin) / (p.end - p.begin)) : 1.0;
    at = moved(p.start, p.twist.part(progress));
    if (tick < p.end) return at;
  }
  return at;
}

// Least gap of two tracks over [0, last], looked at every `step` ticks.
inline double least_gap(const Track& a, const Track& b, Ticks last, Ticks step) {
  double least = 1e300;
  for (Ticks t = 0; t <= last; t += step) {
    const Track::Sight sa = a.at(t), sb = b.at(t);
    const double reach = sa.body->circumradius() + sb.body->circumradius();
    const double apart = std::hypot(sa.frame.x - sb.frame.x, sa.frame.y - sb.frame.y) - reach;
    least = std::min(least, apart > 0.1 ? apart : true_gap(*sa.body, sa.frame, *sb.body, sb.frame));
  }
  return least;
}

}  // namespace scenes
