// What stands still: obstacle edges and discs behind a distance field.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/geometry/body.hpp"

namespace clearway {

struct Box {
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
};

// Obstacles of one layer. Polygons come as their edges plus their outline in `solids`, so that
// the field knows their inside; a body that starts outside can only enter across an edge.
struct Obstacles {
  Box box;  // of the site; outside of it nothing drives
  std::vector<Segment> segments;
  std::vector<Circle> discs;
  std::vector<std::vector<Point>> solids;  // polygons whose inside is blocked
  std::vector<Point> bounds;               // polygon whose outside is blocked; may be empty
};

class Statics {
 public:
  // `reach`: the largest circumradius of any body that will ask.
  Statics(Obstacles obstacles, double reach);

  const Box& box() const { return box_; }

  // Lower bound of the distance from a point to the nearest obstacle, at most saturation().
  double clearance(double x, double y) const {
    const double fx = (x - box_.x0) * inverse_cell_, fy = (y - box_.y0) * inverse_cell_;
    if (!(fx >= 0.0 && fy >= 0.0 && fx < width_ && fy < height_)) return 0.0;
    return field_[static_cast<std::size_t>(fy) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(fx)] *
           unit_;
  }
  double saturation() const { return saturation_; }
  // How much less than the true distance clearance() may say.
  double loss() const { return std::numbers::sqrt2 * cell_ + unit_; }

  // Lower bound of a placed body's gap, by its cover circles.
  double cover_gap(const Body& body, const Frame& f) const;

  // Signed gap of a placed body (see geometry/body.hpp), at most `reach + 0.5 - circumradius`.
  double gap(const Body& body, const Frame& f) const;

  // Whether a body keeps `required` all along a motion: continuous, by conservative advancement.
  // Between two exact tests the gap can fall short of `required` by at most slack / 2.
  bool clear(const Body& body, const Frame& start, const Twist& motion, double required,
             double slack) const;

 private:
  void fill_field(const Obstacles& obstacles);
  void block_inside(const std::vector<Point>& polygon, bool inside);
  void fill_buckets();

  Box box_;
  double reach_;
  double saturation_;
  double unit_ = 0.0, cell_ = 0.0, inverse_cell_ = 0.0;
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> field_;

  std::vector<Segment> segments_;
  std::vector<Circle> discs_;
  int bucket_width_ = 0, bucket_height_ = 0;
  std::vector<std::int32_t> bucket_start_;
  std::vector<std::int32_t> bucket_items_;  // segments first, then discs
};

}  // namespace clearway
