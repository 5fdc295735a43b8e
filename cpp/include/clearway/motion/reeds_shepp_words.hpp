// The formulas behind reeds_shepp_words().
#pragma once

#include <algorithm>
#include <cmath>

#include "clearway/motion/reeds_shepp.hpp"

namespace clearway::reeds_shepp_detail {

constexpr double kPi = std::numbers::pi;
constexpr double kTolerance = 1e-10;

struct Lengths {
  double t = 0.0, u = 0.0, v = 0.0;
};

// Where the curve leads: position and heading, with the heading's sine and cosine.
struct Goal {
  double x, y, phi, sine, cosine;
};

struct Polar {
  double r, angle;
  Polar(double x, double y) : r(std::sqrt(x * x + y * y)), angle(std::atan2(y, x)) {}
};

inline bool forward(double v) { return v >= -kTolerance; }
inline bool backward(double v) { return v <= kTolerance; }

// t and v of the four-arc families (8.7, 8.8) once u and the third arc are chosen.
inline Lengths outer_arcs(double u, double third, double xi, double eta, double phi) {
  const double delta = wrap(u - third);
  const double a = std::sin(u) - std::sin(delta);
  const double b = std::cos(u) - std::cos(delta) - 1.0;
  const double angle = std::atan2(eta * a - xi * b, xi * a + eta * b);
  const double side = 2.0 * (std::cos(delta) - std::cos(third) - std::cos(u)) + 3.0;
  const double t = wrap(side < 0.0 ? angle + kPi : angle);
  return {t, u, wrap(t - u + third - phi)};
}

inline bool lsl(const Goal& g, Lengths& w) {  // 8.1
  const Polar p(g.x - g.sine, g.y - 1.0 + g.cosine);
  w = {p.angle, p.r, wrap(g.phi - p.angle)};
  return forward(w.t) && forward(w.v);
}

inline bool lsr(const Goal& g, Lengths& w) {  // 8.2
  const Polar p(g.x + g.sine, g.y - 1.0 - g.cosine);
  if (p.r < 2.0) return false;
  w.u = std::sqrt(p.r * p.r - 4.0);
  w.t = wrap(p.angle + std::atan2(2.0, w.u));
  w.v = wrap(w.t - g.phi);
  return forward(w.t) && forward(w.v);
}

inline bool lrl(const Goal& g, Lengths& w) {  // 8.3, 8.4
  const Polar p(g.x - g.sine, g.y - 1.0 + g.cosine);
  if (p.r > 4.0) return false;
  w.u = -2.0 * std::asin(0.25 * p.r);
  w.t = wrap(p.angle + 0.5 * w.u + kPi);
  w.v = wrap(g.phi - w.t + w.u);
  return forward(w.t) && backward(w.u);
}

inline bool lrlr_outward(const Goal& g, Lengths& w) {  // 8.7
  const double xi = g.x + g.sine, eta = g.y - 1.0 - g.cosine;
  const double rho = 0.25 * (2.0 + std::sqrt(xi * xi + eta * eta));
  if (rho > 1.0) return false;
  const double u = std::acos(rho);
  w = outer_arcs(u, -u, xi, eta, g.phi);
  return forward(w.t) && backward(w.v);
}

inline bool lrlr_inward(const Goal& g, Lengths& w) {  // 8.8
  const double xi = g.x + g.sine, eta = g.y - 1.0 - g.cosine;
  const double rho = (20.0 - xi * xi - eta * eta) / 16.0;
  if (rho < 0.0 || rho > 1.0) return false;
  const double u = -std::acos(rho);
  w = outer_arcs(u, u, xi, eta, g.phi);
  return forward(w.t) && forward(w.v);
}

inline bool lrsl(const Goal& g, Lengths& w) {  // 8.9
  const Polar p(g.x - g.sine, g.y - 1.0 + g.cosine);
  if (p.r < 2.0) return false;
  const double root = std::sqrt(p.r * p.r - 4.0);
  w.u = 2.0 - root;
  w.t = wrap(p.angle + std::atan2(root, -2.0));
  w.v = wrap(g.phi - 0.5 * kPi - w.t);
  return forward(w.t) && backward(w.u) && backward(w.v);
}

inline bool lrsr(const Goal& g, Lengths& w) {  // 8.10
  const double xi = g.x + g.sine, eta = g.y - 1.0 - g.cosine;
  const Polar p(-eta, xi);
  if (p.r < 2.0) return false;
  w.t = p.angle;
  w.u = 2.0 - p.r;
  w.v = wrap(w.t + 0.5 * kPi - g.phi);
  return forward(w.t) && backward(w.u) && backward(w.v);
}

inline bool lrslr(const Goal& g, Lengths& w) {  // 8.11
  const double xi = g.x + g.sine, eta = g.y - 1.0 - g.cosine;
  const double rho = std::sqrt(xi * xi + eta * eta);
  if (rho < 2.0) return false;
  w.u = 4.0 - std::sqrt(rho * rho - 4.0);
  if (w.u > kTolerance) return false;
  w.t = wrap(std::atan2((4.0 - w.u) * xi - 2.0 * eta, -2.0 * xi + (w.u - 4.0) * eta));
  w.v = wrap(w.t - g.phi);
  return forward(w.t) && forward(w.v);
}

}  // namespace clearway::reeds_shepp_detail

