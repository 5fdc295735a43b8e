// What it costs robots to go from task to task: the core's mirror of an assignment problem.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace clearway::assign {

struct Weights {
  double longest = 1.0, total = 1.0, turning = 1.0, tardiness = 1.0;
};

// A leg's distance (m), the way within the task that it leads to included, and what it adds to the
// weighted sum of distances and turns.
struct Leg {
  double distance = 0.0, price = 0.0;

  Leg& operator+=(const Leg& leg) {
    distance += leg.distance;
    price += leg.price;
    return *this;
  }
  Leg& operator-=(const Leg& leg) {
    distance -= leg.distance;
    price -= leg.price;
    return *this;
  }
  friend Leg operator+(Leg a, const Leg& b) { return a += b; }
  friend Leg operator-(Leg a, const Leg& b) { return a -= b; }
};

// Arrays of an assignment problem, row by row. Robots of one `kind` drive alike from task to task.
struct Tables {
  int robots = 0, tasks = 0, kinds = 0;
  std::vector<int> kind;                  // per robot
  std::vector<double> start, start_turn;  // robots x tasks
  std::vector<double> between;            // kinds x tasks x tasks
  std::vector<double> turn;               // tasks x tasks
  std::vector<double> inner;              // robots x tasks, alike within a kind
  std::vector<std::uint8_t> allowed;      // robots x tasks
  Weights weights;
  double speed = 1.0;
  std::vector<double> service, due;         // per task
  std::vector<std::pair<int, int>> before;  // no circle
};

using Routes = std::vector<std::vector<int>>;

// Legs laid out for searching. Number `tasks()` stands for the start, and for the end of a route.
// A leg that may not be driven has no distance and a price that no sum of others reaches.
class Costs {
 public:
  explicit Costs(const Tables& tables);

  int robots() const { return robots_; }
  int tasks() const { return tasks_; }
  int end() const { return tasks_; }
  int kinds() const { return kinds_; }
  int kind(int robot) const { return kind_[static_cast<std::size_t>(robot)]; }
  bool allowed(int robot, int task) const { return allowed_[at(robot, task)] != 0; }
  const Weights& weights() const { return weights_; }
  double forbidden() const { return forbidden_; }
  bool timed() const { return timed_; }
  double speed() const { return speed_; }
  double service(int task) const { return service_[static_cast<std::size_t>(task)]; }
  double due(int task) const { return due_[static_cast<std::size_t>(task)]; }
  double inner(int robot, int task) const { return inner_[at(robot, task)]; }
  // Tasks that must wait for this one, however many lie between.
  const std::vector<int>& followers(int task) const {
    return followers_[static_cast<std::size_t>(task)];
  }
  bool has_order() const { return has_order_; }

  // Legs that lead to a task from each number, the start included, and from it to each, the end
  // included.
  const Leg* into(int kind, int task) const { return &into_[row(kind, task)]; }
  const Leg* out_of(int kind, int task) const { return &out_of_[row(kind, task)]; }
  const Leg& start(int robot, int task) const { return starts(task)[robot]; }
  // From the start of each robot.
  const Leg* starts(int task) const {
    return &start_[static_cast<std::size_t>(task) * static_cast<std::size_t>(robots_)];
  }
  const Leg& leg(int robot, int from, int to) const {
    return from == tasks_ ? start(robot, to) : out_of(kind(robot), from)[to];
  }

  // Sum of a route's legs.
  Leg sum(int robot, std::span<const int> route) const;
  // The objective; infinite where a leg may not be driven or routes wait for each other.
  double value(const Routes& routes) const;

 private:
  std::size_t at(int robot, int task) const {
    return static_cast<std::size_t>(robot) * static_cast<std::size_t>(tasks_) +
           static_cast<std::size_t>(task);
  }
  std::size_t row(int kind, int task) const {
    return (static_cast<std::size_t>(kind) * static_cast<std::size_t>(tasks_) +
            static_cast<std::size_t>(task)) *
           static_cast<std::size_t>(tasks_ + 1);
  }
  void close(const std::vector<std::pair<int, int>>& before);

  int robots_, tasks_, kinds_;
  std::vector<int> kind_;
  std::vector<std::uint8_t> allowed_;
  std::vector<Leg> start_, into_, out_of_;
  std::vector<double> inner_, service_, due_;
  std::vector<std::vector<int>> followers_;
  Weights weights_;
  double speed_, forbidden_ = 0.0;
  bool timed_ = false, has_order_ = false;
};

// Values of many sets of routes. A set is an order of tasks, cut into one route per robot:
// `orders` is sets x tasks; `cuts` is robots + 1 positions, for each set or the same for all.
std::vector<double> values(const Costs& costs, std::span<const int> orders,
                           std::span<const int> cuts);

}  // namespace clearway::assign
