// Reeds-Shepp words: all families of shortest curves of bounded curvature with cusps.
#pragma once

#include <array>

#include "clearway/geometry/pose.hpp"

namespace clearway {

enum class Turn : signed char { kRight = -1, kStraight = 0, kLeft = 1 };

// A candidate word for turning radius 1: signed lengths, negative backwards.
struct Word {
  int size = 0;
  std::array<Turn, 5> turn{};
  std::array<double, 5> length{};

  double total() const {
    double sum = 0.0;
    for (int i = 0; i < size; ++i) sum += std::abs(length[static_cast<std::size_t>(i)]);
    return sum;
  }
};

// Calls `visit(word)` for each word that leads from the origin to (x, y, phi), radius 1.
// Source: J. A. Reeds, L. A. Shepp, "Optimal paths for a car that goes both forwards and
// backwards", Pacific J. Math. 145 (1990), Sec. 8, formulas 8.1-8.11.
template <typename Visit>
void reeds_shepp_words(double x, double y, double phi, Visit&& visit);

// Length of the shortest word for radius 1.
double reeds_shepp_length(double x, double y, double phi);

// The shortest word for radius 1.
Word reeds_shepp_shortest(double x, double y, double phi);

}  // namespace clearway

#include "clearway/motion/reeds_shepp_words.hpp"
