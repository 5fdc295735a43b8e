#include "clearway/assign/exact.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace clearway::assign {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kGain = 1e-9;  // a gain below this is rounding
constexpr int kSteps = 40;      // on task prices, per interval

using Columns = std::vector<PooledRoute>;  // by robot, then by set

struct Prices {
  std::vector<double> of_task;
  std::vector<double> of_robot;  // the least that its routes cost beyond their tasks' prices
  double bound = -kNever;        // on the sum of route prices
};

// Sums of task prices by set, in two halves.
class SetSums {
 public:
  explicit SetSums(const std::vector<double>& price) {
    for (std::size_t half = 0; half < 2; ++half) {
      sums_[half][0] = 0.0;
      for (TaskSet s = 1; s < 256; ++s) {
        const auto task = half * 8 + static_cast<std::size_t>(std::countr_zero(s));
        sums_[half][s] = sums_[half][s & (s - 1)] + (task < price.size() ? price[task] : 0.0);
      }
    }
  }
  double operator()(TaskSet tasks) const { return sums_[0][tasks & 255] + sums_[1][tasks >> 8]; }

 private:
  std::array<std::array<double, 256>, 2> sums_;
};

class Cover {
 public:
  Cover(const Costs& costs, double best, Budget& budget)
      : costs_(costs), best_(best), budget_(budget) {}

  // Look for something better whose longest route is worth `low` up to `high`.
  void search(Columns columns, double low, double high, std::vector<double> task_prices);

  double best() const { return best_; }
  const Columns& chosen() const { return chosen_; }
  std::int64_t branchings() const { return branchings_; }

 private:
  Prices raise(const Columns& columns, double low, std::vector<double> task_prices) const;
  void combine(const Columns& columns, double low, const Prices& prices);
  void branch(TaskSet left, double bound, double price, double far);
  void finish(TaskSet left, double price, double far);
  void keep(double price);

  const Costs& costs_;
  double best_;
  Budget& budget_;
  Columns chosen_;
  std::int64_t branchings_ = 0;
  // While putting together:
  const Columns* columns_ = nullptr;
  struct Choice {
    PooledRoute route;
    double beyond;  // its price beyond those of its tasks and its robot
  };
  std::vector<std::vector<Choice>> with_task_;  // choices that hold a task, by beyond
  std::vector<int> branch_order_;
  std::vector<std::uint8_t> used_;
  Columns stack_;
};

// Subgradient steps towards the task prices that raise the bound most.
Prices Cover::raise(const Columns& columns, double low, std::vector<double> task_prices) const {
  const auto m = static_cast<std::size_t>(costs_.robots());
  Prices best;
  std::vector<double> least(m);
  std::vector<TaskSet> held(m);
  double size = 1.0;
  int since = 0;
  for (int round = 0; round < kSteps; ++round) {
    const SetSums sums(task_prices);
    std::fill(least.begin(), least.end(), kNever);
    for (const PooledRoute& route : columns) {
      const auto k = static_cast<std::size_t>(route.robot);
      const double beyond = route.price - sums(route.tasks);
      if (beyond >= least[k]) continue;
      least[k] = beyond;
      held[k] = route.tasks;
    }
    double bound = 0.0;
    for (const double price : task_prices) bound += price;
    for (const double beyond : least) bound += beyond;
    if (bound > best.bound) {
      best = {task_prices, least, bound};
      since = 0;
    } else if (++since == 4) {
      size *= 0.6;
      since = 0;
    }
    if (low + best.bound >= best_ - kGain) return best;
    double norm = 0.0;
    std::vector<int> excess(task_prices.size(), 1);
    for (const TaskSet tasks : held) {
      for (TaskSet s = tasks; s; s &= s - 1)
        --excess[static_cast<std::size_t>(std::countr_zero(s))];
    }
    for (const int e : excess) norm += e * e;
    if (norm == 0.0) return best;
    const double step = size * std::max(best_ - low - bound, 1e-3) / norm;
    for (std::size_t j = 0; j < excess.size(); ++j) task_prices[j] += step * excess[j];
  }
  return best;
}

void Cover::search(Columns columns, double low, double high, std::vector<double> task_prices) {
  constexpr std::size_t kFew = 40;  // columns per robot that are put together without ado
  std::erase_if(columns, [&](const PooledRoute& route) { return route.far > high; });
  const Prices prices = raise(columns, low, std::move(task_prices));
  const SetSums sums(prices.of_task);
  std::erase_if(columns, [&](const PooledRoute& route) {
    const double beyond =
        route.price - sums(route.tasks) - prices.of_robot[static_cast<std::size_t>(route.robot)];
    return prices.bound + beyond + std::max(low, route.far) >= best_ - kGain;
  });
  if (columns.empty() || budget_.ended) return;
  std::vector<double> fars;
  for (const PooledRoute& route : columns) {
    if (route.far > low) fars.push_back(route.far);
  }
  if (columns.size() <= kFew * static_cast<std::size_t>(costs_.robots()) || fars.empty()) {
    combine(columns, low, prices);
    return;
  }
  std::sort(fars.begin(), fars.end());
  fars.erase(std::unique(fars.begin(), fars.end()), fars.end());
  if (fars.size() == 1) {
    // Either nobody drives that far, or somebody does.
    search(columns, low, low, prices.of_task);
    if (low < fars[0]) {
      Columns all = columns;
      const Prices raised = raise(all, fars[0], prices.of_task);
      combine(all, fars[0], raised);
    }
    return;
  }
  const std::size_t half = fars.size() / 2;
  search(columns, low, fars[half - 1], prices.of_task);
  search(std::move(columns), fars[half], fars.back(), prices.of_task);
}

