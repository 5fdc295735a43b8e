// Small teams that the tests share, and what must hold for every plan of one.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>

#include "clearway/multi/neighbourhoods.hpp"
#include "scenes.hpp"

namespace scenes {

struct Setting {
  std::vector<Model> models;
  std::vector<Agent> agents;
  TeamParams params;
  std::uint32_t seed = 1;
  Budget budget;

  Setting() {
    params.restarts = 20;
    params.alone_limit = 20000;
    budget.expansions = 300000;
  }
  void add(const Pose& start, std::vector<Leg> legs) {
    Agent agent;
    agent.start = start;
    agent.legs = std::move(legs);
    agents.push_back(std::move(agent));
  }
  TeamResult run() {
    budget.spent = 0;
    budget.ended = false;
    Team planned(models, agents, params.search, params.objective, params.margin);
    return PrioritisedPlanner(planned, params, {})(seed, budget);
  }
};

inline Setting team(const Obstacles& o, double clearance = 0.0) {
  Setting t;
  t.models.push_back(rover(rectangle(1.0, 0.6), o, clearance));
  return t;
}

inline Leg to(const Pose& goal, Ticks service = 0, int body = 0) {
  return {goal, service, body, 0.0};
}

inline Track track_of(const Setting& t, const TeamResult& result, std::size_t i) {
  std::vector<TimedPiece> pieces = t.agents[i].committed;
  const auto& tour = result.tours[i].pieces;
  if (result.planned[i]) pieces.insert(pieces.end(), tour.begin(), tour.end());
  const auto model = static_cast<std::size_t>(t.agents[i].model);
  return Track(&t.models[model].bodies, t.agents[i].start, pieces);
}

// Dense sampling with true bodies: nobody overlaps anybody, planned or standing, by over 1 mm.
inline void check_apart(const Setting& t, const TeamResult& result) {
  for (std::size_t i = 0; i < t.agents.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Track a = track_of(t, result, i), b = track_of(t, result, j);
      const Ticks last = std::max(a.settled(), b.settled()) + 100;
      INFO("robots ", i, " and ", j);
      CHECK(least_gap(a, b, last, 5) >= -0.001);
    }
  }
}

inline void check_visits(const Setting& t, const TeamResult& result) {
  for (std::size_t i = 0; i < t.agents.size(); ++i) {
    if (!result.planned[i] || t.agents[i].legs.empty() || t.agents[i].fixed) continue;
    REQUIRE(result.tours[i].stops.size() == t.agents[i].legs.size());
    const Track track = track_of(t, result, i);
    for (std::size_t k = 0; k < t.agents[i].legs.size(); ++k) {
      const Leg& leg = t.agents[i].legs[k];
      const TourStop& stop = result.tours[i].stops[k];
      CHECK(stop.leave - stop.arrive == leg.service);
      for (Ticks tick = stop.arrive; tick <= stop.leave; tick += 100) {
        const Frame f = track.at(tick).frame;
        CHECK(std::abs(f.x - leg.goal.x) < 1e-4);
        CHECK(std::abs(f.y - leg.goal.y) < 1e-4);
        CHECK(std::abs(f.c - std::cos(leg.goal.theta)) < 1e-4);
        CHECK(std::abs(f.s - std::sin(leg.goal.theta)) < 1e-4);
      }
    }
  }
}

inline void check_solved(const Setting& t, const TeamResult& result) {
  CHECK(result.status == TeamResult::Status::kSolved);
  CHECK(result.concerned.empty());
  CHECK(std::count(result.planned.begin(), result.planned.end(), true) ==
        static_cast<std::ptrdiff_t>(t.agents.size()));
  check_visits(t, result);
  check_apart(t, result);
}

inline bool same(const TeamResult& a, const TeamResult& b) {
  if (a.status != b.status || a.planned != b.planned || a.expansions != b.expansions) return false;
  for (std::size_t i = 0; i < a.tours.size(); ++i) {
    const auto &p = a.tours[i].pieces, &q = b.tours[i].pieces;
    if (p.size() != q.size()) return false;
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (p[k].begin != q[k].begin || p[k].end != q[k].end || p[k].start.x != q[k].start.x ||
          p[k].start.y != q[k].start.y || p[k].twist.c != q[k].twist.c) {
        return false;
      }
    }
  }
  return true;
}

// A lane of 1.3 m along x with a siding of 3 m by 2 m that is nearer to its left end.
inline Obstacles lane_with_siding() {
  return hall(
      {{0, 0}, {20, 0}, {20, 1.3}, {8.5, 1.3}, {8.5, 3.3}, {5.5, 3.3}, {5.5, 1.3}, {0, 1.3}});
}

}  // namespace scenes
