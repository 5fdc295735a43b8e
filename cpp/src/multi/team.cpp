#include "clearway/multi/team.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clearway {

namespace {

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

double leg_gap(const Model& model, int body, const Pose& from, const Pose& to, double margin) {
  const auto b = static_cast<std::size_t>(body);
  const double here = model.statics[b]->gap(model.bodies[b], Frame(from));
  const double there = model.statics[b]->gap(model.bodies[b], Frame(to));
  return std::max(-kLegalOverlap, std::min({std::max(model.clearance, margin), here, there}));
}

Traffic empty_traffic(const std::vector<Model>& models, double margin) {
  // A body within the box may have its reference point outside.
  Box box = models.at(0).statics.at(0)->box();
  const double radius = largest_circumradius(models);
  box = {box.x0 - radius, box.y0 - radius, box.x1 + radius, box.y1 + radius};
  return Traffic(box, radius, reach_of(models), largest_gap(models, margin));
}

Team::Team(const std::vector<Model>& models, std::vector<Agent> agents, const SearchParams& search,
           const Objective& objective, double margin)
    : models_(models),
      agents_(std::move(agents)),
      margin_(margin),
      search_(search, objective),
      traffic_(empty_traffic()) {
  places_.resize(size());
  planned_.assign(size(), false);
  fine_.assign(size(), false);
  require_gaps();
}

// Gaps to keep: the clearance, or what the scenario's own poses leave where that is less.
void Team::require_gaps() {
  const std::size_t n = agents_.size();
  std::vector<double> wanted(n);
  struct Rest {
    Frame at;
    const Body* body;
  };
  std::vector<std::vector<Rest>> rests(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Model& m = model(i);
    wanted[i] = std::max(m.clearance, margin_);
    Pose from = agents_[i].start;
    if (!agents_[i].committed.empty()) {
      const TimedPiece& last = agents_[i].committed.back();
      from = moved(last.start, last.twist);
    }
    rests[i].push_back({Frame(from), &first_body(i)});
    for (Leg& leg : agents_[i].legs) {
      const auto b = static_cast<std::size_t>(leg.body);
      leg.required = leg_gap(m, leg.body, from, leg.goal, margin_);
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
  // A robot's holds are tracks of their own: see hold().
  for (auto& row : required_) {
    row.resize(3 * n);
    std::copy_n(row.begin(), n, row.begin() + static_cast<std::ptrdiff_t>(n));
    std::copy_n(row.begin(), n, row.begin() + static_cast<std::ptrdiff_t>(2 * n));
  }
}

TourQuery Team::query(std::size_t i, const Traffic* traffic) const {
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

Team::Place Team::place(std::size_t i, TourResult tour) const {
  std::vector<TimedPiece> pieces = agents_[i].committed;
  pieces.insert(pieces.end(), tour.pieces.begin(), tour.pieces.end());
  return {std::move(tour), make_track(i, std::move(pieces), kNever)};
}

// Without pieces it stands with its first body.
std::shared_ptr<const Track> Team::make_track(std::size_t i, std::vector<TimedPiece> pieces,
                                              Ticks gone) const {
  if (pieces.empty()) pieces.push_back({0, 1, agents_[i].start, {}, -1, first_body_number(i)});
  return std::make_shared<const Track>(&model(i).bodies, agents_[i].start, std::move(pieces), gone);
}

void Team::insert(std::size_t i, Place place) {
  traffic_.insert(static_cast<int>(i), place.track);
  places_[i] = std::move(place);
  planned_[i] = true;
  ++num_planned_;
}

Team::Place Team::remove(std::size_t i) {
  traffic_.remove(static_cast<int>(i));
  planned_[i] = false;
  --num_planned_;
  return std::exchange(places_[i], Place{});
}

void Team::hold(std::size_t i, Ticks until) {
  const Ticks ready = query(i, nullptr).ready;
  const auto stand = [&](std::size_t id, Ticks gone) {
    traffic_.insert(static_cast<int>(id), make_track(i, agents_[i].committed, gone));
  };
  if (ready > 0) stand(2 * size() + i, ready);
  if (until > 0) stand(size() + i, until);
}

void Team::release(std::size_t i) {
  for (const std::size_t id : {size() + i, 2 * size() + i}) {
    if (traffic_.has(static_cast<int>(id))) traffic_.remove(static_cast<int>(id));
  }
}

}  // namespace clearway
