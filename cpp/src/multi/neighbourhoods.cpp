#include "clearway/multi/neighbourhoods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "clearway/search/encounters.hpp"

namespace clearway {

namespace {

constexpr double kFailed = 0.8;  // weight of a robot whose neighbourhood gained nothing
constexpr Ticks kAbout = 5000;   // who passes within this time is near

}  // namespace

NeighbourhoodSearch::NeighbourhoodSearch(Team& team, const TeamParams& params,
                                         const Progress& progress)
    : team_(team), params_(params), progress_(progress) {
  const std::size_t n = team.size();
  least_.assign(n, 0);
  weight_.assign(n, 1.0);
  lone_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!team.plannable(i)) continue;
    plannable_.push_back(i);
    least_[i] = bound(i);
  }
}

std::int64_t NeighbourhoodSearch::price(const TourResult& tour) const {
  if (params_.objective.time) return tour.arrival;
  return static_cast<std::int64_t>(std::llround(tour.cost * kTicksPerSecond));
}

// Bounds are known on arrivals only.
std::int64_t NeighbourhoodSearch::bound(std::size_t i) const {
  return params_.objective.time ? team_.agent(i).bound : 0;
}

NeighbourhoodSearch::Value NeighbourhoodSearch::value() const {
  std::int64_t sum = 0, last = 0;
  for (const std::size_t i : plannable_) {
    sum += price(team_.tour(i));
    last = std::max(last, price(team_.tour(i)));
  }
  return params_.aim == Aim::kMakespan ? Value{last, sum} : Value{sum, last};
}

// The way a robot would take if it were alone; the time it takes is what it can hope for.
void NeighbourhoodSearch::learn_lone_way(std::size_t i, Budget& budget) {
  if (lone_[i]) return;
  const TourQuery query = team_.query(i, nullptr);
  const auto legs = static_cast<std::int64_t>(team_.agent(i).legs.size());
  TourResult tour = team_.search(query, params_.search_limit * legs, budget);
  lone_[i] = team_.track(i);
  if (tour.outcome != TourResult::Outcome::kFound) return;
  least_[i] = std::max<std::int64_t>(least_[i], std::min(price(tour), price(team_.tour(i))));
  lone_[i] = team_.place(i, std::move(tour)).track;
}

// A robot that comes much later than it could, likelier the later.
std::size_t NeighbourhoodSearch::pick_late() {
  std::vector<double> chances;
  double total = 0.0;
  std::int64_t latest = 0;
  for (const std::size_t i : plannable_) latest = std::max(latest, price(team_.tour(i)));
  for (const std::size_t i : plannable_) {
    const auto price_now = price(team_.tour(i));
    const auto delay = static_cast<double>(std::max<std::int64_t>(0, price_now - least_[i]));
    double chance = weight_[i] * delay * delay;
    // The makespan falls only with whoever comes last.
    if (params_.aim == Aim::kMakespan && price_now < latest) chance *= 0.01;
    total += chance;
    chances.push_back(total);
  }
  if (total <= 0.0) return team_.size();
  const double at = total * (random_() / (static_cast<double>(random_.max()) + 1.0));
  const auto found = std::upper_bound(chances.begin(), chances.end(), at);
  return plannable_[static_cast<std::size_t>(found - chances.begin())];
}

// Those who are in the way of the robot's lone way.
void NeighbourhoodSearch::add_blockers(std::size_t i, std::size_t most,
                                       std::vector<std::size_t>& chosen) const {
  Encounters meet(&team_.traffic(), &team_.required(i));
  HitList hits = meet.add(static_cast<int>(i), kNobody);
  const auto& bodies = team_.model(i).bodies;
  for (const TimedPiece& p : lone_[i]->pieces()) {
    if (p.mode < 0) continue;
    const Step step{p.mode, p.twist, p.end - p.begin};
    const Drive edge{&step, 1, step.duration};
    hits =
        meet.collect(bodies[static_cast<std::size_t>(p.body)], Frame(p.start), edge, p.begin, hits);
  }
  const Track::Sight rest = lone_[i]->at(kNever);
  hits = meet.collect_standing(*rest.body, rest.frame, lone_[i]->settled(), kNever, hits);
  for (HitList h = hits; h != kNobody; h = meet.next(h)) {
    const auto j = static_cast<std::size_t>(meet.track(h));
    if (chosen.size() >= most) return;
    if (j != i && j < team_.size() && team_.plannable(j)) chosen.push_back(j);
  }
}

