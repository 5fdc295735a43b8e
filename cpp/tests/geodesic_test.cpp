#include "clearway/search/geodesic.hpp"

#include <doctest/doctest.h>

#include <queue>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

namespace {

bool is_free(const Obstacles& o, double radius, Point p) {
  for (const Segment& s : o.segments) {
    if (to_segment(p, s.p, s.q) < radius) return false;
  }
  for (const Circle& c : o.discs) {
    if (std::hypot(p.x - c.x, p.y - c.y) < c.r + radius) return false;
  }
  return true;
}

// Way of a point over a fine grid, king and knight moves: never shorter than the true one.
double grid_way(const Obstacles& o, double radius, Point from, Point to, double cell) {
  const int w = static_cast<int>(std::round(o.box.x1 / cell)) + 1;
  const int h = static_cast<int>(std::round(o.box.y1 / cell)) + 1;
  const auto free = [&](Point p) { return is_free(o, radius, p); };
  std::vector<char> open(static_cast<std::size_t>(w * h));
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x)
      open[static_cast<std::size_t>(y * w + x)] = free({x * cell, y * cell});
  }
  std::vector<double> cost(open.size(), 1e30);
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  const auto index = [&](Point p) {
    return static_cast<int>(std::round(p.y / cell)) * w + static_cast<int>(std::round(p.x / cell));
  };
  cost[static_cast<std::size_t>(index(from))] = 0.0;
  queue.push({0.0, index(from)});
  while (!queue.empty()) {
    const auto [d, at] = queue.top();
    queue.pop();
    if (at == index(to)) return d;
    if (d > cost[static_cast<std::size_t>(at)]) continue;
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        const int x = at % w + dx, y = at / w + dy;
        if (x < 0 || y < 0 || x >= w || y >= h) continue;
        const auto next = static_cast<std::size_t>(y * w + x);
        const double length = d + cell * std::hypot(dx, dy);
        if (!open[next] || length >= cost[next]) continue;
        if (!free({(at % w + 0.5 * dx) * cell, (at / w + 0.5 * dy) * cell})) continue;
        cost[next] = length;
        queue.push({length, static_cast<int>(next)});
      }
    }
  }
  return 1e30;
}

}  // namespace

TEST_CASE("With nothing in between the shortest way is the air line") {
  Geodesic geodesic(hall(20, 10), 0.5);
  CHECK(geodesic({2, 2}, {17, 8}) == doctest::Approx(std::hypot(15, 6)));
  CHECK(geodesic({2, 2}, {2, 2}) == 0.0);
}

TEST_CASE("A small disc goes round the end of a wall in nearly two air lines") {
  Obstacles o = hall(20, 20);
  o.segments.push_back({{10, 0}, {10, 12}});
  const double found = Geodesic(o, 0.02)({5, 0.5}, {15, 0.5});
  CHECK(found >= 2.0 * std::hypot(5, 11.5));
  CHECK(found <= 2.0 * std::hypot(5, 11.5) + 0.1);
}

TEST_CASE("A disc goes round the end of a wall at its radius, at most a percent less") {
  Obstacles o = hall(20, 20);
  o.segments.push_back({{10, 2}, {10, 12}});
  // From (5, 7) and (15, 7) the wall's end (10, 12) is root 50 away: tangents of
  // sqrt(50 - 1) = 7 m. Seen from the end the two lie 270 degrees apart over the top, and each
  // tangent point acos(1 / root 50) from the line to its own.
  const double truth = 14.0 + 1.5 * kPi - 2.0 * std::acos(1.0 / std::sqrt(50.0));
  const double found = Geodesic(o, 1.0)({5, 7}, {15, 7});
  CHECK(found <= truth + 1e-9);
  CHECK(found >= 0.99 * truth);
}

TEST_CASE("Where a disc does not fit there is no way, and where it just fits there is one") {
  Obstacles o = hall(20, 10);
  o.segments.push_back({{10, 0}, {10, 4}});
  o.segments.push_back({{10, 6}, {10, 10}});
  CHECK(std::isinf(Geodesic(o, 1.01)({5, 5}, {15, 5})));
  CHECK(Geodesic(o, 1.0)({5, 5}, {15, 5}) == doctest::Approx(10.0));
}

TEST_CASE("Never longer than a way that a fine grid finds, never shorter than the air line") {
  Dice dice(91);
  int detours = 0;
  for (int scene = 0; scene < 6; ++scene) {
    Obstacles o = hall(12, 12);
    for (int i = 0; i < 5; ++i) {
      const Point p{dice.between(2, 10), dice.between(2, 10)};
      const double turn = dice.between(0, kTau), length = dice.between(1, 4);
      o.segments.push_back({p, {p.x + length * std::cos(turn), p.y + length * std::sin(turn)}});
    }
    o.discs.push_back({dice.between(3, 9), dice.between(3, 9), 0.7});
    const double radius = scene % 2 ? 0.4 : 0.15;
    Geodesic geodesic(o, radius);
    for (const auto& [from, to] : {std::pair{Point{1, 1}, Point{11, 11}},
                                   {Point{1, 11}, Point{11, 1}},
                                   {Point{6, 1}, Point{6, 11}},
                                   {Point{1, 6}, Point{11, 6}}}) {
      if (!is_free(o, radius, from) || !is_free(o, radius, to)) continue;
      const double found = geodesic(from, to), slow = grid_way(o, radius, from, to, 0.1);
      const double line = std::hypot(to.x - from.x, to.y - from.y);
      CHECK(found >= line - 1e-9);
      CHECK(found <= slow + 1e-6);
      // A grid of 0.1 m with 32 directions is a few percent off at worst, where it gets through.
      if (slow < 1e30) CHECK(found >= 0.9 * slow);
      if (found > 1.02 * line && found < 1e29) ++detours;
      if (slow < 1e30) CHECK(geodesic(to, from) == doctest::Approx(found));
    }
  }
  CHECK(detours > 4);
}
