// Which tasks are taken out.
#include <algorithm>

#include "clearway/assign/ruin_recreate.hpp"

namespace clearway::assign {

namespace {

constexpr double kFromLongest = 0.25;  // share of ruins that begin at the longest route
constexpr double kNearShare = 0.15, kAnywhereShare = 0.05;

}  // namespace

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

// What changed is kept or undone.
void RuinRecreate::settle() {
  for (const int k : touched_) is_touched_[static_cast<std::size_t>(k)] = 0;
  touched_.clear();
  removed_.clear();
}

void RuinRecreate::take_out(int robot, int position, int number) {
  touch(robot);
  const int* first = here_.nodes(robot) + position;
  removed_.insert(removed_.end(), first, first + number);
  here_.erase(robot, position, number);
}

void RuinRecreate::ruin() {
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

}  // namespace clearway::assign
