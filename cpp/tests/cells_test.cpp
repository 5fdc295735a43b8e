#include "clearway/search/cells.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;

TEST_CASE("Who comes later to where one could have waited is covered, who comes earlier is not") {
  Cells cells;
  cells.reset(1.0, 1.0);
  cells.add(3.5, 4.5, 2, 0, 0, {1000, 5000, 1000.0});
  CHECK(cells.covering(3.9, 4.1, 2, 0, 0, 1000, 1000.0, 0));
  CHECK(cells.covering(3.9, 4.1, 2, 0, 0, 5000, 5000.0, 0));
  CHECK(!cells.covering(3.9, 4.1, 2, 0, 0, 999, 999.0, 0));
  CHECK(!cells.covering(3.9, 4.1, 2, 0, 0, 5001, 5001.0, 0));
}

TEST_CASE("Whoever comes more cheaply is not covered") {
  // A tick of waiting costs 0.01: waiting from 1000 to 3000 makes 5 into 25.
  Cells cells;
  cells.reset(1.0, 0.01);
  cells.add(0.5, 0.5, 0, 0, 0, {1000, 5000, 5.0});
  CHECK(!cells.covering(0.5, 0.5, 0, 0, 0, 3000, 24.9, 0));
  CHECK(cells.covering(0.5, 0.5, 0, 0, 0, 3000, 25.1, 0));
  // The asker's own waiting counts for him too: 24.9 and 20 ticks make 25.1.
  CHECK(cells.covering(0.5, 0.5, 0, 0, 0, 3000, 24.9, 20));
}

TEST_CASE("Another cell, heading, leg or mode is another place") {
  Cells cells;
  cells.reset(1.0, 1.0);
  cells.distinguish_modes(true);
  cells.add(3.5, -4.5, 2, 1, 3, {0, kNever, 0.0});
  CHECK(cells.covering(3.5, -4.5, 2, 1, 3, 10, 10.0, 0));
  CHECK(!cells.covering(4.5, -4.5, 2, 1, 3, 10, 10.0, 0));
  CHECK(!cells.covering(3.5, -3.5, 2, 1, 3, 10, 10.0, 0));
  CHECK(!cells.covering(3.5, -4.5, 3, 1, 3, 10, 10.0, 0));
  CHECK(!cells.covering(3.5, -4.5, 2, 0, 3, 10, 10.0, 0));
  CHECK(!cells.covering(3.5, -4.5, 2, 1, 4, 10, 10.0, 0));
  CHECK(!cells.covering(3.5, -4.5, 2, 1, -1, 10, 10.0, 0));
}

TEST_CASE("Where switching costs nothing modes share a place") {
  Cells cells;
  cells.reset(1.0, 1.0);
  cells.add(0, 0, 0, 0, 3, {0, kNever, 0.0});
  CHECK(cells.covering(0, 0, 0, 0, 5, 10, 10.0, 0));
}

TEST_CASE("Nothing is lost or mixed up while the table grows past many thousand places") {
  Cells cells;
  cells.reset(0.5, 1.0);
  scenes::Dice dice(61);
  struct Entry {
    double x, y;
    int k, leg;
    Interval interval;
  };
  std::vector<Entry> entries;
  for (int ix = 0; ix < 60; ++ix) {
    for (int iy = 0; iy < 60; ++iy) {
      for (int k = 0; k < 8; ++k) {
        const auto begin = static_cast<Ticks>(dice.between(0, 1000));
        entries.push_back({0.5 * ix - 10.0 + 0.2,
                           0.5 * iy - 10.0 + 0.2,
                           k,
                           ix % 3,
                           {begin, begin + 100, static_cast<double>(begin)}});
        const Entry& e = entries.back();
        cells.add(e.x, e.y, e.k, e.leg, 0, e.interval);
      }
    }
  }
  for (const Entry& e : entries) {
    CHECK(cells.covering(e.x, e.y, e.k, e.leg, 0, e.interval.begin, e.interval.cost, 0));
    CHECK(!cells.covering(e.x, e.y, e.k, e.leg, 0, e.interval.begin - 1, e.interval.cost, 0));
    CHECK(!cells.covering(e.x, e.y, e.k, e.leg, 0, e.interval.end + 1, 1e9, 0));
    CHECK(!cells.covering(e.x, e.y, e.k, 3, 0, e.interval.begin, 1e9, 0));
  }
}

TEST_CASE("A place keeps all its intervals") {
  Cells cells;
  cells.reset(1.0, 1.0);
  for (Ticks t = 0; t < 10; ++t) cells.add(0, 0, 0, 0, 0, {t * 100, t * 100 + 50, t * 100.0});
  for (Ticks t = 0; t < 1000; ++t) {
    CHECK((cells.covering(0, 0, 0, 0, 0, t, t, 0) != nullptr) == (t % 100 <= 50));
  }
}

TEST_CASE("After a reset nothing is known any more, however often that happens") {
  Cells cells;
  for (int round = 0; round < 50; ++round) {
    cells.reset(0.5, 1.0);
    cells.distinguish_modes(round % 2);
    for (int i = 0; i < 40; ++i) CHECK(!cells.covering(0.5 * i, 2, 0, 0, 0, 500, 1e9, 0));
    // In one round the table grows.
    for (int i = 0; i < (round == 7 ? 9000 : 20); ++i) {
      cells.add(0.5 * i, 2, 0, 0, 0, {0, kNever, 0.0, 900});
    }
    CHECK(cells.covering(0, 2, 0, 0, 0, 500, 500.0, 0));
    CHECK(cells.meeting(0, 2, 0, 0, 0, 900));
  }
  cells.reset(0.5, 1.0);
  CHECK(!cells.meeting(0, 2, 0, 0, 0, 900));
  CHECK(!cells.covering(0, 2, 0, 0, 5, 500, 1e9, 0));
  // Modes share a place again, until they are told apart.
  cells.add(0, 2, 0, 0, 1, {0, kNever, 0.0});
  CHECK(cells.covering(0, 2, 0, 0, 5, 500, 500.0, 0));
}

TEST_CASE("The interval at whose end somebody is met is found by that tick and can be written to") {
  Cells cells;
  cells.reset(1.0, 1.0);
  cells.add(0.5, 0.5, 3, 1, 0, {0, 999, 0.0, 1000});
  cells.add(0.5, 0.5, 3, 1, 0, {2000, 3000, 9.0, 3040});
  cells.add(1.5, 0.5, 3, 1, 0, {0, 500, 0.0, 501});
  REQUIRE(cells.meeting(0.7, 0.2, 3, 1, 0, 1000));
  CHECK(cells.meeting(0.7, 0.2, 3, 1, 0, 1000)->end == 999);
  CHECK(cells.meeting(0.7, 0.2, 3, 1, 0, 3040)->begin == 2000);
  CHECK(!cells.meeting(0.7, 0.2, 3, 1, 0, 999));
  CHECK(!cells.meeting(0.7, 0.2, 3, 1, 0, 501));
  CHECK(!cells.meeting(0.7, 0.2, 2, 1, 0, 1000));
  CHECK(!cells.meeting(0.7, 0.2, 3, 0, 0, 1000));
  cells.meeting(0.7, 0.2, 3, 1, 0, 1000)->free = 1800;
  CHECK(cells.meeting(0.5, 0.5, 3, 1, 0, 1000)->free == 1800);
  CHECK(cells.meeting(0.5, 0.5, 3, 1, 0, 3040)->free < 0);
}
