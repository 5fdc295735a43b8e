#include "clearway/search/goal_distance.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

TEST_CASE("In the open the distance is the air line, a few percent and a cell more or less") {
  const Statics statics(hall(40, 40), 1.0);
  const GoalDistance distance(statics, 0.5, 20.2, 20.3, 0.5);
  Dice dice(71);
  for (int i = 0; i < 2000; ++i) {
    const double x = dice.between(1, 39), y = dice.between(1, 39);
    const double line = std::hypot(x - 20.2, y - 20.3);
    // Each end may be half a cell's diagonal from its cell's centre: 0.71 m together.
    CHECK(distance(x, y) >= line - 0.71);
    CHECK(distance(x, y) <= 1.03 * line + 0.75);
  }
  CHECK(distance(20.2, 20.3) == 0.0F);
}

TEST_CASE("Behind a wall the way round counts") {
  Obstacles o = hall(20, 20);
  add_solid(o, box_points(9.5, 0, 10.5, 16));
  const Statics statics(o, 1.0);
  const GoalDistance distance(statics, 0.6, 15, 2, 0.5);
  // Over the wall's end at (10, 16): about hypot(5, 14) twice, against 10 m of air line.
  const double around = 2.0 * std::hypot(5, 14);
  CHECK(distance(5, 2) > around - 1.0);
  CHECK(distance(5, 2) < 1.05 * around + 2.5);
}

TEST_CASE("Where the body's core does not fit there is no way") {
  Obstacles o = hall(20, 20);
  add_solid(o, box_points(9, 0, 11, 9));
  add_solid(o, box_points(9, 10, 11, 20));  // a door of 1 m
  const Statics statics(o, 2.0);
  const GoalDistance fat(statics, 1.2, 15, 10, 0.5), slim(statics, 0.4, 15, 10, 0.5);
  CHECK(fat(5, 10) >= GoalDistance::kUnreachable);
  CHECK(slim(5, 10) < 12.0);
  CHECK(slim(5, 10) > 9.0);
}

TEST_CASE("Outside the site there is no distance") {
  const Statics statics(hall(10, 10), 1.0);
  const GoalDistance distance(statics, 0.5, 5, 5, 0.5);
  CHECK(distance(-0.1, 5) >= GoalDistance::kUnreachable);
  CHECK(distance(5, 10.1) >= GoalDistance::kUnreachable);
  CHECK(distance(std::nan(""), 5) >= GoalDistance::kUnreachable);
}

TEST_CASE("A slow search over the same cells finds the same distances") {
  Obstacles o = hall(15, 12);
  add_solid(o, {{3, 3}, {7, 3}, {7, 9}, {6, 9}, {6, 4}, {3, 4}});
  o.discs.push_back({10, 6, 1.0});
  const double cell = 0.5, radius = 0.7;
  const Statics statics(o, 1.0);
  const GoalDistance distance(statics, radius, 5, 6, cell);
  // Bellman-Ford over cells whose centre the field says to be open, until nothing changes.
  const int w = 30, h = 24;
  std::vector<double> slow(static_cast<std::size_t>(w * h), 1e30);
  const auto at = [w](int x, int y) { return static_cast<std::size_t>(y * w + x); };
  slow[at(10, 12)] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        if (slow[at(x, y)] >= 1e30) continue;
        for (int dy = -2; dy <= 2; ++dy) {
          for (int dx = -2; dx <= 2; ++dx) {
            const bool king = std::max(std::abs(dx), std::abs(dy)) == 1;
            const bool knight = std::abs(dx * dy) == 2;
            if (!king && !knight) continue;
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= w || ny >= h) continue;
            const Point c{(nx + 0.5) * cell, (ny + 0.5) * cell};
            // Surely open cells only: these must never be dearer than the slow way.
            if (statics.clearance(c.x, c.y) < radius) continue;
            const double d = slow[at(x, y)] + cell * std::hypot(dx, dy);
            if (d < slow[at(nx, ny)] - 1e-9) {
              slow[at(nx, ny)] = d;
              changed = true;
            }
          }
        }
      }
    }
  }
  int compared = 0;
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      if (slow[at(x, y)] >= 1e30) continue;
      ++compared;
      CHECK(distance((x + 0.5) * cell, (y + 0.5) * cell) <= slow[at(x, y)] + 1e-3);
    }
  }
  CHECK(compared > 200);
}
