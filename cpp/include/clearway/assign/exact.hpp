// Proven optima of small problems: pooled routes, bounded by prices of tasks, are put together.
#pragma once

#include <cstdint>

#include "clearway/assign/costs.hpp"
#include "clearway/assign/route_pool.hpp"
#include "clearway/budget.hpp"

namespace clearway::assign {

struct ExactResult {
  Routes routes;
  bool proven = false;          // false only if it was stopped
  std::int64_t pooled = 0;      // routes that might be part of something better
  std::int64_t branchings = 0;  // routes tried when putting them together
};

// The best routes of untimed problems of at most RoutePool::kMostTasks tasks, starting from legal
// ones; the better these are, the faster.
// Pooled routes: R. Baldacci et al., "An exact algorithm for the vehicle routing problem based on
// the set partitioning formulation", Math. Program. 115 (2008). The length of the longest route
// is cut into intervals until few routes are left in each.
ExactResult solve_exactly(const Costs& costs, int seats, const Routes& start, Budget& budget);

}  // namespace clearway::assign