// Those who pass where the robot is at some moment of its way.
void NeighbourhoodSearch::add_near(std::size_t i, std::size_t most,
                                   std::vector<std::size_t>& chosen) {
  for (int tries = 0; tries < 20 && chosen.size() < most; ++tries) {
    const Track& track = *team_.track(i);
    const auto when = static_cast<Ticks>(
        random_() % static_cast<std::uint32_t>(std::max<Ticks>(1, track.settled())));
    const Frame at = track.at(when).frame;
    const auto& near = team_.traffic().near(at.x, at.y);
    if (near.empty()) continue;
    const Traffic::Presence& who = near[random_() % near.size()];
    const auto j = static_cast<std::size_t>(who.track);
    if (j >= team_.size() || !team_.plannable(j)) continue;
    if (who.end < when - kAbout || who.begin > when + kAbout) continue;
    if (std::find(chosen.begin(), chosen.end(), j) == chosen.end()) chosen.push_back(j);
  }
}

// Take the chosen out and plan them anew, in this order; put back what was there if that is not
// better.
bool NeighbourhoodSearch::replan(const std::vector<std::size_t>& chosen, Budget& budget) {
  const Value before = value();
  std::vector<Team::Place> old;
  std::int64_t removed = 0;
  for (const std::size_t i : chosen) {
    removed += price(team_.tour(i));
    old.push_back(team_.remove(i));
  }
  std::int64_t promised = 0;  // what those still to be planned cost at least
  for (const std::size_t i : chosen) promised += bound(i);
  std::size_t done = 0;
  for (; done < chosen.size(); ++done) {
    const std::size_t i = chosen[done];
    promised -= bound(i);
    TourQuery query = team_.query(i, &team_.traffic());
    // Whoever costs more than this leaves the others too little.
    const std::int64_t most = params_.aim == Aim::kMakespan ? before.first + 1 : removed - promised;
    query.below = params_.objective.time
                      ? static_cast<double>(most - query.ready + query.legs->back().service)
                      : static_cast<double>(most) / kTicksPerSecond;
    const auto legs = static_cast<std::int64_t>(query.legs->size());
    TourResult tour = team_.search(query, params_.repair_limit * legs, budget);
    if (tour.outcome != TourResult::Outcome::kFound) break;
    removed -= price(tour);
    team_.insert(i, team_.place(i, std::move(tour)));
  }
  if (done == chosen.size() && value() < before) return true;
  for (std::size_t k = 0; k < done; ++k) team_.remove(chosen[k]);
  for (std::size_t k = 0; k < chosen.size(); ++k) team_.insert(chosen[k], std::move(old[k]));
  return false;
}

void NeighbourhoodSearch::operator()(std::uint32_t seed, Budget& budget, TeamResult& result) {
  random_.seed(seed);
  const int total = static_cast<int>(team_.size());
  while (budget.spend()) {
    const std::size_t late = pick_late();
    if (late == team_.size()) break;  // nobody can come any earlier
    learn_lone_way(late, budget);
    if (budget.ended) break;
    const std::size_t most =
        1 + random_() % static_cast<std::size_t>(std::max(1, params_.neighbourhood));
    std::vector<std::size_t> chosen{late};
    add_blockers(late, most, chosen);
    add_near(late, most, chosen);
    // Often the late one goes first; else anybody may.
    const auto from = chosen.begin() + (random_() % 2 ? 1 : 0);
    std::shuffle(from, chosen.end(), random_);
    ++result.repairs;
    const bool better = replan(chosen, budget);
    weight_[late] = better ? 1.0 : std::max(1e-6, kFailed * weight_[late]);
    if (!better) continue;
    ++result.repaired;
    if (progress_) progress_(total, total, budget.spent, sum_of_arrivals(team_));
  }
  for (const std::size_t i : plannable_) result.tours[i] = team_.tour(i);
  result.expansions = budget.spent;
}

TeamResult plan_team(const std::vector<Model>& models, std::vector<Agent> agents,
                     const TeamParams& params, std::uint32_t seed, Budget& budget,
                     const Progress& progress) {
  Team team(models, std::move(agents), params.search, params.objective, params.margin);
  TeamResult result = PrioritisedPlanner(team, params, progress)(seed, budget);
  if (result.status != TeamResult::Status::kSolved) return result;
  result.first_expansions = budget.spent;
  result.first_cost = sum_of_arrivals(team);
  const int total = static_cast<int>(team.size());
  if (progress) progress(total, total, budget.spent, result.first_cost);
  // Without an end to its effort the first plan is the answer.
  if (budget.improve && (budget.expansions >= 0 || budget.timed)) {
    NeighbourhoodSearch(team, params, progress)(seed, budget, result);
  }
  return result;
}

std::int64_t sum_of_arrivals(const Team& team) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < team.size(); ++i) {
    if (team.planned(i)) sum += team.tour(i).arrival;
  }
  return sum;
}

}  // namespace clearway
