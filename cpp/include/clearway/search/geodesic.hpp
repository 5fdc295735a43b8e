// Shortest way of a disc's centre among obstacles, any angle: a true lower bound of travel.
#pragma once

#include <cstdint>
#include <vector>

#include "clearway/space/statics.hpp"

namespace clearway {

// Every obstacle edge is swollen by the disc's radius, as a polygon inside the true swelling, so
// that a length found here never exceeds that of any motion of the disc. Shortest ways bend only
// at these polygons' corners; they are found by A* over mutually visible corners.
class Geodesic {
 public:
  // `radius` (m): of a disc that the body holds about its reference point.
  Geodesic(const Obstacles& obstacles, double radius);

  // Length of the shortest way (m); infinite where there is none. Never less than the distance.
  double operator()(Point from, Point to);

 private:
  struct Corner {
    Point at;
    Point before, after;  // its neighbours on the same polygon
  };

  void add(std::vector<Point> polygon);
  bool visible(Point a, Point b) const;
  const std::vector<std::int32_t>& seen_from(std::int32_t corner);
  std::vector<std::int32_t> tangents_from(Point p, const Corner* own) const;

  Box box_;
  int width_ = 0, height_ = 0;
  std::vector<std::vector<Point>> polygons_;  // convex, counter-clockwise
  std::vector<Corner> corners_;
  std::vector<std::vector<std::int32_t>> cells_;  // polygons whose box touches each grid cell
  std::vector<std::vector<std::int32_t>> seen_;   // filled on first use
  std::vector<bool> known_;
};

}  // namespace clearway
