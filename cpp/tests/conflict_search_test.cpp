#include "clearway/multi/conflict_search.hpp"

#include <doctest/doctest.h>

#include "lattices.hpp"
#include "teams.hpp"

using namespace clearway;
using namespace scenes;

namespace {

Agent agent(const Pose& start, const Pose& goal, Ticks service = 0) {
  Agent a;
  a.start = start;
  a.legs = {{goal, service, 0, 0.0}};
  return a;
}

// Two rovers on lattices, and ways of theirs under whatever rules.
struct Pair {
  std::vector<Model> models;
  Objective objective;
  LatticeParams params;
  Team team;
  Routing routing;

  Pair(const Body& body, const Obstacles& o, double clearance, const std::vector<Agent>& agents)
      : models{model_of(body, o, rover_table(4), rover_table(4), clearance)},
        team(models, agents, SearchParams{}, objective, 0.01) {
    params.slot = 500;
    routing.team = &team;
    routing.slot = params.slot;
    for (std::size_t i = 0; i < team.size(); ++i) {
      routing.rests.push_back({&models[0].bodies[0], Frame(team.agent(i).legs.back().goal)});
    }
    for (std::size_t i = 0; i < team.size(); ++i) {
      const Agent& a = team.agent(i);
      routing.searches.push_back(std::make_unique<LatticeSearch>(
          models[0], a.legs, a.start, -1, 0, routing.rests, team.required(i), objective, params));
    }
  }

  bool plan(std::size_t i, const std::vector<Rule>& rules, Route& route) {
    Guidance guidance;
    guidance.heuristic = Heuristic::kBound;
    Budget budget;
    budget.expansions = 5'000;
    const auto end = (*routing.searches[i])(rules, nullptr, guidance, budget, route);
    if (end != LatticeSearch::Outcome::kFound) return false;
    route.track =
        std::make_shared<const Track>(&models[0].bodies, team.agent(i).start, route.pieces, kNever);
    return true;
  }

  // Whether a way does what a rule forbids robot i, looked up on the way itself.
  bool breaks(std::size_t i, const Route& route, const Rule& rule) {
    Lattice& lattice = routing.searches[i]->lattice(0);
    switch (rule.kind) {
      case Rule::Kind::kRest:
        return route.rest <= rule.to;
      case Rule::Kind::kPoint: {
        const Track::Sight at = route.track->at(rule.from);
        return gap(*at.body, at.frame, Circle{rule.point.x, rule.point.y, 0.0}) <= rule.gap;
      }
      case Rule::Kind::kAvoid: {
        const auto other = static_cast<std::size_t>(rule.other);
        const Rest& rest = routing.rests[other];
        for (Ticks t = rule.from; t <= std::max(rule.from, route.track->settled()); t += 5) {
          const Track::Sight at = route.track->at(t);
          if (gap(*at.body, at.frame, *rest.body, rest.at, 1.0) < team.required(i)[other])
            return true;
        }
        return false;
      }
      case Rule::Kind::kStand: {
        Slot since = 0;
        for (const Move& m : route.moves) {
          const bool stands = m.node == rule.node && m.depart > since;
          if (stands && since <= rule.to && m.depart - 1 >= rule.from) return true;
          since = m.arrive;
        }
        return false;
      }
      default:
        for (const Move& m : route.moves) {
          const auto motion = static_cast<std::size_t>(m.motion);
          const bool arrives = motion >= lattice.num_primitives();
          const Ticks offset =
              lattice.drives(m.node, lattice.way(m.node, motion), arrives, rule.stretch);
          const Ticks begin = m.depart * params.slot + offset;
          if (offset >= 0 && rule.from <= begin && begin <= rule.to) return true;
        }
        return false;
    }
  }
};

// Rules that make for other ways than the best: places to be away from at some moments.
std::vector<Rule> detours(Dice& dice) {
  std::vector<Rule> rules;
  for (int k = dice.below(5); k > 0; --k) {
    Rule rule;
    rule.kind = Rule::Kind::kPoint;
    rule.point = {dice.between(0.3, 4.7), dice.between(0.3, 2.2)};
    rule.from = 250 + 500 * dice.below(14);
    rules.push_back(rule);
  }
  Rule later;
  later.kind = Rule::Kind::kRest;
  later.to = dice.below(16);
  rules.push_back(later);
  return rules;
}

Pose on_grid(Dice& dice) {
  return {0.5 + 0.5 * dice.below(9), 0.5 + 0.5 * dice.below(4), 0.5 * kPi * (dice.below(4) - 1)};
}

// Two robots whose starts and goals are apart.
std::vector<Agent> random_pair(Dice& dice, const Body& body, double apart) {
  while (true) {
    std::vector<Agent> pair{agent(on_grid(dice), on_grid(dice), 500 * dice.below(3)),
                            agent(on_grid(dice), on_grid(dice), 500 * dice.below(3))};
    const auto clear = [&](const Pose& p, const Pose& q) {
      return gap(body, Frame(p), body, Frame(q), apart) >= apart;
    };
    if (clear(pair[0].start, pair[1].start) && clear(pair[0].legs[0].goal, pair[1].legs[0].goal)) {
      return pair;
    }
  }
}

void check_branching(double clearance) {
  const Body body = rectangle(0.8, 0.4);
  int met = 0, kept = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    Dice dice(seed);
    Pair p(body, hall(5.0, 2.5), clearance, random_pair(dice, body, clearance + 0.05));
    std::vector<Route> ways[2];
    for (int k = 0; k < 8; ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        Route route;
        if (p.plan(i, k == 0 ? std::vector<Rule>{} : detours(dice), route)) {
          ways[i].push_back(std::move(route));
        }
      }
    }
    for (const Route& a : ways[0]) {
      for (const Route& b : ways[1]) {
        const double tick = first_meeting(p.routing, a, 0, b, 1);
        if (tick < 0.0) continue;
        const Branching sides = branch(p.routing, {0, 1, tick}, a, b);
        INFO("seed ", seed, ", tick ", tick, ", rules of kinds ",
             static_cast<int>(sides.rule[0].kind), " ", static_cast<int>(sides.rule[1].kind));
        // Both do what is forbidden them, so that neither side has these two ways again.
        CHECK(p.breaks(0, a, sides.rule[0]));
        CHECK(p.breaks(1, b, sides.rule[1]));
        ++met;
        for (const Route& c : ways[0]) {
          for (const Route& d : ways[1]) {
            if (!p.breaks(0, c, sides.rule[0]) || !p.breaks(1, d, sides.rule[1])) continue;
            CHECK(first_meeting(p.routing, c, 0, d, 1) >= 0.0);
            ++kept;
          }
        }
      }
    }
  }
  CHECK(met > 100);
  CHECK(kept > met);
}

}  // namespace

