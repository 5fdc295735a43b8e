// Obstacle-aware distance to a goal: Dijkstra once per goal, shared by all who go there.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/space/statics.hpp"

namespace clearway {

// Grid over a site: which cells a disc of the given radius may be in, and ways between them.
class GoalDistance {
 public:
  // 16 neighbours, so that a distance exceeds the any-angle one by at most 3 %.
  GoalDistance(const Statics& statics, double radius, double goal_x, double goal_y, double cell);

  // Distance from a point to the goal (m), interpolated by cell; infinite where there is no way.
  float operator()(double x, double y) const {
    const double fx = (x - box_.x0) * inverse_cell_, fy = (y - box_.y0) * inverse_cell_;
    if (!(fx >= 0.0 && fy >= 0.0 && fx < width_ && fy < height_)) return kUnreachable;
    return distance_[static_cast<std::size_t>(fy) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(fx)];
  }

  std::int64_t num_cells() const { return static_cast<std::int64_t>(distance_.size()); }

  static constexpr float kUnreachable = 1e30F;

 private:
  Box box_;
  double inverse_cell_;
  int width_, height_;
  std::vector<float> distance_;
};

}  // namespace clearway
