#include "clearway/assign/descent.hpp"

#include <algorithm>
#include <cmath>

namespace clearway::assign {

namespace {

constexpr double kGain = 1e-9;  // a gain below this is rounding

}  // namespace

Descent::Descent(const Costs& costs, int seats) : costs_(costs), seats_(seats), schedule_(costs) {
  sums_.resize(static_cast<std::size_t>(costs.robots()));
  timed_.resize(static_cast<std::size_t>(costs.robots()));
}

Leg Descent::sum(int robot, const int* seat) const {
  Leg sum;
  int here = costs_.end();
  for (int i = 0; i < seats_; ++i) {
    const int task = seat[i];
    if (task >= costs_.tasks()) continue;
    sum += costs_.leg(robot, here, task);
    if (!costs_.allowed(robot, task)) sum.price += costs_.forbidden();
    here = task;
  }
  return sum;
}

Routes Descent::routes(const Permutation& permutation) const {
  Routes routes(static_cast<std::size_t>(costs_.robots()));
  for (std::size_t i = 0; i < permutation.size(); ++i) {
    if (permutation[i] >= costs_.tasks()) continue;
    routes[i / static_cast<std::size_t>(seats_)].push_back(permutation[i]);
  }
  return routes;
}

// What it costs that tasks of the trial are late; one that is never done costs like one forbidden.
double Descent::lateness() {
  for (std::size_t k = 0; k < timed_.size(); ++k) {
    timed_[k].clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(seats_); ++i) {
      const int task = trial_[k * static_cast<std::size_t>(seats_) + i];
      if (task < costs_.tasks()) timed_[k].push_back(task);
    }
  }
  const double late = schedule_.tardiness(timed_);
  if (std::isfinite(late)) return costs_.weights().tardiness * late;
  return static_cast<double>(schedule_.left()) * costs_.forbidden();
}

double Descent::value(const Permutation& permutation) {
  ++evaluations_;
  here_ = trial_ = permutation;
  price_ = 0.0;
  double longest = 0.0;
  for (int k = 0; k < costs_.robots(); ++k) {
    const Leg sum = this->sum(k, &here_[static_cast<std::size_t>(k * seats_)]);
    sums_[static_cast<std::size_t>(k)] = sum;
    price_ += sum.price;
    longest = std::max(longest, sum.distance);
  }
  value_ = price_ + costs_.weights().longest * longest;
  if (costs_.timed()) value_ += lateness();
  return value_;
}

double Descent::longest_of_others(int a, int b) const {
  double longest = 0.0;
  for (int k = 0; k < costs_.robots(); ++k) {
    if (k != a && k != b) longest = std::max(longest, sums_[static_cast<std::size_t>(k)].distance);
  }
  return longest;
}

// Whether the trial, changed in robots a and b, is better; if not, it is made as before.
bool Descent::improves(int a, int b) {
  ++evaluations_;
  const auto at = [&](int robot) { return static_cast<std::ptrdiff_t>(robot * seats_); };
  sum_a_ = sum(a, &trial_[static_cast<std::size_t>(at(a))]);
  double price = price_ + sum_a_.price - sums_[static_cast<std::size_t>(a)].price;
  double longest = sum_a_.distance;
  if (b != a) {
    sum_b_ = sum(b, &trial_[static_cast<std::size_t>(at(b))]);
    price += sum_b_.price - sums_[static_cast<std::size_t>(b)].price;
    longest = std::max(longest, sum_b_.distance);
  }
  bool better = budget_->spend() && price < value_ - kGain;
  if (better) {
    longest = std::max(longest, longest_of_others(a, b));
    trial_value_ = price + costs_.weights().longest * longest;
    better = trial_value_ < value_ - kGain;
  }
  if (better && costs_.timed()) {
    trial_value_ += lateness();
    better = trial_value_ < value_ - kGain;
  }
  if (better) {
    price_ = price;
    value_ = trial_value_;
    sums_[static_cast<std::size_t>(a)] = sum_a_;
    if (b != a) sums_[static_cast<std::size_t>(b)] = sum_b_;
  }
  const Permutation& from = better ? trial_ : here_;
  Permutation& to = better ? here_ : trial_;
  for (const int robot : {a, b}) {
    std::copy_n(from.begin() + at(robot), seats_, to.begin() + at(robot));
  }
  return better;
}

bool Descent::swap_pairs() {
  bool better = false;
  const int size = this->size(), n = costs_.tasks();
  for (int i = 0; i < size; ++i) {
    for (int j = i + 1; j < size; ++j) {
      int &one = trial_[static_cast<std::size_t>(i)], &other = trial_[static_cast<std::size_t>(j)];
      if (one >= n && other >= n) continue;
      std::swap(one, other);
      better |= improves(i / seats_, j / seats_);
    }
  }
  return better;
}

bool Descent::move_within() {
  bool better = false;
  for (int k = 0; k < costs_.robots(); ++k) {
    for (int i = 0; i < seats_; ++i) {
      for (int j = 0; j < seats_; ++j) {
        if (j == i || j == i - 1) continue;
        const auto first = trial_.begin() + k * seats_;
        if (i < j) std::rotate(first + i, first + i + 1, first + j + 1);
        if (j < i) std::rotate(first + j, first + i, first + i + 1);
        better |= improves(k, k);
      }
    }
  }
  return better;
}

bool Descent::reverse_within() {
  bool better = false;
  for (int k = 0; k < costs_.robots(); ++k) {
    for (int i = 0; i < seats_; ++i) {
      for (int j = i + 2; j < seats_; ++j) {
        const auto first = trial_.begin() + k * seats_;
        std::reverse(first + i, first + j + 1);
        better |= improves(k, k);
      }
    }
  }
  return better;
}

bool Descent::exchange_tails() {
  bool better = false;
  for (int a = 0; a < costs_.robots(); ++a) {
    for (int b = a + 1; b < costs_.robots(); ++b) {
      for (int i = 0; i + 1 < seats_; ++i) {
        const auto first = trial_.begin();
        std::swap_ranges(first + a * seats_ + i, first + (a + 1) * seats_, first + b * seats_ + i);
        better |= improves(a, b);
      }
    }
  }
  return better;
}

double Descent::operator()(Permutation& permutation, Budget& budget) {
  budget_ = &budget;
  value(permutation);
  for (bool better = true; better;) {
    better = swap_pairs();
    better |= move_within();
    better |= reverse_within();
    better |= exchange_tails();
  }
  permutation = here_;
  return value_;
}

}  // namespace clearway::assign