TEST_CASE("Ways that break both rules of a branching meet") { check_branching(0.0); }

TEST_CASE("They meet where robots keep a clearance, too") { check_branching(0.2); }

TEST_CASE("Ways found under a rule keep it") {
  const Body body = rectangle(0.8, 0.4);
  int found = 0;
  for (std::uint32_t seed = 100; seed < 130; ++seed) {
    Dice dice(seed);
    Pair p(body, hall(5.0, 2.5), 0.0, random_pair(dice, body, 0.05));
    Route a, b, c;
    if (!p.plan(0, {}, a) || !p.plan(1, {}, b)) continue;
    const double tick = first_meeting(p.routing, a, 0, b, 1);
    if (tick < 0.0) continue;
    const Branching sides = branch(p.routing, {0, 1, tick}, a, b);
    for (std::size_t side = 0; side < 2; ++side) {
      if (p.plan(side, {sides.rule[side]}, c)) {
        CHECK_FALSE(p.breaks(side, c, sides.rule[side]));
        CHECK(c.cost >= (side == 0 ? a : b).cost);
        ++found;
      }
      if (!sides.bound[side]) continue;
      if (p.plan(1 - side, {opposite(sides.rule[side])}, c)) {
        // The robot that is bound does what its own rule forbids on the other side.
        CHECK(p.breaks(1 - side, c, sides.rule[1 - side]));
        ++found;
      }
    }
  }
  CHECK(found > 10);
}

TEST_CASE("Two rovers that swap ends of a lane use its siding, and no plan costs less") {
  std::vector<Model> models{
      model_of(rectangle(1.0, 0.6), lane_with_siding(), rover_table(4), rover_table(4))};
  std::vector<Agent> agents{agent({2.0, 0.65, 0.0}, {12.0, 0.65, 0.0}),
                            agent({12.0, 0.65, kPi}, {2.0, 0.65, kPi})};
  ConflictParams params;
  params.lattice.slot = 500;
  Budget budget;
  params.mode = ConflictParams::Mode::kBounded;
  params.factor = 1.5;
  budget.expansions = 300'000;
  ConflictSearch search(models, agents, params, {});
  const ConflictResult result = search(budget);
  REQUIRE(result.status == ConflictResult::Status::kSolved);
  // Each alone takes 10 s.
  CHECK(result.bound >= 20'000.0);
  CHECK(result.cost >= result.bound);
  if (result.proven) CHECK(result.cost <= 1.5 * result.bound + 1.0);
}
