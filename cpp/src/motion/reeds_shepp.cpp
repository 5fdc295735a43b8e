#include "clearway/motion/reeds_shepp.hpp"

#include <limits>

namespace clearway {

Word reeds_shepp_shortest(double x, double y, double phi) {
  Word best;
  double least = std::numeric_limits<double>::infinity();
  reeds_shepp_words(x, y, phi, [&](const Word& word) {
    const double total = word.total();
    if (total < least) {
      least = total;
      best = word;
    }
  });
  return best;
}

double reeds_shepp_length(double x, double y, double phi) {
  return reeds_shepp_shortest(x, y, phi).total();
}

}  // namespace clearway
