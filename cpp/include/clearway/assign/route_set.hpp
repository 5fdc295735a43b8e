// Routes of all robots in flat memory, with the legs that they are made of.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "clearway/assign/costs.hpp"

namespace clearway::assign {

class RouteSet {
 public:
  // `seats`: most tasks that a robot may have.
  RouteSet(const Costs& costs, int seats) : costs_(&costs), seats_(seats) {
    const auto m = static_cast<std::size_t>(costs.robots());
    count_.assign(m, 0);
    sum_.resize(m);
    robot_.assign(static_cast<std::size_t>(costs.tasks()), -1);
    reserve(2 * (costs.tasks() / std::max(costs.robots(), 1)) + 8);
  }

  int seats() const { return seats_; }
  int count(int k) const { return count_[index(k)]; }
  bool full(int k) const { return count(k) >= seats_; }
  // A route's numbers; the one after the last is the end.
  const int* nodes(int k) const { return &nodes_[index(k) * stride_]; }
  // The legs that lead to them; the one to the end costs nothing.
  const Leg* legs(int k) const { return &legs_[index(k) * stride_]; }
  std::span<const int> route(int k) const { return {nodes(k), index(count(k))}; }
  const Leg& sum(int k) const { return sum_[index(k)]; }
  // Whose task it is; -1: nobody's.
  int robot(int task) const { return robot_[index(task)]; }
  int position(int task) const {
    const int* first = nodes(robot(task));
    return static_cast<int>(std::find(first, first + count(robot(task)), task) - first);
  }

  double longest() const {
    double longest = 0.0;
    for (const Leg& sum : sum_) longest = std::max(longest, sum.distance);
    return longest;
  }
  double price() const {
    double price = 0.0;
    for (const Leg& sum : sum_) price += sum.price;
    return price;
  }

  void insert(int k, int position, int task) {
    reserve(count(k) + 1);
    int* first = &nodes_[index(k) * stride_];
    const int count = count_[index(k)]++;
    std::copy_backward(first + position, first + count, first + count + 1);
    first[position] = task;
    robot_[index(task)] = k;
    measure(k);
  }
  void erase(int k, int position, int number) {
    int* first = &nodes_[index(k) * stride_];
    for (int i = position; i < position + number; ++i) robot_[index(first[i])] = -1;
    std::copy(first + position + number, first + count(k), first + position);
    count_[index(k)] -= number;
    measure(k);
  }
  void assign(int k, std::span<const int> route) {
    reserve(static_cast<int>(route.size()));
    int* first = &nodes_[index(k) * stride_];
    std::copy(route.begin(), route.end(), first);
    for (const int task : route) robot_[index(task)] = k;
    count_[index(k)] = static_cast<int>(route.size());
    measure(k);
  }
  void assign(const Routes& routes) {
    for (std::size_t k = 0; k < routes.size(); ++k) assign(static_cast<int>(k), routes[k]);
  }
  // Take over another set's route, whose tasks nobody else has here.
  void copy(int k, const RouteSet& other) {
    reserve(other.count(k));
    const auto number = static_cast<std::ptrdiff_t>(other.count(k)) + 1;
    std::copy_n(other.nodes(k), number, &nodes_[index(k) * stride_]);
    std::copy_n(other.legs(k), number, &legs_[index(k) * stride_]);
    count_[index(k)] = other.count(k);
    sum_[index(k)] = other.sum(k);
    for (const int task : route(k)) robot_[index(task)] = k;
  }
  Routes routes() const {
    Routes routes;
    for (int k = 0; k < costs_->robots(); ++k) {
      routes.emplace_back(route(k).begin(), route(k).end());
    }
    return routes;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // Rows hold as many numbers as the longest route needed so far, so that they lie close together.
  void reserve(int number) {
    const std::size_t wanted = index(std::min(number, seats_)) + 1;
    if (wanted <= stride_) return;
    const std::size_t stride = std::min(std::max(wanted, 2 * stride_), index(seats_) + 1);
    std::vector<int> nodes(count_.size() * stride, costs_->end());
    std::vector<Leg> legs(count_.size() * stride);
    for (std::size_t k = 0; stride_ && k < count_.size(); ++k) {
      std::copy_n(nodes_.begin() + static_cast<std::ptrdiff_t>(k * stride_), stride_,
                  nodes.begin() + static_cast<std::ptrdiff_t>(k * stride));
      std::copy_n(legs_.begin() + static_cast<std::ptrdiff_t>(k * stride_), stride_,
                  legs.begin() + static_cast<std::ptrdiff_t>(k * stride));
    }
    nodes_.swap(nodes);
    legs_.swap(legs);
    stride_ = stride;
  }

  void measure(int k) {
    int* first = &nodes_[index(k) * stride_];
    Leg* legs = &legs_[index(k) * stride_];
    const int count = count_[index(k)];
    Leg sum;
    int here = costs_->end();
    for (int i = 0; i < count; ++i) {
      legs[i] = costs_->leg(k, here, first[i]);
      sum += legs[i];
      here = first[i];
    }
    first[count] = costs_->end();
    legs[count] = {};
    sum_[index(k)] = sum;
  }

  const Costs* costs_;
  int seats_;
  std::size_t stride_ = 0;
  std::vector<int> nodes_, count_, robot_;
  std::vector<Leg> legs_, sum_;
};

}  // namespace clearway::assign
