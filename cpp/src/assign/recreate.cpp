// Where tasks are put back.
#include <algorithm>
#include <limits>

#include "clearway/assign/ruin_recreate.hpp"

namespace clearway::assign {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

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
  Leg added = best.added;
  int at = -1, until_blink = until_blink_;
  const Leg* to = &costs_.start(robot, task);
  for (int i = 0; i <= count; ++i) {
    const int node = nodes[i];
    if (--until_blink > 0) {
      const double price = to->price + out_of[node].price - legs[i].price;
      if (price <= least) {
        const double distance = to->distance + out_of[node].distance - legs[i].distance;
        const double value = price + weight * std::max(0.0, distance - room);
        // Where only the longest route counts, many places cost nothing; the shortest way wins.
        if (value < least || (value == least && distance < added.distance)) {
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
    double later = 0.0;
    if (costs_.has_order()) {
      schedule_.routes()[k] = trial_;
      later = schedule_.run() - late_;
      if (later == kNever) continue;
    } else {
      later = schedule_.tardiness_alone(robot, trial_) - late_by_[k];
    }
    value += costs_.weights().tardiness * later;
    if (value < best.value) best = {value, added, robot, i};
  }
  if (costs_.has_order()) schedule_.routes()[k] = here_.route(robot);
}

void RuinRecreate::put(int task, const Place& place) {
  touch(place.robot);
  here_.insert(place.robot, place.position, task);
  if (costs_.timed()) time_again();
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

bool RuinRecreate::recreate(double regret) {
  // Where tasks wait for others, each one put back changes the price of all places.
  return random_.unit() < regret && !costs_.has_order() ? recreate_by_regret() : recreate_in_turn();
}

bool RuinRecreate::recreate_in_turn() {
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
        if (k == place.robot) {
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

}  // namespace clearway::assign
