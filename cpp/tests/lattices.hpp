// One robot on its lattices, ready to be searched under rules.
#pragma once

#include <set>

#include "clearway/search/lattice_search.hpp"
#include "scenes.hpp"

namespace scenes {

struct Walk {
  Model model;
  std::vector<Leg> legs;
  Pose start;
  Objective objective;
  LatticeParams params;
  std::vector<Rest> rests;
  std::vector<double> required{0.01};

  Walk(const Body& body, const Obstacles& o, const Pose& from, std::vector<Leg> tour)
      : model(model_of(body, o, rover_table(4), rover_table(4))),
        legs(std::move(tour)),
        start(from) {
    params.slot = 500;
    model.table.turn_arm = 0.4;
    for (Leg& leg : legs) leg.required = 0.01;
    rests.push_back({&model.bodies[0], Frame(legs.back().goal)});
  }

  LatticeSearch search() const {
    return LatticeSearch(model, legs, start, -1, 0, rests, required, objective, params);
  }

  // The best way under rules; negative: there is none.
  double cost(const std::vector<Rule>& rules, Heuristic heuristic, Route& route) const {
    LatticeSearch run = search();
    run.prepare(heuristic);
    Guidance guidance;
    guidance.heuristic = heuristic;
    Budget budget;
    budget.expansions = 200'000;
    const auto outcome = run(rules, nullptr, guidance, budget, route);
    return outcome == LatticeSearch::Outcome::kFound ? route.cost : -1.0;
  }
};

// Find every pose that a lattice has.
inline void explore(Lattice& lattice) {
  for (std::int32_t n = 0; n < lattice.num_nodes(); ++n) {
    for (std::size_t m = 0; m < lattice.num_primitives(); ++m) lattice.target(n, m);
  }
}

}  // namespace scenes
