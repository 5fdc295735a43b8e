// Poses, frames and constant body-frame twists.
#pragma once

#include <cmath>
#include <numbers>

namespace clearway {

constexpr double kTau = 2.0 * std::numbers::pi;

struct Point {
  double x = 0.0, y = 0.0;
};

inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }

inline double length(Point a) { return std::sqrt(dot(a, a)); }

// Into [-pi, pi]; most angles are less than a turn away.
inline double wrap(double angle) {
  constexpr double half = std::numbers::pi;
  if (std::abs(angle) <= half) return angle;
  if (std::abs(angle) < 3.0 * half) return angle > 0.0 ? angle - kTau : angle + kTau;
  return std::remainder(angle, kTau);
}

struct Pose {
  double x = 0.0, y = 0.0, theta = 0.0;
};

// A pose whose cosine and sine are at hand.
struct Frame {
  double x = 0.0, y = 0.0, c = 1.0, s = 0.0;

  Frame() = default;
  Frame(double px, double py, double cosine, double sine) : x(px), y(py), c(cosine), s(sine) {}
  explicit Frame(const Pose& p) : x(p.x), y(p.y), c(std::cos(p.theta)), s(std::sin(p.theta)) {}

  Point to_world(Point local) const {
    return {x + c * local.x - s * local.y, y + s * local.x + c * local.y};
  }
  Point to_local(Point world) const {
    const double dx = world.x - x, dy = world.y - y;
    return {c * dx + s * dy, -s * dx + c * dy};
  }
};

// `b` as seen from `a`.
inline Frame relative(const Frame& a, const Frame& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return {a.c * dx + a.s * dy, -a.s * dx + a.c * dy, a.c * b.c + a.s * b.s, a.c * b.s - a.s * b.c};
}

inline Frame inverse(const Frame& f) {
  return {-f.c * f.x - f.s * f.y, f.s * f.x - f.c * f.y, f.c, -f.s};
}

// Whole body-frame displacement of a motion of constant direction and curvature.
struct Twist {
  double a = 0.0, b = 0.0, c = 0.0;  // along x (m), along y (m), turn (rad)

  double length() const { return std::sqrt(a * a + b * b); }
  Twist part(double progress) const { return {a * progress, b * progress, c * progress}; }
};

// Body-frame pose reached by a twist.
inline Pose displacement(const Twist& t) {
  if (std::abs(t.c) < 1e-9) return {t.a - 0.5 * t.b * t.c, t.b + 0.5 * t.a * t.c, t.c};
  const double sine = std::sin(t.c) / t.c;
  const double versine = (1.0 - std::cos(t.c)) / t.c;
  return {t.a * sine - t.b * versine, t.a * versine + t.b * sine, t.c};
}

inline Pose compose(const Pose& p, const Pose& local) {
  const double c = std::cos(p.theta), s = std::sin(p.theta);
  return {p.x + c * local.x - s * local.y, p.y + s * local.x + c * local.y, p.theta + local.theta};
}

inline Pose moved(const Pose& p, const Twist& t) { return compose(p, displacement(t)); }

// Frame after a twist; straight motions cost no trigonometry.
inline Frame moved(const Frame& f, const Twist& t) {
  if (t.c == 0.0) return {f.x + f.c * t.a - f.s * t.b, f.y + f.s * t.a + f.c * t.b, f.c, f.s};
  const double ct = std::cos(t.c), st = std::sin(t.c);
  double sine, versine;
  if (std::abs(t.c) < 1e-9) {
    sine = 1.0;
    versine = 0.5 * t.c;
  } else {
    sine = st / t.c;
    versine = (1.0 - ct) / t.c;
  }
  const double lx = t.a * sine - t.b * versine, ly = t.a * versine + t.b * sine;
  return {f.x + f.c * lx - f.s * ly, f.y + f.s * lx + f.c * ly, f.c * ct - f.s * st,
          f.s * ct + f.c * st};
}

}  // namespace clearway
