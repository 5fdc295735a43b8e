// A robot's body: convex parts or a disc, with exact gaps to other bodies and to obstacles.
#pragma once

#include <algorithm>
#include <vector>

#include "clearway/geometry/pose.hpp"

namespace clearway {

struct Circle {
  double x = 0.0, y = 0.0, r = 0.0;
};

struct Segment {
  Point p, q;
};

// A rectangle: its centre's frame and half its sides.
struct Rectangle {
  Frame centre;
  double along = 0.0, across = 0.0;
};

// Convex polygon, counter-clockwise, with its outward edge normals and their offsets.
class Convex {
 public:
  explicit Convex(std::vector<Point> vertices);

  // As a rectangle, where it is one; else null.
  const Rectangle* rectangle() const { return is_rectangle_ ? &rectangle_ : nullptr; }

  const std::vector<Point>& vertices() const { return vertices_; }

  // Gap to a point: exact, negative inside (depth to the nearest edge). `axis`: the direction
  // along which it is measured, outwards.
  double gap(Point p, Point* axis = nullptr) const;

  // Gap to a segment: exact depth when it cuts, never more than the distance when clear.
  double gap(const Segment& s) const;

  // Largest separation along this polygon's normals of points given in its frame. `axis`: that
  // normal.
  double separation(const Point* points, std::size_t count, double enough, Point* axis) const;

 private:
  std::vector<Point> vertices_;
  std::vector<Point> normals_;
  std::vector<double> offsets_;
  Rectangle rectangle_;
  bool is_rectangle_ = false;
};

class Body {
 public:
  // Convex parts in the body frame; none for a disc of the given radius.
  Body(const std::vector<std::vector<Point>>& parts, double disc_radius);

  const std::vector<Convex>& parts() const { return parts_; }
  double disc() const { return disc_; }

  // Radius about the reference point that holds the whole body.
  double circumradius() const { return circumradius_; }
  // A small circle that holds the whole body, wherever its centre lies.
  const Circle& bound() const { return bound_; }
  // Radius about the reference point that the body covers; 0 if the point lies outside.
  double inradius() const { return inradius_; }
  // Circles that together cover the body.
  const std::vector<Circle>& cover() const { return cover_; }

 private:
  std::vector<Convex> parts_;
  double disc_ = 0.0;
  double circumradius_ = 0.0;
  double inradius_ = 0.0;
  Circle bound_;
  std::vector<Circle> cover_;
};

// A gap, and the direction in the world, from the first body to the second, along which it was
// measured: along it the two are that far apart.
struct Separation {
  double gap = 0.0;
  Point axis;
};

// Calls `visit(separation)` for each pair of a part of `a` with a part of `b`.
template <typename Visit>
void for_each_separation(const Body& a, const Frame& fa, const Body& b, const Frame& fb,
                         double enough, Visit&& visit);

// Signed gap between two placed bodies: exact depth when they overlap, a lower bound of the
// distance (equal to it except corner against corner) when they do not. Anything at or above
// `enough` may be returned as soon as it is known.
double gap(const Body& a, const Frame& fa, const Body& b, const Frame& fb, double enough);

// Signed gap between a placed body and a segment or a disc, likewise.
double gap(const Body& body, const Frame& f, const Segment& s);
double gap(const Body& body, const Frame& f, const Circle& disc);

// One pair of parts; a null part stands for the body's disc.
Separation separation(const Body& a, const Convex* part_a, const Frame& fa, const Body& b,
                      const Convex* part_b, const Frame& fb, double enough);

template <typename Visit>
void for_each_separation(const Body& a, const Frame& fa, const Body& b, const Frame& fb,
                         double enough, Visit&& visit) {
  const std::size_t num_a = a.parts().size(), num_b = b.parts().size();
  for (std::size_t i = 0; i < std::max<std::size_t>(1, num_a); ++i) {
    for (std::size_t j = 0; j < std::max<std::size_t>(1, num_b); ++j) {
      visit(separation(a, num_a ? &a.parts()[i] : nullptr, fa, b, num_b ? &b.parts()[j] : nullptr,
                       fb, enough));
    }
  }
}

}  // namespace clearway
