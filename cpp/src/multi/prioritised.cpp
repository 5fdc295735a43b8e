#include "clearway/multi/prioritised.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <stdexcept>

namespace clearway {

namespace {

constexpr double kLegalOverlap = 0.001;  // two poses may touch by this much (m)

double largest_circumradius(const std::vector<Model>& models) {
  double most = 0.0;
  for (const Model& m : models) {
    for (const Body& b : m.bodies) most = std::max(most, b.circumradius());
  }
  return most;
}

double reach_of(const std::vector<Model>& models) {
  double most = 1.0;
  for (const Model& m : models) most = std::max({most, m.table.reach(), m.fine.reach()});
  return most;
}

double largest_gap(const std::vector<Model>& models, double margin) {
  double most = margin;
  for (const Model& m : models) most = std::max(most, m.clearance);
  return most;
}

}  // namespace

PrioritisedPlanner::PrioritisedPlanner(const std::vector<Model>& models, std::vector<Agent> agents,
                                       const TeamParams& params, Progress progress)
    : models_(models),
      agents_(std::move(agents)),
      params_(params),
      progress_(std::move(progress)),
      search_(params.search, params.objective),
      traffic_(models.at(0).statics.at(0)->box(), largest_circumradius(models), reach_of(models),
               largest_gap(models, params.margin)) {
  const std::size_t n = agents_.size();
  tours_.resize(n);
  planned_.assign(n, false);
  can_alone_.assign(n, false);
  fine_.assign(n, false);
  hold_.assign(n, 0.0);
  require_gaps();
}

// Gaps to keep: the clearance, or what the scenario's own poses leave where that is less.
void PrioritisedPlanner::require_gaps() {
  const std::size_t n = agents_.size();
  std::vector<double> wanted(n);
  struct Rest {
    Frame at;
    const Body* body;
  };
  std::vector<std::vector<Rest>> rests(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Model& m = model(i);
    wanted[i] = std::max(m.clearance, params_.margin);
    Pose from = agents_[i].start;
    if (!agents_[i].committed.empty()) {
      const TimedPiece& last = agents_[i].committed.back();
      from = moved(last.start, last.twist);
    }
    rests[i].push_back({Frame(from), &m.bodies[0]});
    for (Leg& leg : agents_[i].legs) {
      const auto b = static_cast<std::size_t>(leg.body);
      const double here = m.statics[b]->gap(m.bodies[b], Frame(from));
      const double there = m.statics[b]->gap(m.bodies[b], Frame(leg.goal));
      leg.required = std::max(-kLegalOverlap, std::min({wanted[i], here, there}));
      from = leg.goal;
      rests[i].push_back({Frame(from), &m.bodies[b]});
    }
    rests[i].push_back({Frame(from), &m.bodies[static_cast<std::size_t>(agents_[i].rest_body)]});
  }
  required_.assign(n, std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double least = std::max(wanted[i], wanted[j]);
      for (const Rest& a : rests[i]) {
        for (const Rest& b : rests[j]) {
          const double near = a.body->circumradius() + b.body->circumradius() + least;
          const double dx = a.at.x - b.at.x, dy = a.at.y - b.at.y;
          if (dx * dx + dy * dy > near * near) continue;
          const double g = gap(*a.body, a.at, *b.body, b.at, least);
          if (g >= -kLegalOverlap) least = std::min(least, g);
        }
      }
      required_[i][j] = required_[j][i] = least;
    }
  }
  for (auto& row : required_) {
    row.resize(3 * n);
    std::copy_n(row.begin(), n, row.begin() + static_cast<std::ptrdiff_t>(n));
    std::copy_n(row.begin(), n, row.begin() + static_cast<std::ptrdiff_t>(2 * n));
  }
}

// Let an unplanned robot do what it is committed to and wait until it is ready; and perhaps stand
// at its start for a while.
void PrioritisedPlanner::hold(std::size_t i) {
  const Ticks ready = query(i, nullptr).ready;
  if (ready > 0) {
    traffic_.insert(static_cast<int>(2 * agents_.size() + i),
                    std::make_shared<const Track>(&model(i).bodies, agents_[i].start,
                                                  agents_[i].committed, ready));
  }
  if (hold_[i] <= 0.0) return;
  traffic_.insert(
      static_cast<int>(agents_.size() + i),
      std::make_shared<const Track>(&model(i).bodies, agents_[i].start, agents_[i].committed,
                                    static_cast<Ticks>(hold_[i] * kTicksPerSecond)));
}

