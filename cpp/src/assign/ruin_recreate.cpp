#include "clearway/assign/ruin_recreate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace clearway::assign {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kGain = 1e-9;         // a gain below this is rounding
constexpr double kFromLongest = 0.25;  // share of ruins that begin at the longest route
constexpr double kNearShare = 0.15, kAnywhereShare = 0.05;

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

std::int64_t rounds_for(const Costs& costs) {
  constexpr std::int64_t kPerTask = 4000, kTimesTasks = 22'000'000;
  constexpr std::int64_t kTimed = 20;  // a place is dearer to price where tasks are timed
  const std::int64_t n = std::max(costs.tasks(), 1);
  return std::min(kPerTask * n, kTimesTasks / n) / (costs.timed() ? kTimed : 1);
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

int RuinRecreate::pick_seed() {
  if (random_.unit() < kFromLongest) {
    int longest = 0;
    for (int k = 1; k < costs_.robots(); ++k) {
      if (here_.sum(k).distance > here_.sum(longest).distance) longest = k;
    }
    if (here_.count(longest) > 0) return here_.nodes(longest)[random_.below(here_.count(longest))];
  }
  return random_.below(costs_.tasks());
}

void RuinRecreate::touch(int robot) {
  auto& touched = is_touched_[static_cast<std::size_t>(robot)];
  if (touched) return;
  touched = 1;
  touched_.push_back(robot);
}

void RuinRecreate::take_out(int robot, int position, int number) {
  touch(robot);
  const int* first = here_.nodes(robot) + position;
  removed_.insert(removed_.end(), first, first + number);
  here_.erase(robot, position, number);
}

void RuinRecreate::ruin() {
  removed_.clear();
  const double kind = random_.unit();
  if (kind < kAnywhereShare) {
    ruin_anywhere();
  } else if (kind < kAnywhereShare + kNearShare) {
    ruin_near();
  } else {
    ruin_strings();
  }
}

// A string out of each of some neighbouring routes; every other time a few tasks amid it stay.
void RuinRecreate::ruin_strings() {
  const int n = costs_.tasks();
  const double mean_count = static_cast<double>(n) / costs_.robots();
  const double most = std::min(static_cast<double>(params_.longest_string), mean_count);
  const double strings = 4.0 * params_.removed / (1.0 + most) - 1.0;
  const int number = static_cast<int>(1.0 + random_.unit() * std::max(strings, 0.0));
  const int* order = near(pick_seed());
  int done = 0;
  for (int i = 0; i < n && done < number; ++i) {
    const int task = order[i], k = here_.robot(task);
    if (k < 0 || is_touched_[static_cast<std::size_t>(k)]) continue;
    const int count = here_.count(k), at = here_.position(task);
    const double limit = std::min(static_cast<double>(count), std::max(most, 1.0));
    const int length = std::min(count, static_cast<int>(1.0 + random_.unit() * limit));
    int stay = 0;
    if (length > 1 && length < count && random_.unit() < 0.5) {
      stay = 1;
      while (length + stay < count && random_.unit() < 0.5) ++stay;
    }
    const int span = length + stay;
    const int low = std::max(0, at - span + 1), high = std::min(at, count - span);
    const int first = low + random_.below(high - low + 1);
    if (stay == 0) {
      take_out(k, first, length);
    } else {
      const int before = 1 + random_.below(length - 1);
      take_out(k, first + before + stay, length - before);
      take_out(k, first, before);
    }
    ++done;
  }
}

// A task and some that are near it.
void RuinRecreate::ruin_near() {
  const int n = costs_.tasks();
  const int number = std::min(n, 1 + random_.below(2 * params_.removed));
  const int* order = near(pick_seed());
  for (int i = 0; i < n && static_cast<int>(removed_.size()) < number; ++i) {
    if (i && random_.unit() < 0.3) continue;
    take_out(here_.robot(order[i]), here_.position(order[i]), 1);
  }
}

void RuinRecreate::ruin_anywhere() {
  const int number = std::min(costs_.tasks(), 1 + random_.below(params_.removed));
  for (int i = 0; i < number; ++i) {
    const int task = random_.below(costs_.tasks());
    if (here_.robot(task) >= 0) take_out(here_.robot(task), here_.position(task), 1);
  }
}

// The best place for a task in a robot's route, if it is better than the best so far.
void RuinRecreate::look(int task, int robot, double longest, Place& best) {
  const int kind = costs_.kind(robot), count = here_.count(robot);
  const Leg* into = costs_.into(kind, task);
  const Leg* out_of = costs_.out_of(kind, task);
  const int* nodes = here_.nodes(robot);
  const Leg* legs = here_.legs(robot);
  const double weight = costs_.weights().longest;
  const double room = longest - here_.sum(robot).distance;
  // Kept out of memory, since this is where the time goes.
  double least = best.value;
  Leg added;
  int at = -1, until_blink = until_blink_;
  const Leg* to = &costs_.start(robot, task);
  for (int i = 0; i <= count; ++i) {
    const int node = nodes[i];
    if (--until_blink > 0) {
      const double price = to->price + out_of[node].price - legs[i].price;
      if (price < least) {
        const double distance = to->distance + out_of[node].distance - legs[i].distance;
        const double value = price + weight * std::max(0.0, distance - room);
        if (value < least) {
          least = value;
          added = {distance, price};
          at = i;
        }
      }
    } else {
      until_blink = next_blink();
    }
    to = &into[node];
  }
  until_blink_ = until_blink;
  if (at >= 0) best = {least, added, robot, at};
}

// Likewise where being late counts: no place is better than what it adds without that.
void RuinRecreate::look_timed(int task, int robot, double longest, Place& best) {
  const int count = here_.count(robot);
  const int* nodes = here_.nodes(robot);
  const Leg* legs = here_.legs(robot);
  const auto k = static_cast<std::size_t>(robot);
  for (int i = 0; i <= count; ++i) {
    if (--until_blink_ <= 0) {
      until_blink_ = next_blink();
      continue;
    }
    const Leg added = costs_.leg(robot, i ? nodes[i - 1] : costs_.end(), task) +
                      costs_.out_of(costs_.kind(robot), task)[nodes[i]] - legs[i];
    const double grown = here_.sum(robot).distance + added.distance - longest;
    double value = added.price + costs_.weights().longest * std::max(0.0, grown);
    if (value >= best.value) continue;
    trial_.assign(nodes, nodes + count);
    trial_.insert(trial_.begin() + i, task);
    schedule_.routes()[k] = trial_;
    const double late = schedule_.run();
    if (late == kNever) continue;
    value += costs_.weights().tardiness * (late - late_);
    if (value < best.value) best = {value, added, robot, i};
  }
  schedule_.routes()[k] = here_.route(robot);
}

void RuinRecreate::put(int task, const Place& place) {
  touch(place.robot);
  here_.insert(place.robot, place.position, task);
  if (costs_.timed()) late_ = tardiness();
}

// Random order, or those first that are near to a start, or far from all.
void RuinRecreate::sort_removed() {
  random_.shuffle(removed_);
  const int kind = random_.below(8);
  if (kind > 2) return;
  std::stable_sort(removed_.begin(), removed_.end(), [&](int a, int b) {
    const double difference = far_[static_cast<std::size_t>(a)] - far_[static_cast<std::size_t>(b)];
    return kind == 0 ? difference < 0.0 : difference > 0.0;
  });
}

bool RuinRecreate::recreate() {
  if (random_.unit() < params_.regret) return recreate_by_regret();
  sort_removed();
  double longest = here_.longest();
  for (const int task : removed_) {
    Place best{kNever, {}, -1, 0};
    for (int tries = 0; tries < 3 && best.robot < 0; ++tries) {  // blinks may hide all places
      for (int k = 0; k < costs_.robots(); ++k) {
        if (here_.full(k) || !costs_.allowed(k, task)) continue;
        if (costs_.timed()) {
          look_timed(task, k, longest, best);
        } else {
          look(task, k, longest, best);
        }
      }
    }
    if (best.robot < 0) return false;
    put(task, best);
    longest = std::max(longest, here_.sum(best.robot).distance);
  }
  return true;
}

// Next the task that would lose most by going to its second-best robot.
bool RuinRecreate::recreate_by_regret() {
  const auto m = static_cast<std::size_t>(costs_.robots());
  random_.shuffle(removed_);
  places_.resize(removed_.size() * m);
  double longest = here_.longest();
  const auto refresh = [&](std::size_t row, int k) {
    Place& place = places_[row * m + static_cast<std::size_t>(k)];
    place = {kNever, {}, -1, 0};
    const int task = removed_[row];
    if (here_.full(k) || !costs_.allowed(k, task)) return;
    if (costs_.timed()) {
      look_timed(task, k, longest, place);
    } else {
      look(task, k, longest, place);
    }
  };
  for (std::size_t row = 0; row < removed_.size(); ++row) {
    for (int k = 0; k < costs_.robots(); ++k) refresh(row, k);
  }
  while (!removed_.empty()) {
    std::size_t chosen = 0;
    double most = -kNever;
    Place place{kNever, {}, -1, 0};
    for (std::size_t row = 0; row < removed_.size(); ++row) {
      double best = kNever, second = kNever;
      const Place* first = nullptr;
      for (std::size_t k = 0; k < m; ++k) {
        const Place& known = places_[row * m + k];
        if (known.robot < 0) continue;
        if (known.value < best) {
          second = best;
          best = known.value;
          first = &known;
        } else {
          second = std::min(second, known.value);
        }
      }
      if (!first) continue;
      const double regret = second - best;
      if (regret > most || (regret == most && best < place.value)) {
        most = regret;
        place = *first;
        chosen = row;
      }
    }
    if (place.robot < 0) return false;
    const double before = longest;
    put(removed_[chosen], place);
    longest = std::max(longest, here_.sum(place.robot).distance);
    const std::size_t last = removed_.size() - 1;
    removed_[chosen] = removed_[last];
    std::copy_n(&places_[last * m], m, &places_[chosen * m]);
    removed_.pop_back();
    for (std::size_t row = 0; row < removed_.size(); ++row) {
      for (int k = 0; k < costs_.robots(); ++k) {
        Place& known = places_[row * m + static_cast<std::size_t>(k)];
        if (k == place.robot || (costs_.has_order() && costs_.timed())) {
          refresh(row, k);
        } else if (known.robot >= 0 && longest > before && !costs_.timed()) {
          const double grown = here_.sum(k).distance + known.added.distance - longest;
          known.value = known.added.price + costs_.weights().longest * std::max(0.0, grown);
        }
      }
    }
  }
  return true;
}

double RuinRecreate::tardiness() {
  for (int k = 0; k < costs_.robots(); ++k) {
    schedule_.routes()[static_cast<std::size_t>(k)] = here_.route(k);
  }
  return schedule_.run();
}

double RuinRecreate::worth() {
  const double value = here_.price() + costs_.weights().longest * here_.longest();
  return costs_.timed() ? value + costs_.weights().tardiness * late_ : value;
}

RuinRecreateResult RuinRecreate::operator()(const Routes& start, std::uint64_t seed,
                                            Budget& budget) {
  const std::int64_t rounds = params_.rounds.value_or(rounds_for(costs_));
  random_ = Random(seed);
  for (auto& gap : gaps_) {
    const double drawn = 1.0 + std::log(1.0 - random_.unit()) / std::log(1.0 - params_.blinks);
    gap = static_cast<std::uint8_t>(std::min(drawn, 255.0));
  }
  until_blink_ = gaps_[0];
  const int m = costs_.robots(), n = costs_.tasks();
  here_.assign(start);
  if (costs_.timed()) late_ = tardiness();
  double value = worth();
  RouteSet best = here_;
  kept_ = here_;
  double least = value;
  double late = late_;
  double temperature = 0.0, cooling = 1.0;
  for (std::int64_t round = 0; n > 0 && round < rounds && budget.spend(); ++round) {
    if (round == 0) {  // all tasks anew
      for (int k = 0; k < m; ++k) {
        if (here_.count(k)) take_out(k, 0, here_.count(k));
      }
    } else {
      ruin();
    }
    if (costs_.timed()) late_ = tardiness();
    const bool complete = round == 0 ? recreate_by_regret() : recreate();
    const double now = complete ? worth() : kNever;
    const double slack = -temperature * std::log(1.0 - random_.unit());
    if (now < value + slack) {
      value = now;
      late = late_;
      for (const int k : touched_) kept_.copy(k, here_);
      if (value < least - kGain) {
        least = value;
        for (int k = 0; k < m; ++k) best.copy(k, here_);
      }
    } else {
      for (const int k : touched_) here_.copy(k, kept_);
      late_ = late;
    }
    for (const int k : touched_) is_touched_[static_cast<std::size_t>(k)] = 0;
    touched_.clear();
    removed_.clear();
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
