// All routes of a small problem that may be part of a solution better than a known one.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/assign/costs.hpp"

namespace clearway::assign {

using TaskSet = std::uint32_t;

// The best order of a set of tasks for a robot: none is both shorter and cheaper. `far` is the
// distance, weighted as that of the longest route.
struct PooledRoute {
  TaskSet tasks;
  int robot;
  double far, price;
};

class RoutePool {
 public:
  static constexpr int kMostTasks = 16;

  // Routes of at most so many tasks that may add up, with others, to a value below `bound`.
  RoutePool(const Costs& costs, int seats, double bound);

  // By robot, then by set.
  const std::vector<PooledRoute>& routes() const { return routes_; }
  // What the longest route is worth at least.
  double least_far() const { return least_far_; }
  // The order in which a robot does the tasks of a pooled route.
  std::vector<int> order(const PooledRoute& route) const;

 private:
  struct Label {
    double far, price;
  };

  void bound_legs();
  void label(int kind);
  void close_routes(int kind);
  bool hopeless(TaskSet tasks, int first, const Label& label) const;
  // A single robot's route is the longest: there is one price then.
  Label weighted(const Leg& leg) const {
    const double far = costs_.weights().longest * leg.distance;
    return costs_.robots() == 1 ? Label{0.0, leg.price + far} : Label{far, leg.price};
  }

  const Costs& costs_;
  int seats_;
  double bound_;
  double most_far_ = 0.0, least_far_ = 0.0;
  std::vector<double> cheapest_;  // price of the cheapest leg into each task
  std::vector<double> reach_;     // far of the shortest way to each task
  std::vector<double> rest_;      // sum of cheapest_ over the tasks not in a set
  // Labels of the kind at work by set and first task: those of set s and its i-th task are
  // labels_[offsets_[base_[s] + i]] up to the next offset.
  std::vector<Label> labels_;
  std::vector<std::uint32_t> offsets_, base_;
  std::vector<PooledRoute> routes_;
};

}  // namespace clearway::assign
