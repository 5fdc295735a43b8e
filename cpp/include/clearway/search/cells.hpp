// Which safe intervals have been expanded where: the closed list of interval search.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "clearway/motion/table.hpp"

namespace clearway {

// Reached at `begin` for `cost`; whoever comes until `end` could have waited here instead.
struct Interval {
  Ticks begin = 0, end = 0;
  double cost = 0.0;
  Ticks met = 0;    // when somebody is in the way, just after `end`
  Ticks free = -1;  // when the place is free again; negative: nobody has asked yet
};

// Open-addressed map from (cell, heading, leg, mode class) to intervals.
class Cells {
 public:
  static constexpr std::size_t kMostLegs = 1 << 14, kMostModes = 63;
  static constexpr int kMostHeadings = 256;

  Cells() : slots_(1U << 12) {}

  // Forget everything. `cell` (m); `waiting`: cost of a tick of waiting.
  void reset(double cell, double waiting) {
    inverse_ = 1.0 / cell;
    waiting_ = waiting;
    by_mode_ = false;
    used_ = 0;
    entries_.clear();
    ++round_;
  }

  // Whether mode tells states apart (it does where a switch costs something).
  void distinguish_modes(bool yes) { by_mode_ = yes; }

  // An interval that makes arriving at t for `cost` (plus waiting) pointless, or null.
  const Interval* covering(double x, double y, int k, int leg, int mode, Ticks t, double cost,
                           Ticks waited) const {
    const Slot& slot = slots_[find(key(x, y, k, leg, mode))];
    if (slot.round != round_) return nullptr;
    const double total = cost + waiting_ * waited;
    for (std::int32_t i = slot.head; i >= 0; i = entries_[static_cast<std::size_t>(i)].next) {
      const Interval& seen = entries_[static_cast<std::size_t>(i)].interval;
      if (seen.begin <= t && t <= seen.end &&
          seen.cost + waiting_ * (t - seen.begin) <= total + 1e-9) {
        return &seen;
      }
    }
    return nullptr;
  }

  // The interval that ends when somebody is met at that tick, or null.
  Interval* meeting(double x, double y, int k, int leg, int mode, Ticks met) {
    const Slot& slot = slots_[find(key(x, y, k, leg, mode))];
    if (slot.round != round_) return nullptr;
    for (std::int32_t i = slot.head; i >= 0; i = entries_[static_cast<std::size_t>(i)].next) {
      Interval& seen = entries_[static_cast<std::size_t>(i)].interval;
      if (seen.met == met) return &seen;
    }
    return nullptr;
  }

  void add(double x, double y, int k, int leg, int mode, const Interval& interval) {
    if (4 * (used_ + 1) > 3 * slots_.size()) grow();
    const std::uint64_t wanted = key(x, y, k, leg, mode);
    Slot& slot = slots_[find(wanted)];
    if (slot.round != round_) {
      slot = {wanted, -1, round_};
      ++used_;
    }
    entries_.push_back({interval, slot.head});
    slot.head = static_cast<std::int32_t>(entries_.size()) - 1;
  }

 private:
  static constexpr double kShift = 1 << 17;

  struct Slot {
    std::uint64_t key = 0;
    std::int32_t head = -1;
    std::uint32_t round = 0;  // of an earlier reset: empty
  };
  struct Entry {
    Interval interval;
    std::int32_t next;
  };

  std::uint64_t key(double x, double y, int k, int leg, int mode) const {
    // Shifted to be positive, so that truncation rounds down.
    const auto ix =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(x * inverse_ + kShift)) & 0x3FFFF;
    const auto iy =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(y * inverse_ + kShift)) & 0x3FFFF;
    const auto m = static_cast<std::uint64_t>(by_mode_ ? mode + 1 : 0);
    // 18 bits each for x and y, 8 for the heading, 14 for the leg, 6 for the mode.
    return ix | iy << 18 | static_cast<std::uint64_t>(k) << 36 |
           static_cast<std::uint64_t>(leg) << 44 | m << 58;
  }
  std::size_t find(std::uint64_t wanted) const {
    std::uint64_t h = wanted * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 32;
    std::size_t i = h & (slots_.size() - 1);
    while (slots_[i].round == round_ && slots_[i].key != wanted) i = (i + 1) & (slots_.size() - 1);
    return i;
  }
  void grow() {
    std::vector<Slot> old(slots_.size() * 2);
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.round == round_) slots_[find(slot.key)] = slot;
    }
  }

  double inverse_ = 1.0, waiting_ = 1.0;
  bool by_mode_ = false;
  std::size_t used_ = 0;
  std::uint32_t round_ = 1;
  std::vector<Slot> slots_;
  std::vector<Entry> entries_;
};

}  // namespace clearway
