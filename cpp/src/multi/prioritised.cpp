#include "clearway/multi/prioritised.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace clearway {

PrioritisedPlanner::PrioritisedPlanner(Team& team, const TeamParams& params,
                                       const Progress& progress)
    : team_(team), params_(params), progress_(progress) {
  can_alone_.assign(team.size(), false);
  hold_.assign(team.size(), 0.0);
}

// Whether a robot finds its way with nobody else on the site; tries the finer table once.
bool PrioritisedPlanner::alone(std::size_t i, Budget& budget) {
  if (can_alone_[i]) return true;
  for (const bool fine : {false, true}) {
    team_.refine(i, fine);
    const TourResult tour = team_.search(team_.query(i, nullptr), params_.alone_limit, budget);
    if (tour.outcome == TourResult::Outcome::kFound) return can_alone_[i] = true;
    if (tour.outcome == TourResult::Outcome::kStopped) {
      can_alone_[i] = !budget.ended;  // nothing is proven, and nothing to ask again
      return true;
    }
  }
  return false;
}

void PrioritisedPlanner::find_precedence(const std::vector<std::size_t>& order, Budget& budget) {
  followers_.assign(team_.size(), {});
  for (const std::size_t i : order) {
    TourResult tour = team_.search(team_.query(i, nullptr), limit(i), budget);
    if (tour.outcome != TourResult::Outcome::kFound) continue;
    Traffic lone = team_.empty_traffic();
    lone.insert(static_cast<int>(i), team_.place(i, std::move(tour)).track);
    const auto crosses = [&](std::size_t j, int body, const Pose& rest) {
      for (const Traffic::Presence& who : lone.near(rest.x, rest.y)) {
        const Mover standing{
            &team_.model(j).bodies[static_cast<std::size_t>(body)], Frame(rest), {}, 0.0, kNever};
        if (lone.first_conflict(who, standing, 0.0) >= 0.0) return true;
      }
      return false;
    };
    for (const std::size_t j : order) {
      if (j == i) continue;
      const Agent& other = team_.agent(j);
      if (crosses(j, other.rest_body, other.legs.back().goal)) followers_[i].push_back(j);
      if (crosses(j, team_.first_body_number(j), other.start)) followers_[j].push_back(i);
    }
  }
}

// Always next: who waits for the fewest of those left; among equals the order given decides.
std::vector<std::size_t> PrioritisedPlanner::by_precedence(std::vector<std::size_t> order) const {
  std::vector<int> waits_for(team_.size(), 0);
  for (const auto& list : followers_) {
    for (const std::size_t j : list) ++waits_for[j];
  }
  std::vector<std::size_t> sorted;
  while (!order.empty()) {
    const auto next =
        std::min_element(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return waits_for[a] < waits_for[b]; });
    for (const std::size_t j : followers_[*next]) --waits_for[j];
    sorted.push_back(*next);
    order.erase(next);
  }
  return sorted;
}

PrioritisedPlanner::Attempt PrioritisedPlanner::attempt(std::vector<std::size_t> order,
                                                        Budget& budget) {
  std::deque<std::size_t> queue(order.begin(), order.end());
  const std::size_t most = 3 * order.size() + 8;
  for (std::size_t plans = 0; !queue.empty(); ++plans) {
    if (plans > most) {
      failed_ = queue.front();
      return Attempt::kAgain;
    }
    const std::size_t i = queue.front();
    queue.pop_front();
    team_.release(i);
    TourQuery q = team_.query(i, &team_.traffic());
    ++best_.searches;
    TourResult tour = team_.search(q, limit(i), budget);
    best_.full += tour.is_full;
    if (tour.outcome != TourResult::Outcome::kFound) {
      if (budget.ended) return Attempt::kOver;
      if (!alone(i, budget)) {
        failed_ = i;
        return Attempt::kStuck;
      }
      q = team_.query(i, &team_.traffic());
      q.penalty = &penalty_;
      ++best_.searches;
      tour = team_.search(q, limit(i), budget);
      best_.full += tour.is_full;
      if (budget.ended) return Attempt::kOver;
      if (tour.outcome != TourResult::Outcome::kFound) {
        failed_ = i;
        return Attempt::kAgain;
      }
    }
    if (!tour.hits.empty()) keep_best();
    for (const int hit : tour.hits) {
      const auto j = static_cast<std::size_t>(hit);
      if (j >= team_.size()) continue;  // it only stands there in our eyes
      ++best_.rip_ups;
      ++times_hit_[j];
      team_.remove(j);
      team_.hold(j, hold(j));
      penalty_[j] *= params_.penalty_growth;
      queue.push_front(j);
    }
    tour.hits.clear();
    team_.insert(i, team_.place(i, std::move(tour)));
    if (progress_) {
      progress_(static_cast<int>(team_.num_planned()), static_cast<int>(team_.size()), budget.spent,
                -1);
    }
  }
  return Attempt::kDone;
}

// Before robots are taken out: remember the plan of the most robots so far.
void PrioritisedPlanner::keep_best() {
  const auto kept =
      static_cast<std::size_t>(std::count(best_.planned.begin(), best_.planned.end(), true));
  if (team_.num_planned() <= kept) return;
  for (std::size_t i = 0; i < team_.size(); ++i) {
    best_.tours[i] = team_.tour(i);
    best_.planned[i] = team_.planned(i);
  }
}

