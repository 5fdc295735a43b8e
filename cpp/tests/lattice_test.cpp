#include <doctest/doctest.h>

#include "lattices.hpp"

using namespace clearway;
using namespace scenes;

namespace {

// A pose on the grid of half metres, turned by quarters.
Pose on_grid(Dice& dice, int columns, int rows) {
  return {0.5 + 0.5 * dice.below(columns), 0.5 + 0.5 * dice.below(rows),
          0.5 * kPi * (dice.below(4) - 1)};
}

Rule stand(std::int32_t node, Slot from, Slot to) {
  Rule rule;
  rule.kind = Rule::Kind::kStand;
  rule.node = node;
  rule.from = from;
  rule.to = to;
  return rule;
}

Rule point(Point where, Ticks when, double gap, bool must = false) {
  Rule rule;
  rule.kind = Rule::Kind::kPoint;
  rule.point = where;
  rule.from = when;
  rule.gap = gap;
  rule.must = must;
  return rule;
}

Rule rest(Slot to, bool must) {
  Rule rule;
  rule.kind = Rule::Kind::kRest;
  rule.to = to;
  rule.must = must;
  return rule;
}

// Earliest rest by trying every pose in every slot; negative: none before the horizon.
Ticks earliest_rest(const Walk& w, const std::vector<Rule>& rules, Slot horizon) {
  LatticeSearch owner = w.search();
  Lattice& lattice = owner.lattice(0);
  explore(lattice);
  const Body& body = w.model.bodies[0];
  const auto keeps = [&](const Frame& at, const Rule& r) {
    return (gap(body, at, Circle{r.point.x, r.point.y, 0.0}) <= r.gap) == r.must;
  };
  const auto may_stand = [&](std::int32_t n, Slot s) {
    for (const Rule& r : rules) {
      if (r.kind == Rule::Kind::kStand && r.node == n && r.from <= s && s <= r.to) return false;
      if (r.kind == Rule::Kind::kPoint && r.from / w.params.slot == s &&
          !keeps(lattice.frame(n), r))
        return false;
    }
    return true;
  };
  const auto may_drive = [&](std::int32_t n, const Lattice::Way& way, Slot s) {
    for (const Rule& r : rules) {
      const Ticks since = r.from - s * w.params.slot;
      if (r.kind != Rule::Kind::kPoint || since < 0 || since >= way.slots * w.params.slot) continue;
      Frame at = lattice.frame(n);
      Ticks left = since;
      for (std::size_t k = 0; k < way.drive.size; ++k) {
        const Step& step = way.drive.steps[k];
        const double share = std::min(1.0, static_cast<double>(left) / step.duration);
        at = moved(at, step.twist.part(share));
        if (left < step.duration) break;
        left -= step.duration;
      }
      if (!keeps(at, r)) return false;
    }
    return true;
  };
  const auto may_rest = [&](Slot s) {
    for (const Rule& r : rules) {
      if (r.kind == Rule::Kind::kRest && (s <= r.to) != r.must) return false;
      const bool rests = r.kind == Rule::Kind::kPoint && r.from >= s * w.params.slot;
      if (rests && !keeps(Frame(w.legs[0].goal), r)) return false;
    }
    return true;
  };
  std::set<std::pair<Slot, std::int32_t>> open{{0, 0}};
  std::set<Slot> ends;
  while (!open.empty()) {
    const auto [s, n] = *open.begin();
    open.erase(open.begin());
    if (s > horizon) break;
    if (may_stand(n, s)) open.insert({s + 1, n});
    for (std::size_t m = 0; m < lattice.num_motions(n); ++m) {
      const std::int32_t to = lattice.target(n, m);
      if (to == Lattice::kBlocked) continue;
      const Lattice::Way way = lattice.way(n, m);
      if (!may_drive(n, way, s)) continue;
      if (to != Lattice::kGoal) {
        open.insert({s + way.slots, to});
      } else if (may_rest(s + way.slots)) {
        ends.insert(s + way.slots);
      }
    }
  }
  return ends.empty() ? -1 : *ends.begin() * w.params.slot;
}

}  // namespace

