// First-improvement descent over even splits, written as permutations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clearway/assign/costs.hpp"
#include "clearway/assign/schedule.hpp"
#include "clearway/budget.hpp"

namespace clearway::assign {

// A permutation of as many numbers as there are seats: robot k has those from k * seats on; numbers
// from `tasks` on stand for tasks of no cost.
using Permutation = std::vector<int>;

class Descent {
 public:
  Descent(const Costs& costs, int seats);

  int seats() const { return seats_; }
  int size() const { return seats_ * costs_.robots(); }
  // The objective; what is not legal costs more than anything that is.
  double value(const Permutation& permutation);
  // Swap pairs, move or reverse parts within a robot, exchange equally long tails, as long as
  // something gets better and the budget lasts, a neighbour each; returns the value reached.
  double operator()(Permutation& permutation, Budget& budget);
  Routes routes(const Permutation& permutation) const;
  std::int64_t evaluations() const { return evaluations_; }

 private:
  Leg sum(int robot, const int* seat) const;
  bool improves(int a, int b);
  bool swap_pairs();
  bool move_within();
  bool reverse_within();
  bool exchange_tails();
  double longest_of_others(int a, int b) const;
  double lateness();

  const Costs& costs_;
  int seats_;
  Schedule schedule_;
  Permutation here_, trial_;  // the trial differs from here in one or two robots
  std::vector<Leg> sums_;
  std::vector<std::vector<int>> timed_;  // routes without tasks of no cost
  Leg sum_a_, sum_b_;
  double price_ = 0.0, value_ = 0.0, trial_value_ = 0.0;
  std::int64_t evaluations_ = 0;
  Budget* budget_ = nullptr;
};

}  // namespace clearway::assign
