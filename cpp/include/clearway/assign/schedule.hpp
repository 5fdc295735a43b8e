// When tasks are finished, and how late, where some are due or wait for others.
#pragma once

#include <span>
#include <vector>

#include "clearway/assign/costs.hpp"

namespace clearway::assign {

class Schedule {
 public:
  explicit Schedule(const Costs& costs);

  // Sum of delays (s) over the tasks in the routes; infinite if routes wait for each other.
  double tardiness(const Routes& routes) {
    for (std::size_t k = 0; k < routes.size(); ++k) routes_[k] = routes[k];
    return run();
  }
  // The same, from views that stay as they are meanwhile.
  std::vector<std::span<const int>>& routes() { return routes_; }
  double run();
  // Delays of one robot's tasks where no task waits for others.
  double tardiness_alone(int robot, std::span<const int> route) const;
  // How many tasks the last run left undone since routes wait for each other.
  std::size_t left() const { return left_; }

 private:
  const Costs& costs_;
  std::vector<std::span<const int>> routes_;
  std::vector<std::size_t> ahead_;  // position of each robot's next task
  std::vector<double> now_;         // when each robot is done with what it did
  std::vector<double> ready_;       // when all that a task waits for is finished
  std::vector<int> waits_;          // for how many unfinished tasks a task waits
  std::vector<int> holder_;         // whose route a task is in; -1: in none
  std::vector<int> open_;           // robots that may go on
  std::size_t left_ = 0;
};

}  // namespace clearway::assign
