#include "clearway/motion/reeds_shepp.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

using namespace clearway;
using scenes::kPi;

namespace {

Pose end_of(const Word& word) {
  Pose at;
  for (std::size_t i = 0; i < static_cast<std::size_t>(word.size); ++i) {
    at = moved(at, Twist{word.length[i], 0.0, word.length[i] * static_cast<int>(word.turn[i])});
  }
  return at;
}

double miss(const Word& word, double x, double y, double phi) {
  const Pose end = end_of(word);
  return std::max({std::abs(end.x - x), std::abs(end.y - y), std::abs(wrap(end.theta - phi))});
}

}  // namespace

TEST_CASE(
    "Every word ends at its goal, and none is shorter than the shortest or than the air line") {
  scenes::Dice dice(21);
  double worst = 0.0, undercut = 0.0;
  int words = 0, lonely = 0;
  for (int i = 0; i < 100000; ++i) {
    const double size = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 4.0 : 15.0;
    const double x = dice.between(-size, size), y = dice.between(-size, size);
    const double phi = dice.between(-kPi, kPi);
    const double shortest = reeds_shepp_length(x, y, phi);
    int here = 0;
    reeds_shepp_words(x, y, phi, [&](const Word& word) {
      ++here;
      worst = std::max(worst, miss(word, x, y, phi));
      undercut = std::max(undercut, shortest - word.total());
    });
    words += here;
    lonely += here == 0;
    undercut = std::max({undercut, std::hypot(x, y) - shortest, std::abs(phi) - shortest});
  }
  CHECK(worst < 1e-6);
  CHECK(undercut < 1e-9);
  CHECK(lonely == 0);
  CHECK(words > 500000);
}

TEST_CASE(
    "No drive, however it is put together, is shorter than the shortest word to where it ends") {
  scenes::Dice dice(22);
  double undercut = 0.0;
  for (int i = 0; i < 100000; ++i) {
    Word drive;
    drive.size = 1 + dice.below(5);
    for (std::size_t k = 0; k < static_cast<std::size_t>(drive.size); ++k) {
      drive.turn[k] = static_cast<Turn>(dice.below(3) - 1);
      drive.length[k] = dice.between(-2.0, 2.0);
    }
    const Pose end = end_of(drive);
    undercut =
        std::max(undercut, reeds_shepp_length(end.x, end.y, wrap(end.theta)) - drive.total());
  }
  CHECK(undercut < 1e-6);
}

TEST_CASE("Mirrored, reversed and driven from the other end, a curve keeps its length") {
  scenes::Dice dice(23);
  for (int i = 0; i < 5000; ++i) {
    const double x = dice.between(-6, 6), y = dice.between(-6, 6), phi = dice.between(-kPi, kPi);
    const double length = reeds_shepp_length(x, y, phi);
    CHECK(std::abs(reeds_shepp_length(x, -y, -phi) - length) < 1e-7);
    CHECK(std::abs(reeds_shepp_length(-x, y, -phi) - length) < 1e-7);
    CHECK(std::abs(reeds_shepp_length(-x, -y, phi) - length) < 1e-7);
    const Point home = Frame(Pose{x, y, phi}).to_local({0.0, 0.0});
    CHECK(std::abs(reeds_shepp_length(home.x, home.y, -phi) - length) < 1e-7);
  }
}

TEST_CASE("Straight ahead and straight back are as long as they look") {
  for (const double d : {0.001, 0.5, 3.0, 40.0}) {
    CHECK(reeds_shepp_length(d, 0, 0) == doctest::Approx(d));
    CHECK(reeds_shepp_length(-d, 0, 0) == doctest::Approx(d));
    const Word back = reeds_shepp_shortest(-d, 0, 0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(back.size); ++i)
      CHECK(back.length[i] < 1e-9);
  }
  CHECK(reeds_shepp_length(0, 0, 0) == doctest::Approx(0.0));
}

TEST_CASE("Curves known by hand") {
  CHECK(reeds_shepp_length(0, 2, kPi) == doctest::Approx(kPi));          // half a circle
  CHECK(reeds_shepp_length(1, 1, kPi / 2) == doctest::Approx(kPi / 2));  // a quarter
  CHECK(reeds_shepp_length(3, 1, kPi / 2) == doctest::Approx(2 + kPi / 2));
  // Turning about on the spot: three arcs of 60 degrees with two cusps.
  CHECK(reeds_shepp_length(0, 0, kPi) == doctest::Approx(kPi));
}
