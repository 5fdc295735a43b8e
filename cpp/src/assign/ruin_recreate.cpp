#include "clearway/assign/ruin_recreate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace clearway::assign {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kGain = 1e-9;  // a gain below this is rounding

void require(bool right, const char* what) {
  if (!right) throw std::invalid_argument(what);
}

}  // namespace

void RuinRecreateParams::check() const {
  require(!rounds || *rounds >= 0, "rounds must be 0 or above");
  require(removed >= 1, "removed must be 1 or above");
  require(longest_string >= 1, "longest_string must be 1 or above");
  require(blinks > 0.0 && blinks < 1.0, "blinks must be above 0 and below 1");
  require(regret >= 0.0 && regret <= 1.0, "regret must be in [0, 1]");
  require(last_temperature > 0.0 && last_temperature <= first_temperature &&
              std::isfinite(first_temperature),
          "last_temperature must be above 0 and at most first_temperature, and both finite");
}

std::int64_t rounds_for(const Costs& costs, int seats) {
  constexpr std::int64_t kPerTask = 7000, kTimesTasks = 40'000'000;
  constexpr std::int64_t kTimed = 4;  // a place is dearer to price where tasks are timed
  const std::int64_t n = std::max(costs.tasks(), 1);
  std::int64_t rounds = std::min(kPerTask * n, kTimesTasks / n);
  // Full robots have no places to price.
  if (seats * costs.robots() < costs.tasks() + costs.robots()) rounds *= 2;
  return costs.has_order() ? 6 * rounds / n : costs.timed() ? rounds / kTimed : rounds;
}

RuinRecreate::RuinRecreate(const Costs& costs, int seats, const RuinRecreateParams& params)
    : costs_(costs),
      seats_(seats),
      params_(params),
      schedule_(costs),
      here_(costs, seats),
      kept_(costs, seats) {
  const auto m = static_cast<std::size_t>(costs.robots());
  is_touched_.resize(m);
  far_.resize(static_cast<std::size_t>(costs.tasks()));
  rank_neighbours();
  for (int task = 0; task < costs.tasks(); ++task) {
    double& far = far_[static_cast<std::size_t>(task)] = kNever;
    for (int k = 0; k < costs.robots(); ++k) {
      if (costs.allowed(k, task)) far = std::min(far, costs.start(k, task).distance);
    }
  }
}

// Tasks are near that follow each other at a low price, for any robot and in either order.
void RuinRecreate::rank_neighbours() {
  const int n = costs_.tasks();
  near_.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  std::vector<double> price(static_cast<std::size_t>(n));
  for (int task = 0; task < n; ++task) {
    for (int other = 0; other < n; ++other) {
      double& least = price[static_cast<std::size_t>(other)];
      least = other == task ? -1.0 : kNever;
      for (int kind = 0; kind < costs_.kinds(); ++kind) {
        const Leg &to = costs_.out_of(kind, task)[other], &from = costs_.into(kind, task)[other];
        least = std::min({least, to.price + to.distance, from.price + from.distance});
      }
    }
    int* order = &near_[static_cast<std::size_t>(task) * static_cast<std::size_t>(n)];
    std::iota(order, order + n, 0);
    std::stable_sort(order, order + n, [&](int a, int b) {
      return price[static_cast<std::size_t>(a)] < price[static_cast<std::size_t>(b)];
    });
  }
}

// Delays after changes to the routes of the robots touched.
void RuinRecreate::time_again() {
  if (costs_.has_order()) {
    for (int k = 0; k < costs_.robots(); ++k) {
      schedule_.routes()[static_cast<std::size_t>(k)] = here_.route(k);
    }
    late_ = schedule_.run();
    return;
  }
  for (const int k : touched_) {
    double& late = late_by_[static_cast<std::size_t>(k)];
    late_ -= late;
    late = schedule_.tardiness_alone(k, here_.route(k));
    late_ += late;
  }
}

double RuinRecreate::worth() {
  const double value = here_.price() + costs_.weights().longest * here_.longest();
  return costs_.timed() ? value + costs_.weights().tardiness * late_ : value;
}

RuinRecreateResult RuinRecreate::operator()(const Routes& start, std::uint64_t seed,
                                            Budget& budget) {
  const std::int64_t rounds = params_.rounds.value_or(rounds_for(costs_, seats_));
  random_ = Random(seed);
  for (auto& gap : gaps_) {
    const double drawn = 1.0 + std::log(1.0 - random_.unit()) / std::log(1.0 - params_.blinks);
    gap = static_cast<std::uint8_t>(std::min(drawn, 255.0));
  }
  until_blink_ = gaps_[0];
  const int m = costs_.robots(), n = costs_.tasks();
  here_.assign(start);
  late_ = 0.0;
  late_by_.assign(static_cast<std::size_t>(m), 0.0);
  for (int k = 0; k < m; ++k) touch(k);  // all are new
  if (costs_.timed()) time_again();
  settle();
  double value = worth();
  RouteSet best = here_;
  kept_ = here_;
  double least = value;
  double temperature = 0.0, cooling = 1.0;
  for (std::int64_t round = 0; n > 0 && round < rounds && budget.spend(); ++round) {
    if (round == 0) {  // all tasks anew
      for (int k = 0; k < m; ++k) {
        if (here_.count(k)) take_out(k, 0, here_.count(k));
      }
    } else {
      ruin();
    }
    if (costs_.timed()) time_again();
    const bool complete = recreate(round == 0 ? 1.0 : params_.regret);
    const double now = complete ? worth() : kNever;
    const double slack = -temperature * std::log(1.0 - random_.unit());
    if (now < value + slack) {
      value = now;
      for (const int k : touched_) kept_.copy(k, here_);
      if (value < least - kGain) {
        least = value;
        for (int k = 0; k < m; ++k) best.copy(k, here_);
      }
    } else {
      for (const int k : touched_) here_.copy(k, kept_);
      if (costs_.timed()) time_again();
    }
    settle();
    if (round == 0) {
      const double leg = std::min(least, costs_.forbidden()) / n;
      temperature = params_.first_temperature * leg;
      cooling = std::pow(params_.last_temperature / params_.first_temperature,
                         1.0 / static_cast<double>(std::max<std::int64_t>(1, rounds)));
    }
    temperature *= cooling;
  }
  return {best.routes(), least};
}

}  // namespace clearway::assign