// First tick at which an unplanned robot, driving what it is committed to and then standing,
// meets another's track; negative if never.
double PrioritisedPlanner::first_meeting(const Traffic& others, int other, std::size_t i) const {
  const double required = team_.required(i)[static_cast<std::size_t>(other)];
  const Traffic::Presence always{other, 0, kNever};
  Frame at(team_.agent(i).start);
  const Body* body = &team_.first_body(i);
  Ticks t = 0;

  for (const TimedPiece& p : team_.agent(i).committed) {
    body = &team_.model(i).bodies[static_cast<std::size_t>(p.body)];
    at = Frame(p.start);
    const Mover driving{body, at, p.twist, static_cast<double>(p.begin),
                        static_cast<double>(p.end - p.begin)};
    const double when = others.first_conflict(always, driving, required);
    if (when >= 0.0) return when;
    at = moved(at, p.twist);
    t = p.end;
  }
  const Mover rest{body, at, {}, static_cast<double>(t), static_cast<double>(kNever - t)};
  return others.first_conflict(always, rest, required);
}

// An unplanned robot stands at its start (or where its commitment ends) for ever: take back
// plans that run into one. What is fixed cannot be taken back; then the plan holds until there.
void PrioritisedPlanner::settle(TeamResult& result) const {
  const std::size_t n = team_.size();
  Traffic others = team_.empty_traffic();
  std::vector<std::size_t> standing;
  for (std::size_t i = 0; i < n; ++i) {
    if (result.planned[i]) {
      others.insert(static_cast<int>(i), team_.place(i, result.tours[i]).track);
    } else {
      standing.push_back(i);
    }
  }
  result.conflict_free_until = kNever;
  while (!standing.empty()) {
    const std::size_t u = standing.back();
    standing.pop_back();
    for (std::size_t i = 0; i < n; ++i) {
      if (!result.planned[i]) continue;
      const double when = first_meeting(others, static_cast<int>(i), u);
      if (when < 0.0) continue;
      if (team_.plannable(i)) {
        result.planned[i] = false;
        result.tours[i] = {};
        others.remove(static_cast<int>(i));
        standing.push_back(i);
      } else {
        result.conflict_free_until = std::min(result.conflict_free_until, static_cast<Ticks>(when));
      }
    }
  }
}

TeamResult PrioritisedPlanner::operator()(std::uint32_t seed, Budget& budget) {
  const std::size_t n = team_.size();
  std::vector<double> length(n, 0.0);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < n; ++i) {
    const Agent& agent = team_.agent(i);
    if (!team_.plannable(i)) {
      team_.insert(i, team_.place(i, {}));
      continue;
    }
    order.push_back(i);
    Pose from = agent.start;
    for (const Leg& leg : agent.legs) {
      length[i] += std::hypot(leg.goal.x - from.x, leg.goal.y - from.y);
      from = leg.goal;
    }
  }
  best_.tours.resize(n);
  best_.planned.resize(n);
  for (std::size_t i = 0; i < n; ++i) best_.planned[i] = team_.planned(i);
  std::mt19937 random(seed);
  std::vector<double> urgency(n, 1.0);
  Attempt outcome = order.empty() ? Attempt::kDone : Attempt::kAgain;
  const double unit = params_.objective.time ? kTicksPerSecond : 1.0;
  for (int round = 0; outcome == Attempt::kAgain && round <= params_.restarts; ++round) {
    keep_best();
    for (const std::size_t i : order) {
      if (team_.planned(i)) team_.remove(i);
      team_.release(i);
      team_.hold(i, hold(i));
    }
    times_hit_.assign(n, 0);
    penalty_.assign(3 * n, params_.first_penalty * unit);
    std::fill(penalty_.begin() + static_cast<std::ptrdiff_t>(2 * n), penalty_.end(), -1.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (!team_.plannable(i)) penalty_[i] = -1.0;
    }
    std::vector<double> rank(n);
    for (const std::size_t i : order) {
      const double share =
          round == 0 ? 0.0 : params_.jitter * (random() / static_cast<double>(random.max()));
      rank[i] = length[i] * (1.0 + share) * urgency[i];
    }
    std::stable_sort(order.begin(), order.end(),
                     [&rank](std::size_t a, std::size_t b) { return rank[a] < rank[b]; });
    if (round == 1) find_precedence(order, budget);
    outcome = attempt(round % 2 == 0 ? order : by_precedence(order), budget);
    if (outcome == Attempt::kAgain) {
      ++best_.restarts;
      urgency[failed_] *= 0.5;
      for (std::size_t i = 0; i < n; ++i) {
        if (i != failed_ && times_hit_[i] < 2) continue;
        hold_[i] = std::clamp(2.0 * hold_[i], params_.first_hold, params_.last_hold);
      }
    }
  }
  keep_best();
  TeamResult result = best_;
  result.expansions = budget.spent;
  if (outcome == Attempt::kDone) {
    result.status = TeamResult::Status::kSolved;
    result.planned.assign(n, true);
    for (std::size_t i = 0; i < n; ++i) result.tours[i] = team_.tour(i);
    return result;
  }
  settle(result);
  result.status =
      outcome == Attempt::kStuck ? TeamResult::Status::kStuck : TeamResult::Status::kStopped;
  if (outcome == Attempt::kStuck) {
    result.concerned.push_back(static_cast<int>(failed_));
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      if (!result.planned[i]) result.concerned.push_back(static_cast<int>(i));
    }
  }
  return result;
}

}  // namespace clearway
