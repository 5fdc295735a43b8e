// Prioritised planning of a team: one after another, with soft search, rip-up and restarts.
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "clearway/search/tour_search.hpp"

namespace clearway {

// A robot of the team. One with `fixed` pieces, or without legs, is not planned but avoided.
struct Agent {
  int model = 0;
  Pose start;
  int mode = -1;
  Ticks ready = 0;  // pieces up to here are committed
  std::vector<TimedPiece> committed;
  std::vector<Leg> legs;
  int rest_body = 0;  // with which it stands after the last leg
  bool fixed = false;
};

struct TeamParams {
  SearchParams search;
  Objective objective;
  double margin = 0.01;         // gap kept where the robots' clearance asks for less (m)
  double first_penalty = 5.0;   // soft search: price of running into a robot (s)
  double penalty_growth = 1.5;  // each time a robot is ripped up
  double first_hold = 5.0;      // see hold_ (s); doubled up to last_hold
  double last_hold = 80.0;
  double jitter = 0.3;                // random share of the planning order after a restart
  std::int64_t search_limit = 15000;  // expansions per leg of one search
  std::int64_t alone_limit = 400000;  // for the proof that a robot is stuck alone
  int restarts = 1000;
};

struct TeamResult {
  enum class Status { kSolved, kStopped, kStuck };
  Status status = Status::kStopped;
  std::vector<TourResult> tours;  // empty pieces where a robot is not planned
  std::vector<bool> planned;
  std::vector<int> concerned;          // robots without a plan, or stuck
  Ticks conflict_free_until = kNever;  // sooner where what is fixed runs over an unplanned robot
  std::int64_t expansions = 0;
  int searches = 0, rip_ups = 0, restarts = 0;
};

class PrioritisedPlanner {
 public:
  using Progress = std::function<void(int planned, int total, std::int64_t expansions)>;

  PrioritisedPlanner(const std::vector<Model>& models, std::vector<Agent> agents,
                     const TeamParams& params, Progress progress);

  // To be called once.
  TeamResult operator()(std::uint32_t seed, Budget& budget);

 private:
  enum class Attempt { kDone, kAgain, kStuck, kOver };

  void require_gaps();
  std::shared_ptr<const Track> track(std::size_t i, const TourResult& tour) const;
  void insert(std::size_t i, TourResult tour);
  void remove(std::size_t i);
  void hold(std::size_t i);
  void release(std::size_t i);
  TourQuery query(std::size_t i, const Traffic* traffic) const;
  bool alone(std::size_t i, Budget& budget);
  void find_precedence(const std::vector<std::size_t>& order, Budget& budget);
  std::vector<std::size_t> by_precedence(std::vector<std::size_t> order) const;
  Attempt attempt(std::vector<std::size_t> order, Budget& budget);
  void keep_best();
  double first_meeting(const Traffic& others, int other, std::size_t i) const;
  void settle(TeamResult& result) const;
  const Model& model(std::size_t i) const {
    return models_[static_cast<std::size_t>(agents_[i].model)];
  }

  const std::vector<Model>& models_;
  std::vector<Agent> agents_;
  TeamParams params_;
  Progress progress_;
  TourSearch search_;
  Traffic traffic_;
  std::vector<std::vector<double>> required_;  // of each agent to each track
  // Robots not planned yet are ignored, and so may be run over before they can leave. A robot to
  // whom that happened stands at its start for this long in the eyes of those planned before it,
  // as a track of its own (number of agents + i). What it is committed to
  // is a third (2 * number of agents + i).
  std::vector<double> hold_;
  std::vector<int> times_hit_;
  std::vector<double> penalty_;
  // Who is better planned after me: those whose final rest my lone way crosses, and those whose
  // lone way crosses my start.
  std::vector<std::vector<std::size_t>> followers_;
  std::vector<TourResult> tours_;
  std::vector<bool> planned_, can_alone_, fine_;
  std::size_t num_planned_ = 0, num_to_plan_ = 0;
  std::size_t failed_ = 0;
  TeamResult best_;
};

}  // namespace clearway
