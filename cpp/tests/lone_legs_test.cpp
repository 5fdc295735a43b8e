#include "clearway/multi/lone_legs.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using namespace scenes;

TEST_CASE("Legs driven alone last as long as their way, or have none") {
  Obstacles o = hall(20, 12);
  o.segments.push_back({{10, 0}, {10, 12}});
  const Model model = rover(rectangle(1.0, 0.6), o);
  const Pose start{2, 6, 0};
  Budget budget;
  const std::vector<Ticks> ticks = lone_durations(
      model, {}, {}, 0.01,
      {{start, {8, 6, 0}, 0}, {start, {15, 6, 0}, 0}, {start, start, 0}, {{3, 6, 0}, {8, 6, 0}, 0}},
      20000, budget);
  CHECK(ticks == std::vector<Ticks>{6000, -1, 0, 5000});
}

TEST_CASE("A leg along a wall keeps what its ends leave") {
  // 0.1 m beside the wall, where 0.5 m are asked.
  const Model model = rover(rectangle(1.0, 0.6), hall(20, 12), 0.5);
  Budget budget;
  CHECK(lone_durations(model, {}, {}, 0.01, {{{2, 0.4, 0}, {12, 0.4, 0}, 0}}, 20000, budget) ==
        std::vector<Ticks>{10000});
}

TEST_CASE("A stop ends the legs where it is") {
  const Model model = rover(rectangle(1.0, 0.6), hall(20, 12));
  Budget budget;
  budget.expansions = 0;
  CHECK(lone_durations(model, {}, {}, 0.01, {{{2, 6, 0}, {8, 6, 0}, 0}}, 20000, budget).empty());
}
