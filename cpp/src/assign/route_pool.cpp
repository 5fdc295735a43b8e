#include "clearway/assign/route_pool.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "clearway/assign/spanning_bound.hpp"

namespace clearway::assign {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kNever = std::numeric_limits<double>::infinity();

TaskSet one(int task) { return TaskSet{1} << task; }

// Adds a label to those from `first` on, unless one of them is as good; drops those it beats.
template <class Label>
void add(std::vector<Label>& labels, std::size_t first, const Label& label) {
  std::size_t keep = first;
  for (std::size_t i = first; i < labels.size(); ++i) {
    if (labels[i].far <= label.far && labels[i].price <= label.price) return;
  }
  for (std::size_t i = first; i < labels.size(); ++i) {
    if (labels[i].far < label.far || labels[i].price < label.price) labels[keep++] = labels[i];
  }
  labels.resize(keep);
  labels.push_back(label);
}

}  // namespace

RoutePool::RoutePool(const Costs& costs, int seats, double bound)
    : costs_(costs), seats_(seats), bound_(bound) {
  bound_legs();
  most_far_ = bound - spanning_bound(costs);
  for (int kind = 0; kind < costs.kinds(); ++kind) {
    label(kind);
    close_routes(kind);
  }
}

void RoutePool::bound_legs() {
  const int n = costs_.tasks();
  cheapest_.assign(static_cast<std::size_t>(n), kNever);
  reach_.assign(static_cast<std::size_t>(n), kNever);
  const auto learn = [&](int task, const Leg& leg, double before) {
    if (leg.price >= costs_.forbidden()) return false;
    auto& cheapest = cheapest_[static_cast<std::size_t>(task)];
    auto& reach = reach_[static_cast<std::size_t>(task)];
    cheapest = std::min(cheapest, leg.price);
    const bool nearer = before + far(leg) < reach;
    if (nearer) reach = before + far(leg);
    return nearer;
  };
  for (int k = 0; k < costs_.robots(); ++k) {
    for (int task = 0; task < n; ++task) learn(task, costs_.start(k, task), 0.0);
  }
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (int kind = 0; kind < costs_.kinds(); ++kind) {
      for (int from = 0; from < n; ++from) {
        for (int to = 0; to < n; ++to) {
          if (to == from) continue;
          nearer |= learn(to, costs_.out_of(kind, from)[to], reach_[static_cast<std::size_t>(from)]);
        }
      }
    }
  }
  rest_.assign(std::size_t{1} << n, 0.0);
  for (TaskSet left = 1; left < rest_.size(); ++left) {
    const int task = std::countr_zero(left);
    rest_[left] = rest_[left & (left - 1)] + cheapest_[static_cast<std::size_t>(task)];
  }
  std::reverse(rest_.begin(), rest_.end());  // the complement of s is the last set less s
  for (const double reach : reach_) least_far_ = std::max(least_far_, reach);
}

// Whether no solution that holds these tasks in a row is good enough.
bool RoutePool::hopeless(TaskSet tasks, int first, const Label& label) const {
  const auto f = static_cast<std::size_t>(first);
  const double far = label.far + reach_[f];
  return far > most_far_ ||
         label.price + cheapest_[f] + rest_[tasks] + std::max(far, least_far_) >= bound_;
}

void RoutePool::label(int kind) {
  const int n = costs_.tasks();
  labels_.clear();
  offsets_.clear();
  base_.assign(std::size_t{1} << n, kNone);
  for (TaskSet tasks = 1; tasks < base_.size(); ++tasks) {
    if (std::popcount(tasks) > seats_) continue;
    const auto base = static_cast<std::uint32_t>(offsets_.size());
    const std::size_t before = labels_.size();
    for (TaskSet firsts = tasks; firsts; firsts &= firsts - 1) {
      const int first = std::countr_zero(firsts);
      const std::size_t begin = labels_.size();
      offsets_.push_back(static_cast<std::uint32_t>(begin));
      const TaskSet others = tasks ^ one(first);
      if (!others) {
        if (!hopeless(tasks, first, {0.0, 0.0})) labels_.push_back({0.0, 0.0});
        continue;
      }
      if (base_[others] == kNone) continue;
      const Leg* legs = costs_.out_of(kind, first);
      std::uint32_t at = base_[others];
      for (TaskSet seconds = others; seconds; seconds &= seconds - 1, ++at) {
        const Leg& leg = legs[std::countr_zero(seconds)];
        if (leg.price >= costs_.forbidden()) continue;
        for (std::uint32_t i = offsets_[at]; i < offsets_[at + 1]; ++i) {
          const Label label{labels_[i].far + far(leg), labels_[i].price + leg.price};
          if (!hopeless(tasks, first, label)) add(labels_, begin, label);
        }
      }
    }
    if (labels_.size() == before) {
      offsets_.resize(base);
    } else {
      offsets_.push_back(static_cast<std::uint32_t>(labels_.size()));
      base_[tasks] = base;
    }
  }
}

// Starts are added to the labels of a kind for each of its robots.
void RoutePool::close_routes(int kind) {
  for (int robot = 0; robot < costs_.robots(); ++robot) {
    if (costs_.kind(robot) != kind) continue;
    routes_.push_back({0, robot, 0.0, 0.0});
    for (TaskSet tasks = 1; tasks < base_.size(); ++tasks) {
      if (base_[tasks] == kNone) continue;
      const std::size_t begin = routes_.size();
      std::uint32_t at = base_[tasks];
      for (TaskSet firsts = tasks; firsts; firsts &= firsts - 1, ++at) {
        const Leg& start = costs_.start(robot, std::countr_zero(firsts));
        if (start.price >= costs_.forbidden()) continue;
        for (std::uint32_t i = offsets_[at]; i < offsets_[at + 1]; ++i) {
          const PooledRoute route{tasks, robot, labels_[i].far + far(start),
                                  labels_[i].price + start.price};
          if (route.far > most_far_ ||
              route.price + rest_[tasks] + std::max(route.far, least_far_) >= bound_) {
            continue;
          }
          add(routes_, begin, route);
        }
      }
      // A robot may not do every task of a set that its kind drives through.
      for (TaskSet left = tasks; left; left &= left - 1) {
        if (!costs_.allowed(robot, std::countr_zero(left))) {
          routes_.resize(begin);
          break;
        }
      }
    }
  }
}

// The labels are gone by now; those of one set are soon made again.
std::vector<int> RoutePool::order(const PooledRoute& route) const {
  std::vector<int> tasks, best;
  for (TaskSet s = route.tasks; s; s &= s - 1) tasks.push_back(std::countr_zero(s));
  const double reached = route.far + route.price;
  std::vector<int> order;
  const auto extend = [&](const auto& self, TaskSet left, const Leg& sum) -> bool {
    const double slack = 1e-9 * (1.0 + reached);
    if (far(sum) > route.far + slack || sum.price > route.price + slack) return false;
    if (!left) {
      best = order;
      return true;
    }
    for (const int task : tasks) {
      if (!(left & one(task))) continue;
      const int here = order.empty() ? costs_.end() : order.back();
      order.push_back(task);
      if (self(self, left ^ one(task), sum + costs_.leg(route.robot, here, task))) return true;
      order.pop_back();
    }
    return false;
  };
  extend(extend, route.tasks, {});
  return best;
}

}  // namespace clearway::assign
