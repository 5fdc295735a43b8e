#include "clearway/budget.hpp"

#include <doctest/doctest.h>

using namespace clearway;

TEST_CASE("A budget of ten lets ten be spent and stays at an end") {
  Budget budget;
  budget.expansions = 10;
  for (int i = 0; i < 10; ++i) CHECK(budget.spend());
  CHECK(!budget.ended);
  CHECK(!budget.spend());
  CHECK(budget.ended);
  budget.expansions = 1000;
  CHECK(!budget.spend());
}

TEST_CASE("Without a limit nothing ends it but being asked to stop") {
  Budget budget;
  int asked = 0;
  budget.stop = [&asked] { return ++asked == 3; };
  int spent = 0;
  while (budget.spend()) ++spent;
  // Asked every 512th time: the third is number 1536.
  CHECK(spent == 1535);
  CHECK(asked == 3);
}
