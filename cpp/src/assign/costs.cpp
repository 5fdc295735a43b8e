#include "clearway/assign/costs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "clearway/assign/schedule.hpp"

namespace clearway::assign {

namespace {

void require_size(std::size_t size, std::size_t wanted, const char* name) {
  if (size != wanted) {
    throw std::invalid_argument(std::string(name) + " must have " + std::to_string(wanted) +
                                " entries, got " + std::to_string(size));
  }
}

}  // namespace

Costs::Costs(const Tables& tables)
    : robots_(tables.robots),
      tasks_(tables.tasks),
      kinds_(tables.kinds),
      kind_(tables.kind),
      allowed_(tables.allowed),
      inner_(tables.inner),
      service_(tables.service),
      due_(tables.due),
      weights_(tables.weights),
      speed_(tables.speed) {
  const auto m = static_cast<std::size_t>(robots_), n = static_cast<std::size_t>(tasks_);
  const auto kinds = static_cast<std::size_t>(kinds_);
  require_size(kind_.size(), m, "kind");
  require_size(tables.start.size(), m * n, "start");
  require_size(tables.start_turn.size(), m * n, "start_turn");
  require_size(tables.between.size(), kinds * n * n, "between");
  require_size(tables.turn.size(), n * n, "turn");
  require_size(inner_.size(), m * n, "inner");
  require_size(allowed_.size(), m * n, "allowed");
  require_size(service_.size(), n, "service");
  require_size(due_.size(), n, "due");
  std::vector<std::size_t> one(kinds, m);  // a robot of each kind
  for (std::size_t k = 0; k < m; ++k) {
    if (kind_[k] < 0 || kind_[k] >= kinds_) throw std::invalid_argument("kind out of range");
    one[static_cast<std::size_t>(kind_[k])] = k;
  }
  for (const double due : due_) timed_ = timed_ || std::isfinite(due);
  start_.resize(m * n);
  into_.resize(kinds * n * (n + 1));
  out_of_.resize(kinds * n * (n + 1));
  Leg dearest;
  double working = 0.0;
  for (const double service : service_) working += service;
  const auto leg = [&](double distance, double turn) {
    const Leg known{distance, weights_.total * distance + weights_.turning * turn};
    if (std::isfinite(distance)) {
      dearest.distance = std::max(dearest.distance, known.distance);
      dearest.price = std::max(dearest.price, known.price);
    }
    return known;
  };
  for (std::size_t i = 0; i < m * n; ++i) {
    start_[(i % n) * m + i / n] =
        leg(allowed_[i] ? tables.start[i] + inner_[i] : std::numeric_limits<double>::infinity(),
            tables.start_turn[i]);
  }
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    for (std::size_t from = 0; one[kind] < m && from < n; ++from) {
      for (std::size_t to = 0; to < n; ++to) {
        const double inner = inner_[one[kind] * n + to];
        const Leg known =
            leg(tables.between[(kind * n + from) * n + to] + inner, tables.turn[from * n + to]);
        out_of_[(kind * n + from) * (n + 1) + to] = known;
        into_[(kind * n + to) * (n + 1) + from] = known;
      }
    }
  }
  const double longest = dearest.distance * static_cast<double>(n);
  const double late = timed_ ? static_cast<double>(n) * (longest / speed_ + working) : 0.0;
  forbidden_ = 1.0 + 2.0 * (static_cast<double>(n) * dearest.price + weights_.longest * longest +
                            weights_.tardiness * late);
  for (auto* legs : {&start_, &into_, &out_of_}) {
    for (Leg& known : *legs) {
      if (!std::isfinite(known.distance)) known = {0.0, forbidden_};
    }
  }
  close(tables.before);
}

void Costs::close(const std::vector<std::pair<int, int>>& before) {
  const auto n = static_cast<std::size_t>(tasks_);
  followers_.resize(n);
  if (before.empty()) return;
  has_order_ = timed_ = true;
  std::vector<std::vector<int>> next(n);
  for (const auto& [first, second] : before)
    next[static_cast<std::size_t>(first)].push_back(second);
  std::vector<std::uint8_t> seen(n);
  for (std::size_t task = 0; task < n; ++task) {
    std::fill(seen.begin(), seen.end(), std::uint8_t{0});
    std::vector<int> open = next[task];
    while (!open.empty()) {
      const auto follower = static_cast<std::size_t>(open.back());
      open.pop_back();
      if (seen[follower]) continue;
      seen[follower] = 1;
      followers_[task].push_back(static_cast<int>(follower));
      open.insert(open.end(), next[follower].begin(), next[follower].end());
    }
  }
}

Leg Costs::sum(int robot, std::span<const int> route) const {
  Leg sum;
  int here = end();
  for (const int task : route) {
    sum += leg(robot, here, task);
    here = task;
  }
  return sum;
}

double Costs::value(const Routes& routes) const {
  Leg all;
  double longest = 0.0;
  for (int k = 0; k < robots_; ++k) {
    const Leg route = sum(k, routes[static_cast<std::size_t>(k)]);
    all += route;
    longest = std::max(longest, route.distance);
  }
  if (all.price >= forbidden_) return std::numeric_limits<double>::infinity();
  double value = all.price + weights_.longest * longest;
  if (timed_) {
    const double late = Schedule(*this).tardiness(routes);
    if (!std::isfinite(late)) return late;
    value += weights_.tardiness * late;
  }
  return value;
}

std::vector<double> values(const Costs& costs, std::span<const int> orders,
                           std::span<const int> cuts) {
  const auto m = static_cast<std::size_t>(costs.robots());
  const auto n = static_cast<std::size_t>(costs.tasks());
  const std::size_t sets = n ? orders.size() / n : cuts.size() / (m + 1);
  if (sets * n != orders.size()) throw std::invalid_argument("orders must have a column per task");
  if (cuts.size() != m + 1 && cuts.size() != sets * (m + 1)) {
    throw std::invalid_argument("cuts must have a column more than there are robots");
  }
  std::vector<double> out(sets);
  std::vector<std::uint8_t> seen(n);
  Routes routes(m);
  for (std::size_t i = 0; i < sets; ++i) {
    const auto order = orders.subspan(i * n, n);
    const auto cut = cuts.size() == m + 1 ? cuts : cuts.subspan(i * (m + 1), m + 1);
    std::fill(seen.begin(), seen.end(), std::uint8_t{0});
    for (const int task : order) {
      if (task < 0 || task >= costs.tasks() || seen[static_cast<std::size_t>(task)]++) {
        throw std::invalid_argument("orders[" + std::to_string(i) +
                                    "] must name each task once, but not " + std::to_string(task));
      }
    }
    if (cut.front() != 0 || cut.back() != costs.tasks() ||
        !std::is_sorted(cut.begin(), cut.end())) {
      throw std::invalid_argument("cuts[" + std::to_string(i) + "] must rise from 0 to " +
                                  std::to_string(n));
    }
    bool legal = true;
    for (std::size_t k = 0; k < m; ++k) {
      routes[k].assign(order.begin() + cut[k], order.begin() + cut[k + 1]);
      for (const int task : routes[k]) legal = legal && costs.allowed(static_cast<int>(k), task);
    }
    out[i] = legal ? costs.value(routes) : std::numeric_limits<double>::infinity();
  }
  return out;
}

}  // namespace clearway::assign
