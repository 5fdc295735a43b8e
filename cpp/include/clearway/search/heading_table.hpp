// Primitives rolled out for every heading, and the cost of analytic connections, tabled.
#pragma once

#include <vector>

#include "clearway/geometry/body.hpp"
#include "clearway/motion/table.hpp"
#include "clearway/space/statics.hpp"

namespace clearway {

// The primitives of a table placed at headings base + k * step.
class HeadingTable {
 public:
  HeadingTable(const MotionTable& table, const std::vector<Body>& bodies, double theta);

  int headings() const { return headings_; }
  // Index of the heading nearest to theta.
  int index(double theta) const;
  double theta(int k) const { return base_ + step_ * k; }
  Frame frame(double x, double y, int k) const {
    const auto i = static_cast<std::size_t>(k);
    return {x, y, cosine_[i], sine_[i]};
  }

  struct Landing {
    double dx, dy;
    int k;
  };
  const Landing& landing(int k, std::size_t primitive) const {
    return landings_[static_cast<std::size_t>(k) * num_primitives_ + primitive];
  }

  // Whether discs that cover the whole motion are clear: true proves it, false proves nothing.
  bool surely_clear(const Statics& statics, int body, double x, double y, int k,
                    std::size_t primitive, double required) const {
    const std::size_t at = (static_cast<std::size_t>(body) * static_cast<std::size_t>(headings_) +
                            static_cast<std::size_t>(k)) *
                               num_primitives_ +
                           primitive;
    for (std::uint32_t i = first_disc_[at]; i < first_disc_[at + 1]; ++i) {
      const Circle& d = discs_[i];
      if (statics.clearance(x + d.x, y + d.y) < d.r + required) return false;
    }
    return true;
  }

 private:
  int headings_;
  std::size_t num_primitives_;
  double base_, step_;
  std::vector<double> cosine_, sine_;
  std::vector<Landing> landings_;
  std::vector<std::uint32_t> first_disc_;
  std::vector<Circle> discs_;
};

// Objective value of the best obstacle-free connection to a goal, filled on first use.
class ConnectTable {
 public:
  ConnectTable(const MotionTable& table, const Objective& objective);

  // Value from a pose given in the goal's frame; negative where the table does not reach.
  double operator()(double x, double y, double turn);

 private:
  static constexpr int kHeadings = 32;
  const MotionTable* table_;
  Objective objective_;
  double cell_;
  int half_;
  bool reversible_ = true;
  std::vector<float> value_;
  std::vector<Shot> scratch_;
};

}  // namespace clearway