void PrioritisedPlanner::release(std::size_t i) {
  for (const std::size_t id : {agents_.size() + i, 2 * agents_.size() + i}) {
    if (traffic_.has(static_cast<int>(id))) traffic_.remove(static_cast<int>(id));
  }
}

std::shared_ptr<const Track> PrioritisedPlanner::track(std::size_t i,
                                                       const TourResult& tour) const {
  std::vector<TimedPiece> pieces = agents_[i].committed;
  pieces.insert(pieces.end(), tour.pieces.begin(), tour.pieces.end());
  return std::make_shared<const Track>(&model(i).bodies, agents_[i].start, std::move(pieces));
}

void PrioritisedPlanner::insert(std::size_t i, TourResult tour) {
  traffic_.insert(static_cast<int>(i), track(i, tour));
  tours_[i] = std::move(tour);
  planned_[i] = true;
  ++num_planned_;
}

void PrioritisedPlanner::remove(std::size_t i) {
  traffic_.remove(static_cast<int>(i));
  tours_[i] = {};
  planned_[i] = false;
  --num_planned_;
}

TourQuery PrioritisedPlanner::query(std::size_t i, const Traffic* traffic) const {
  TourQuery q;
  const Agent& agent = agents_[i];
  q.model = &model(i);
  q.fine = fine_[i];
  q.start = agent.start;
  q.mode = agent.mode;
  q.ready = agent.ready;
  if (!agent.committed.empty()) {
    const TimedPiece& last = agent.committed.back();
    q.start = moved(last.start, last.twist);
    q.start.theta = wrap(q.start.theta);
    q.ready = std::max(agent.ready, last.end);
  }
  q.legs = &agent.legs;
  q.rest_body = agent.rest_body;
  q.traffic = traffic;
  q.required = &required_[i];
  return q;
}

// Whether a robot finds its way with nobody else on the site; tries the finer table once.
bool PrioritisedPlanner::alone(std::size_t i, Budget& budget) {
  if (can_alone_[i]) return true;
  for (const bool fine : {false, true}) {
    fine_[i] = fine;
    const TourResult tour = search_(query(i, nullptr), params_.alone_limit, budget);
    if (tour.outcome == TourResult::Outcome::kFound) return can_alone_[i] = true;
    if (tour.outcome == TourResult::Outcome::kStopped) {
      can_alone_[i] = !budget.ended;  // nothing is proven, and nothing to ask again
      return true;
    }
  }
  return false;
}

void PrioritisedPlanner::find_precedence(const std::vector<std::size_t>& order, Budget& budget) {
  followers_.assign(agents_.size(), {});
  for (const std::size_t i : order) {
    const TourResult tour =
        search_(query(i, nullptr),
                params_.search_limit * static_cast<std::int64_t>(agents_[i].legs.size()), budget);
    if (tour.outcome != TourResult::Outcome::kFound) continue;
    Traffic lone(models_[0].statics[0]->box(), largest_circumradius(models_), reach_of(models_),
                 largest_gap(models_, params_.margin));
    lone.insert(static_cast<int>(i), track(i, tour));
    const auto crosses = [&](std::size_t j, int body, const Pose& rest) {
      for (const Traffic::Presence& who : lone.near(rest.x, rest.y)) {
        const Mover standing{
            &model(j).bodies[static_cast<std::size_t>(body)], Frame(rest), {}, 0.0, kNever};
        if (lone.first_conflict(who, standing, 0.0) >= 0.0) return true;
      }
      return false;
    };
    for (const std::size_t j : order) {
      if (j == i) continue;
      if (crosses(j, agents_[j].rest_body, agents_[j].legs.back().goal)) followers_[i].push_back(j);
      if (crosses(j, 0, agents_[j].start)) followers_[j].push_back(i);
    }
  }
}

