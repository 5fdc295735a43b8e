#include "clearway/assign/schedule.hpp"

#include <algorithm>
#include <limits>

namespace clearway::assign {

Schedule::Schedule(const Costs& costs) : costs_(costs) {
  const auto m = static_cast<std::size_t>(costs.robots());
  const auto n = static_cast<std::size_t>(costs.tasks());
  routes_.resize(m);
  ahead_.resize(m);
  now_.resize(m);
  ready_.resize(n);
  waits_.resize(n);
  holder_.resize(n);
}

double Schedule::tardiness_alone(int robot, std::span<const int> route) const {
  double now = 0.0, late = 0.0;
  int here = costs_.end();
  for (const int task : route) {
    now += costs_.leg(robot, here, task).distance / costs_.speed() + costs_.service(task);
    late += std::max(0.0, now - costs_.due(task));
    here = task;
  }
  return late;
}

double Schedule::run() {
  std::fill(ahead_.begin(), ahead_.end(), std::size_t{0});
  std::fill(now_.begin(), now_.end(), 0.0);
  open_.clear();
  left_ = 0;
  if (costs_.has_order()) {
    std::fill(ready_.begin(), ready_.end(), 0.0);
    std::fill(waits_.begin(), waits_.end(), 0);
    std::fill(holder_.begin(), holder_.end(), -1);
  }
  for (int k = 0; k < costs_.robots(); ++k) {
    const auto& route = routes_[static_cast<std::size_t>(k)];
    open_.push_back(k);
    left_ += route.size();
    if (!costs_.has_order()) continue;
    for (const int task : route) {
      holder_[static_cast<std::size_t>(task)] = k;
      for (const int follower : costs_.followers(task)) {
        ++waits_[static_cast<std::size_t>(follower)];
      }
    }
  }
  double late = 0.0;
  while (!open_.empty()) {
    const int robot = open_.back();
    const auto k = static_cast<std::size_t>(robot);
    open_.pop_back();
    while (ahead_[k] < routes_[k].size()) {
      const int task = routes_[k][ahead_[k]];
      const auto j = static_cast<std::size_t>(task);
      if (costs_.has_order() && waits_[j] > 0) break;
      const int here = ahead_[k] ? routes_[k][ahead_[k] - 1] : costs_.end();
      const double inner = costs_.inner(robot, task);
      double begin = now_[k] + (costs_.leg(robot, here, task).distance - inner) / costs_.speed();
      if (costs_.has_order()) begin = std::max(begin, ready_[j]);
      const double done = begin + inner / costs_.speed() + costs_.service(task);
      late += std::max(0.0, done - costs_.due(task));
      now_[k] = done;
      ++ahead_[k];
      --left_;
      if (!costs_.has_order()) continue;
      for (const int follower : costs_.followers(task)) {
        const auto f = static_cast<std::size_t>(follower);
        ready_[f] = std::max(ready_[f], done);
        if (--waits_[f] > 0 || holder_[f] < 0 || holder_[f] == robot) continue;
        const auto other = static_cast<std::size_t>(holder_[f]);
        if (routes_[other][ahead_[other]] == follower) open_.push_back(holder_[f]);
      }
    }
  }
  return left_ ? std::numeric_limits<double>::infinity() : late;
}

}  // namespace clearway::assign
