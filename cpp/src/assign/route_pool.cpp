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
  std::stable_sort(routes_.begin(), routes_.end(),
                   [](const PooledRoute& a, const PooledRoute& b) { return a.robot < b.robot; });
}

void RoutePool::bound_legs() {
  const int n = costs_.tasks();
  cheapest_.assign(static_cast<std::size_t>(n), kNever);
  reach_.assign(static_cast<std::size_t>(n), kNever);
  const auto learn = [&](int task, const Leg& leg, double before) {
    if (leg.price >= costs_.forbidden()) return false;
    auto& cheapest = cheapest_[static_cast<std::size_t>(task)];
    auto& reach = reach_[static_cast<std::size_t>(task)];
    const Label added = weighted(leg);
    cheapest = std::min(cheapest, added.price);
    const bool nearer = before + added.far < reach;
    if (nearer) reach = before + added.far;
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
          nearer |=
              learn(to, costs_.out_of(kind, from)[to], reach_[static_cast<std::size_t>(from)]);
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
        const Label added = weighted(leg);
        for (std::uint32_t i = offsets_[at]; i < offsets_[at + 1]; ++i) {
          const Label label{labels_[i].far + added.far, labels_[i].price + added.price};
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
        const Label added = weighted(start);
        for (std::uint32_t i = offsets_[at]; i < offsets_[at + 1]; ++i) {
          const PooledRoute route{tasks, robot, labels_[i].far + added.far,
                                  labels_[i].price + added.price};
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

// The labels are gone by now. What it takes at least to do the rest, as to each term alone, leads
// to an order that has both.
std::vector<int> RoutePool::order(const PooledRoute& route) const {
  std::vector<int> tasks;
  for (TaskSet s = route.tasks; s; s &= s - 1) tasks.push_back(std::countr_zero(s));
  const std::size_t size = tasks.size();
  const auto leg = [&](std::size_t from, std::size_t to) {
    return weighted(costs_.leg(route.robot, from == size ? costs_.end() : tasks[from], tasks[to]));
  };
  // Per set of tasks left and place at which it is begun; the last place is the start.
  std::vector<Label> least((std::size_t{1} << size) * (size + 1), {0.0, 0.0});
  for (std::size_t left = 1; left < std::size_t{1} << size; ++left) {
    for (std::size_t from = 0; from <= size; ++from) {
      Label& known = least[left * (size + 1) + from] = {kNever, kNever};
      for (std::size_t to = 0; to < size; ++to) {
        if (!(left >> to & 1)) continue;
        const Label& rest = least[(left ^ std::size_t{1} << to) * (size + 1) + to];
        known.far = std::min(known.far, leg(from, to).far + rest.far);
        known.price = std::min(known.price, leg(from, to).price + rest.price);
      }
    }
  }
  std::vector<int> order;
  const double slack = 1e-9 * (1.0 + route.far + route.price);
  const auto extend = [&](const auto& self, std::size_t left, std::size_t from,
                          const Label& sum) -> bool {
    const Label& rest = least[left * (size + 1) + from];
    if (sum.far + rest.far > route.far + slack || sum.price + rest.price > route.price + slack) {
      return false;
    }
    if (!left) return true;
    for (std::size_t to = 0; to < size; ++to) {
      if (!(left >> to & 1)) continue;
      const Label next = leg(from, to);
      order.push_back(tasks[to]);
      if (self(self, left ^ std::size_t{1} << to, to,
               {sum.far + next.far, sum.price + next.price})) {
        return true;
      }
      order.pop_back();
    }
    return false;
  };
  extend(extend, (std::size_t{1} << size) - 1, size, {0.0, 0.0});
  return order;
}

}  // namespace clearway::assign
