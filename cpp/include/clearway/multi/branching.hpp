// Where two routes meet, and how a search may branch on it without losing the best plan.
#pragma once

#include <memory>
#include <vector>

#include "clearway/multi/team.hpp"
#include "clearway/search/lattice_search.hpp"

namespace clearway {

// What all searches for one team share.
struct Routing {
  Team* team = nullptr;
  Ticks slot = 100;
  std::vector<Rest> rests;
  std::vector<std::unique_ptr<LatticeSearch>> searches;  // null: stands at its start for ever
  std::vector<Rule> always;                              // for everybody: keep clear of those
};

struct Meeting {
  int a = -1, b = -1;
  double tick = 0.0;
};

// First tick at which two routes meet; negative if never. The same for (a, b) and (b, a).
double first_meeting(const Routing& routing, const Route& a, int robot_a, const Route& b,
                     int robot_b);

// Two sides, each with a rule for one of the robots that meet: no plan without conflict is lost,
// for whatever one rule forbids meets whatever the other forbids. Where the other robot is `bound`,
// it must do on this side what is forbidden it on the other one, so that no plan is on both sides;
// then the rule holds for all robots but that one.
struct Branching {
  Rule rule[2];
  bool bound[2] = {false, false};
};

Branching branch(const Routing& routing, const Meeting& meeting, const Route& a, const Route& b);

// A robot that comes so near to a point meets another one that is within `gap` of it.
double point_gap(const Routing& routing, int robot, int other, double gap);

// What a robot that is bound does: the opposite of the rule for the others.
Rule opposite(Rule rule);

}  // namespace clearway