TEST_CASE("Ways that permute the same motions end in one pose") {
  // A disc of 0.3 m has 7 by 5 places half a metre apart in a hall of 4 m by 3 m.
  const Walk w(disc(0.3), hall(4.0, 3.0), {1.0, 1.0, 0.0}, {{{2.0, 2.0, 0.0}, 0, 0, 0.0}});
  LatticeSearch owner = w.search();
  Lattice& lattice = owner.lattice(0);
  explore(lattice);
  CHECK(lattice.num_nodes() == 7 * 5 * 4);
}

TEST_CASE("Looking back from the goal tells what the best way costs") {
  Dice dice(11);
  Obstacles o = hall(5.0, 3.0);
  add_solid(o, box_points(2.2, 0.7, 2.7, 1.4));
  int compared = 0;
  for (int i = 0; i < 12; ++i) {
    std::vector<Leg> legs{{on_grid(dice, 9, 5), 700, 0, 0.0}};
    if (i % 3 == 0) legs.push_back({on_grid(dice, 9, 5), 0, 0, 0.0});
    Walk w(rectangle(0.8, 0.4), o, on_grid(dice, 9, 5), legs);
    w.objective.time = i % 2 == 0;
    const auto stands = [&](const Pose& p) {
      return w.model.statics[0]->gap(w.model.bodies[0], Frame(p)) > 0.02;
    };
    bool legal = stands(w.start);
    for (const Leg& leg : w.legs) legal = legal && stands(leg.goal);
    if (!legal) continue;
    LatticeSearch owner = w.search();
    REQUIRE(owner.prepare(Heuristic::kLookBack));
    Route route;
    const double cost = w.cost({}, Heuristic::kBound, route);
    REQUIRE(cost >= 0.0);
    CHECK(owner.lattice(0).cost_to_go(0, -1) == doctest::Approx(cost).epsilon(1e-5));
    ++compared;
  }
  CHECK(compared >= 6);
}

TEST_CASE("Under any rules the earliest way is that of trying every slot") {
  // Seed by seed: where it must not stand, what it must not cover or must, when it may rest.
  Obstacles o = hall(3.0, 1.5);
  int none = 0, delayed = 0;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    Dice dice(seed);
    Walk w(disc(0.3), o, on_grid(dice, 5, 2), {{on_grid(dice, 5, 2), 0, 0, 0.0}});
    LatticeSearch owner = w.search();
    explore(owner.lattice(0));
    std::vector<Rule> rules;
    for (int k = dice.below(25); k > 0; --k) {
      const Slot from = dice.below(12);
      const std::int32_t node = dice.below(owner.lattice(0).num_nodes());
      if (dice.below(3) > 0) {
        rules.push_back(stand(k % 5 == 0 ? 0 : node, from, from + dice.below(4)));
      } else {
        const Point p{dice.between(0.3, 2.7), dice.between(0.3, 1.2)};
        rules.push_back(point(p, 250 + 500 * from, 0.0));
      }
    }
    if (seed % 4 == 0) rules.push_back(rest(dice.below(10), false));
    if (seed % 5 == 0) rules.push_back(rest(12 + dice.below(6), true));
    if (seed % 6 == 0) rules.push_back(point({w.start.x, w.start.y}, 1500, 0.0, true));
    Route route;
    const Ticks best = earliest_rest(w, rules, 60);
    const double cost = w.cost(rules, Heuristic::kLookBack, route);
    INFO("seed ", seed);
    CHECK(cost == doctest::Approx(best));
    Route free;
    none += best < 0;
    delayed += best > w.cost({}, Heuristic::kLookBack, free);
  }
  CHECK(none > 0);
  CHECK(delayed > 20);
}