namespace clearway {

template <typename Visit>
void reeds_shepp_words(double x, double y, double phi, Visit&& visit) {
  namespace rs = reeds_shepp_detail;
  constexpr Turn L = Turn::kLeft, R = Turn::kRight, S = Turn::kStraight;
  constexpr double quarter = std::numbers::pi / 2.0;
  const double sine = std::sin(phi), cosine = std::cos(phi);
  rs::Lengths w;

  // Each formula serves four words: driven as it is, backwards in time, mirrored, and both.
  const auto symmetric = [&](double px, double py, bool reversed, auto formula, auto make) {
    for (int k = 0; k < 4; ++k) {
      const double time = k & 1 ? -1.0 : 1.0, mirror = k & 2 ? -1.0 : 1.0;
      const double sign = time * mirror;
      if (!formula(rs::Goal{time * px, mirror * py, sign * phi, sign * sine, cosine}, w)) continue;
      Word word = make(w);
      for (std::size_t i = 0; i < static_cast<std::size_t>(word.size); ++i) {
        word.length[i] *= time;
        if (mirror < 0.0) word.turn[i] = static_cast<Turn>(-static_cast<int>(word.turn[i]));
      }
      if (reversed) {
        std::reverse(word.turn.begin(), word.turn.begin() + word.size);
        std::reverse(word.length.begin(), word.length.begin() + word.size);
      }
      visit(word);
    }
  };
  // The same curve driven from the goal: words that read backwards.
  const double xb = x * cosine + y * sine;
  const double yb = x * sine - y * cosine;

  symmetric(x, y, false, rs::lsl,
            [](const rs::Lengths& l) { return Word{3, {L, S, L}, {l.t, l.u, l.v}}; });
  symmetric(x, y, false, rs::lsr,
            [](const rs::Lengths& l) { return Word{3, {L, S, R}, {l.t, l.u, l.v}}; });
  const auto lrl = [](const rs::Lengths& l) { return Word{3, {L, R, L}, {l.t, l.u, l.v}}; };
  symmetric(x, y, false, rs::lrl, lrl);
  symmetric(xb, yb, true, rs::lrl, lrl);
  symmetric(x, y, false, rs::lrlr_outward,
            [](const rs::Lengths& l) { return Word{4, {L, R, L, R}, {l.t, l.u, -l.u, l.v}}; });
  symmetric(x, y, false, rs::lrlr_inward,
            [](const rs::Lengths& l) { return Word{4, {L, R, L, R}, {l.t, l.u, l.u, l.v}}; });
  const auto lrsl = [](const rs::Lengths& l) {
    return Word{4, {L, R, S, L}, {l.t, -quarter, l.u, l.v}};
  };
  symmetric(x, y, false, rs::lrsl, lrsl);
  symmetric(xb, yb, true, rs::lrsl, lrsl);
  const auto lrsr = [](const rs::Lengths& l) {
    return Word{4, {L, R, S, R}, {l.t, -quarter, l.u, l.v}};
  };
  symmetric(x, y, false, rs::lrsr, lrsr);
  symmetric(xb, yb, true, rs::lrsr, lrsr);
  symmetric(x, y, false, rs::lrslr, [](const rs::Lengths& l) {
    return Word{5, {L, R, S, L, R}, {l.t, -quarter, l.u, -quarter, l.v}};
  });
}

}  // namespace clearway