// Always next: who waits for the fewest of those left; among equals the order given decides.
std::vector<std::size_t> PrioritisedPlanner::by_precedence(std::vector<std::size_t> order) const {
  std::vector<int> waits_for(agents_.size(), 0);
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
    const auto legs = static_cast<std::int64_t>(agents_[i].legs.size());
    const std::int64_t limit = params_.search_limit * legs;
    release(i);
    TourQuery q = query(i, &traffic_);
    ++best_.searches;
    TourResult tour = search_(q, limit, budget);
    if (tour.outcome != TourResult::Outcome::kFound) {
      if (budget.ended) return Attempt::kOver;
      if (!alone(i, budget)) {
        failed_ = i;
        return Attempt::kStuck;
      }
      q = query(i, &traffic_);
      q.penalty = &penalty_;
      ++best_.searches;
      tour = search_(q, limit, budget);
      if (budget.ended) return Attempt::kOver;
      if (tour.outcome != TourResult::Outcome::kFound) {
        failed_ = i;
        return Attempt::kAgain;
      }
    }
    for (const int hit : tour.hits) {
      const auto j = static_cast<std::size_t>(hit);
      if (j >= agents_.size()) continue;  // it only stands there in our eyes
      ++best_.rip_ups;
      ++times_hit_[j];
      remove(j);
      hold(j);
      penalty_[j] *= params_.penalty_growth;
      queue.push_front(j);
    }
    tour.hits.clear();
    insert(i, std::move(tour));
    keep_best();
    if (progress_) {
      progress_(static_cast<int>(num_planned_), static_cast<int>(num_to_plan_), budget.spent);
    }
  }
  return Attempt::kDone;
}

void PrioritisedPlanner::keep_best() {
  const auto kept =
      static_cast<std::size_t>(std::count(best_.planned.begin(), best_.planned.end(), true));
  if (!best_.planned.empty() && num_planned_ <= kept) return;
  best_.tours = tours_;
  best_.planned = planned_;
}

// First tick at which an unplanned robot, driving what it is committed to and then standing,
// meets another's track; negative if never.
double PrioritisedPlanner::first_meeting(const Traffic& others, int other, std::size_t i) const {
  const double required = required_[i][static_cast<std::size_t>(other)];
  const Traffic::Presence always{other, 0, kNever};
  Frame at(agents_[i].start);
  const Body* body = &model(i).bodies[0];
  Ticks t = 0;
  for (const TimedPiece& p : agents_[i].committed) {
    body = &model(i).bodies[static_cast<std::size_t>(p.body)];
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
  const std::size_t n = agents_.size();
  const auto plannable = [this](std::size_t i) {
    return !agents_[i].fixed && !agents_[i].legs.empty();
  };
  for (bool again = true; again;) {
    again = false;
    result.conflict_free_until = kNever;
    Traffic others(models_[0].statics[0]->box(), largest_circumradius(models_), reach_of(models_),
                   largest_gap(models_, params_.margin));
    for (std::size_t i = 0; i < n; ++i) {
      if (result.planned[i]) others.insert(static_cast<int>(i), track(i, result.tours[i]));
    }
    for (std::size_t u = 0; u < n && !again; ++u) {
      if (result.planned[u]) continue;
      for (std::size_t i = 0; i < n && !again; ++i) {
        if (!result.planned[i]) continue;
        const double when = first_meeting(others, static_cast<int>(i), u);
        if (when < 0.0) continue;
        if (plannable(i)) {
          result.planned[i] = false;
          result.tours[i] = {};
          again = true;
        } else {
          result.conflict_free_until =
              std::min(result.conflict_free_until, static_cast<Ticks>(when));
        }
      }
    }
  }
}

TeamResult PrioritisedPlanner::operator()(std::uint32_t seed, Budget& budget) {
  const std::size_t n = agents_.size();
  std::vector<double> length(n, 0.0);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < n; ++i) {
    const Agent& agent = agents_[i];
    if (agent.fixed || agent.legs.empty()) {
      insert(i, {});
      continue;
    }
    order.push_back(i);
    Pose from = agent.start;
    for (const Leg& leg : agent.legs) {
      length[i] += std::hypot(leg.goal.x - from.x, leg.goal.y - from.y);
      from = leg.goal;
    }
  }
  num_to_plan_ = n;
  best_.tours.resize(n);
  best_.planned = planned_;
  std::mt19937 random(seed);
  std::vector<double> urgency(n, 1.0);
  Attempt outcome = order.empty() ? Attempt::kDone : Attempt::kAgain;
  const double unit = params_.objective.time ? kTicksPerSecond : 1.0;
  for (int round = 0; outcome == Attempt::kAgain && round <= params_.restarts; ++round) {
    for (const std::size_t i : order) {
      if (planned_[i]) remove(i);
      release(i);
      hold(i);
    }
    times_hit_.assign(n, 0);
    penalty_.assign(3 * n, params_.first_penalty * unit);
    std::fill(penalty_.begin() + static_cast<std::ptrdiff_t>(2 * n), penalty_.end(), -1.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (agents_[i].fixed || agents_[i].legs.empty()) penalty_[i] = -1.0;
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
  TeamResult result = best_;
  result.expansions = budget.spent;
  if (outcome == Attempt::kDone) {
    result.status = TeamResult::Status::kSolved;
    result.tours = tours_;
    result.planned = planned_;
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
