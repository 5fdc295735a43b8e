// Prioritised planning of a team: one after another, with soft search, rip-up and restarts.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "clearway/multi/team.hpp"

namespace clearway {

// What the sum over robots, or the last of them, is to be least of.
enum class Aim { kSumOfCosts, kMakespan };

struct TeamParams {
  SearchParams search;
  Objective objective;
  Aim aim = Aim::kSumOfCosts;
  double margin = 0.01;         // gap kept where the robots' clearance asks for less (m)
  double first_penalty = 5.0;   // soft search: price of running into a robot (s)
  double penalty_growth = 1.5;  // each time a robot is ripped up
  double first_hold = 5.0;      // see hold_ (s); doubled up to last_hold
  double last_hold = 80.0;
  double jitter = 0.3;                // random share of the planning order after a restart
  std::int64_t search_limit = 15000;  // expansions per leg of one search
  std::int64_t alone_limit = 400000;  // for the proof that a robot is stuck alone
  int restarts = 1000;
  std::int64_t repair_limit = 3000;  // expansions per leg of one search that improves a plan
  int neighbourhood = 8;             // most robots planned anew at once
};

struct TeamResult {
  enum class Status { kSolved, kStopped, kStuck };
  Status status = Status::kStopped;
  std::vector<TourResult> tours;  // empty pieces where a robot is not planned
  std::vector<bool> planned;
  std::vector<int> concerned;          // robots without a plan, or stuck
  Ticks conflict_free_until = kNever;  // sooner where what is fixed runs over an unplanned robot
  std::int64_t expansions = 0;
  std::int64_t first_expansions = 0;  // until the first complete plan
  std::int64_t first_cost = 0;        // its sum of arrivals (ticks)
  int searches = 0, rip_ups = 0, restarts = 0;
  int repairs = 0, repaired = 0;  // neighbourhoods planned anew, and kept
  int full = 0;                   // searches that stopped since they would have kept too much
};

// Robots planned, robots in all, expansions, and the sum of arrivals of a complete plan (ticks;
// negative before there is one).
using Progress =
    std::function<void(int planned, int total, std::int64_t expansions, std::int64_t cost)>;

// First complete plan of a team; leaves it in the team.
class PrioritisedPlanner {
 public:
  PrioritisedPlanner(Team& team, const TeamParams& params, const Progress& progress);

  // To be called once.
  TeamResult operator()(std::uint32_t seed, Budget& budget);

 private:
  enum class Attempt { kDone, kAgain, kStuck, kOver };

  bool alone(std::size_t i, Budget& budget);
  void find_precedence(const std::vector<std::size_t>& order, Budget& budget);
  std::vector<std::size_t> by_precedence(std::vector<std::size_t> order) const;
  Attempt attempt(std::vector<std::size_t> order, Budget& budget);
  void keep_best();
  double first_meeting(const Traffic& others, int other, std::size_t i) const;
  void settle(TeamResult& result) const;
  Ticks hold(std::size_t i) const { return static_cast<Ticks>(hold_[i] * kTicksPerSecond); }
  std::int64_t limit(std::size_t i) const {
    return params_.search_limit * static_cast<std::int64_t>(team_.agent(i).legs.size());
  }

  Team& team_;
  const TeamParams& params_;
  const Progress& progress_;
  // Robots not planned yet are ignored, and so may be run over before they can leave. A robot to
  // whom that happened stands at its start for this long (s) in the eyes of those planned before
  // it.
  std::vector<double> hold_;
  std::vector<int> times_hit_;
  std::vector<double> penalty_;
  // Who is better planned after me: those whose final rest my lone way crosses, and those whose
  // lone way crosses my start.
  std::vector<std::vector<std::size_t>> followers_;
  std::vector<bool> can_alone_;
  std::size_t failed_ = 0;
  TeamResult best_;
};

}  // namespace clearway
