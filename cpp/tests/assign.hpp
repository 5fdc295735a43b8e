// Assignment problems for tests.
#pragma once

#include <cmath>
#include <limits>

#include "clearway/assign/costs.hpp"
#include "clearway/assign/random.hpp"

namespace scenes {

// Robots that drive alike among random points of a square, 30 m wide; quarter turns.
inline clearway::assign::Tables among_points(int robots, int tasks, std::uint64_t seed) {
  clearway::assign::Random random(seed);
  const auto m = static_cast<std::size_t>(robots), n = static_cast<std::size_t>(tasks);
  std::vector<double> x(m + n), y(m + n);
  for (std::size_t i = 0; i < m + n; ++i) {
    x[i] = 30.0 * random.unit();
    y[i] = 30.0 * random.unit();
  }
  clearway::assign::Tables t;
  t.robots = robots;
  t.tasks = tasks;
  t.kinds = 1;
  t.kind.assign(m, 0);
  for (std::size_t i = 0; i < m + n; ++i) {
    for (std::size_t j = m; j < m + n; ++j) {
      const double distance = std::abs(x[i] - x[j]) + std::abs(y[i] - y[j]);
      const double turn = 1.570796327 * random.below(3);
      (i < m ? t.start : t.between).push_back(distance);
      (i < m ? t.start_turn : t.turn).push_back(turn);
    }
  }
  t.inner.assign(m * n, 0.0);
  t.allowed.assign(m * n, 1);
  t.service.assign(n, 0.0);
  t.due.assign(n, std::numeric_limits<double>::infinity());
  return t;
}

// Task j is robot (j mod m)'s.
inline clearway::assign::Routes dealt(int robots, int tasks) {
  clearway::assign::Routes routes(static_cast<std::size_t>(robots));
  for (int j = 0; j < tasks; ++j) routes[static_cast<std::size_t>(j % robots)].push_back(j);
  return routes;
}

// Robots at 0 m and 10 m of a line, tasks at 1, 2, 8 and 9 m; no turns.
inline clearway::assign::Tables on_a_line() {
  clearway::assign::Tables t = among_points(2, 4, 0);
  const double start[] = {0.0, 10.0}, task[] = {1.0, 2.0, 8.0, 9.0};
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t j = 0; j < 4; ++j) t.start[k * 4 + j] = std::abs(task[j] - start[k]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) t.between[i * 4 + j] = std::abs(task[j] - task[i]);
  }
  t.start_turn.assign(8, 0.0);
  t.turn.assign(16, 0.0);
  return t;
}

}  // namespace scenes