void Cover::combine(const Columns& columns, double low, const Prices& prices) {
  const auto n = static_cast<std::size_t>(costs_.tasks());
  const SetSums sums(prices.of_task);
  columns_ = &columns;
  with_task_.assign(n, {});
  used_.assign(static_cast<std::size_t>(costs_.robots()), 0);
  for (const PooledRoute& route : columns) {
    const double beyond =
        route.price - sums(route.tasks) - prices.of_robot[static_cast<std::size_t>(route.robot)];
    for (TaskSet s = route.tasks; s; s &= s - 1) {
      with_task_[static_cast<std::size_t>(std::countr_zero(s))].push_back({route, beyond});
    }
  }
  branch_order_.clear();
  for (std::size_t j = 0; j < n; ++j) {
    branch_order_.push_back(static_cast<int>(j));
    std::stable_sort(with_task_[j].begin(), with_task_[j].end(),
                     [](const Choice& a, const Choice& b) { return a.beyond < b.beyond; });
  }
  std::stable_sort(branch_order_.begin(), branch_order_.end(), [&](int a, int b) {
    return with_task_[static_cast<std::size_t>(a)].size() <
           with_task_[static_cast<std::size_t>(b)].size();
  });
  stack_.clear();
  branch(static_cast<TaskSet>((std::uint64_t{1} << n) - 1), prices.bound, 0.0, low);
}

void Cover::keep(double price) {
  double longest = 0.0;
  for (const PooledRoute& route : stack_) longest = std::max(longest, route.far);
  if (price + longest >= best_ - kGain) return;
  best_ = price + longest;
  chosen_ = stack_;
}

// The last robot has to do all that is left.
void Cover::finish(TaskSet left, double price, double far) {
  const auto robot =
      static_cast<int>(std::find(used_.begin(), used_.end(), std::uint8_t{0}) - used_.begin());
  const auto before = [](const PooledRoute& a, const PooledRoute& b) {
    return a.robot != b.robot ? a.robot < b.robot : a.tasks < b.tasks;
  };
  const auto [first, last] = std::equal_range(columns_->begin(), columns_->end(),
                                              PooledRoute{left, robot, 0.0, 0.0}, before);
  for (auto route = first; route != last; ++route) {
    if (price + route->price + std::max(far, route->far) >= best_ - kGain) continue;
    ++branchings_;
    stack_.push_back(*route);
    keep(price + route->price);
    stack_.pop_back();
  }
}

// `bound` is on the sum of prices of all solutions with the routes on the stack.
void Cover::branch(TaskSet left, double bound, double price, double far) {
  if (!left) {
    keep(price);
    return;
  }
  if (stack_.size() + 1 == used_.size()) {
    finish(left, price, far);
    return;
  }
  int task = 0;
  for (const int next : branch_order_) {
    if (!(left >> next & 1)) continue;
    task = next;
    break;
  }
  for (const Choice& choice : with_task_[static_cast<std::size_t>(task)]) {
    if (bound + choice.beyond + far >= best_ - kGain) return;
    const PooledRoute& route = choice.route;
    auto& used = used_[static_cast<std::size_t>(route.robot)];
    const double farther = std::max(far, route.far);
    if (used || (route.tasks & ~left) || bound + choice.beyond + farther >= best_ - kGain) continue;
    if (!budget_.spend()) return;
    ++branchings_;
    used = 1;
    stack_.push_back(route);
    branch(left & ~route.tasks, bound + choice.beyond, price + route.price, farther);
    stack_.pop_back();
    used = 0;
  }
}

}  // namespace

ExactResult solve_exactly(const Costs& costs, int seats, const Routes& start, Budget& budget) {
  ExactResult result;
  result.routes = start;
  if (costs.tasks() == 0) {
    result.proven = true;
    return result;
  }
  const double known = std::min(costs.value(start), costs.forbidden());
  const RoutePool pool(costs, seats, known - kGain);
  result.pooled = static_cast<std::int64_t>(pool.routes().size());
  Cover cover(costs, known, budget);
  std::vector<double> prices(static_cast<std::size_t>(costs.tasks()),
                             known / (1.0 + costs.tasks()));
  double high = 0.0;
  for (const PooledRoute& route : pool.routes()) high = std::max(high, route.far);
  cover.search(pool.routes(), pool.least_far(), high, std::move(prices));
  result.branchings = cover.branchings();
  result.proven = !budget.ended;
  if (cover.best() < known - kGain) {
    result.routes.assign(static_cast<std::size_t>(costs.robots()), {});
    for (const PooledRoute& route : cover.chosen()) {
      result.routes[static_cast<std::size_t>(route.robot)] = pool.order(route);
    }
  }
  return result;
}

}  // namespace clearway::assign
