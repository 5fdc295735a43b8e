#include "clearway/geometry/body.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace clearway {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMaxVertices = 64;

double distance_to_segment(Point p, Point a, Point b) {
  const Point ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return length(p - Point{a.x + t * ab.x, a.y + t * ab.y});
}

// Circles along the longer side of a convex part's bounding box.
void cover_part(const Convex& part, std::vector<Circle>& out) {
  Point lo{kInfinity, kInfinity}, hi{-kInfinity, -kInfinity};
  for (const Point& v : part.vertices()) {
    lo = {std::min(lo.x, v.x), std::min(lo.y, v.y)};
    hi = {std::max(hi.x, v.x), std::max(hi.y, v.y)};
  }
  const bool along_x = hi.x - lo.x >= hi.y - lo.y;
  const double length = along_x ? hi.x - lo.x : hi.y - lo.y;
  const double width = along_x ? hi.y - lo.y : hi.x - lo.x;
  const int count = std::clamp(static_cast<int>(std::lround(2.0 * length / width)), 1, 8);
  const double radius = 0.5 * std::hypot(length / count, width);
  for (int i = 0; i < count; ++i) {
    const double along = (i + 0.5) * length / count;
    if (along_x) {
      out.push_back({lo.x + along, 0.5 * (lo.y + hi.y), radius});
    } else {
      out.push_back({0.5 * (lo.x + hi.x), lo.y + along, radius});
    }
  }
}

}  // namespace

Convex::Convex(std::vector<Point> vertices) : vertices_(std::move(vertices)) {
  const std::size_t n = vertices_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = vertices_[i], b = vertices_[(i + 1) % n];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length < 1e-12) continue;
    const Point normal{(b.y - a.y) / length, -(b.x - a.x) / length};
    normals_.push_back(normal);
    offsets_.push_back(dot(normal, a));
  }
  if (n != 4 || normals_.size() != 4) return;
  const Point u = vertices_[1] - vertices_[0], v = vertices_[2] - vertices_[1];
  const Point w = vertices_[3] - vertices_[2];
  const double scale = length(u) + length(v);
  is_rectangle_ = std::abs(dot(u, v)) < 1e-12 * scale * scale && length(u + w) < 1e-12 * scale;
  const Point middle{0.5 * (vertices_[0].x + vertices_[2].x),
                     0.5 * (vertices_[0].y + vertices_[2].y)};
  rectangle_ = {{middle.x, middle.y, u.x / length(u), u.y / length(u)},
                0.5 * length(u),
                0.5 * length(v)};
}

double Convex::gap(Point p) const {
  double deepest = -kInfinity;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    deepest = std::max(deepest, dot(normals_[i], p) - offsets_[i]);
  }
  if (deepest <= 0.0) return deepest;
  double nearest = kInfinity;
  const std::size_t n = vertices_.size();
  for (std::size_t i = 0; i < n; ++i) {
    nearest = std::min(nearest, distance_to_segment(p, vertices_[i], vertices_[(i + 1) % n]));
  }
  return nearest;
}

double Convex::gap(const Segment& s) const {
  double best = -kInfinity;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    best = std::max(best, std::min(dot(normals_[i], s.p), dot(normals_[i], s.q)) - offsets_[i]);
  }
  const Point d = s.q - s.p;
  const double extent = length(d);
  if (extent < 1e-12) return gap(s.p);
  const Point normal{d.y / extent, -d.x / extent};
  double lo = kInfinity, hi = -kInfinity;
  for (const Point& v : vertices_) {
    const double h = dot(normal, v - s.p);
    lo = std::min(lo, h);
    hi = std::max(hi, h);
  }
  return std::max({best, lo, -hi});
}

double Convex::separation(const Point* points, std::size_t count, double enough) const {
  double best = -kInfinity;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    double lo = kInfinity;
    for (std::size_t j = 0; j < count; ++j) lo = std::min(lo, dot(normals_[i], points[j]));
    best = std::max(best, lo - offsets_[i]);
    if (best >= enough) return best;
  }
  return best;
}

Body::Body(const std::vector<std::vector<Point>>& parts, double disc_radius) : disc_(disc_radius) {
  if (parts.empty()) {
    circumradius_ = inradius_ = bound_.r = disc_;
    cover_.push_back({0.0, 0.0, disc_});
    return;
  }
  Point lo{kInfinity, kInfinity}, hi{-kInfinity, -kInfinity};
  for (const auto& vertices : parts) {
    if (vertices.size() < 3 || vertices.size() > kMaxVertices) {
      throw std::invalid_argument("a convex part needs 3 to 64 points, got " +
                                  std::to_string(vertices.size()));
    }
    parts_.emplace_back(vertices);
    for (const Point& v : vertices) {
      circumradius_ = std::max(circumradius_, std::hypot(v.x, v.y));
      lo = {std::min(lo.x, v.x), std::min(lo.y, v.y)};
      hi = {std::max(hi.x, v.x), std::max(hi.y, v.y)};
    }
    inradius_ = std::max(inradius_, -parts_.back().gap(Point{0.0, 0.0}));
    cover_part(parts_.back(), cover_);
  }
  const Point centre{0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y)};
  bound_ = {centre.x, centre.y, 0.0};
  for (const auto& vertices : parts) {
    for (const Point& v : vertices) bound_.r = std::max(bound_.r, length(v - centre));
  }
}

namespace {

// Separating-axis gap of two rectangles, the second one's centre seen from the first one's.
double gap(const Rectangle& a, const Rectangle& b, const Frame& seen) {
  const double c = std::abs(seen.c), s = std::abs(seen.s);
  const double x = std::abs(seen.x), y = std::abs(seen.y);
  const double u = std::abs(seen.c * seen.x + seen.s * seen.y);
  const double v = std::abs(seen.c * seen.y - seen.s * seen.x);
  return std::max(std::max(x - a.along - c * b.along - s * b.across,
                           y - a.across - s * b.along - c * b.across),
                  std::max(u - b.along - c * a.along - s * a.across,
                           v - b.across - s * a.along - c * a.across));
}

Frame composed(const Frame& a, const Frame& b) {
  const Point p = a.to_world({b.x, b.y});
  return {p.x, p.y, a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s};
}

// Separating-axis gap of two convex parts, `b` placed by `seen` in the frame of `a`.
double gap(const Convex& a, const Convex& b, const Frame& seen, double enough) {
  const Rectangle *first_box = a.rectangle(), *second_box = b.rectangle();
  if (first_box && second_box) {
    return gap(*first_box, *second_box,
               relative(first_box->centre, composed(seen, second_box->centre)));
  }
  Point buffer[kMaxVertices];
  const auto place = [&buffer](const std::vector<Point>& vertices, const Frame& f) {
    for (std::size_t i = 0; i < vertices.size(); ++i) buffer[i] = f.to_world(vertices[i]);
  };
  place(b.vertices(), seen);
  const double first = a.separation(buffer, b.vertices().size(), enough);
  if (first >= enough) return first;
  place(a.vertices(), inverse(seen));
  return std::max(first, b.separation(buffer, a.vertices().size(), enough));
}

}  // namespace

double gap(const Body& a, const Frame& fa, const Body& b, const Frame& fb, double enough) {
  if (a.parts().empty() && b.parts().empty()) {
    return length({fa.x - fb.x, fa.y - fb.y}) - a.disc() - b.disc();
  }
  double least = kInfinity;
  if (a.parts().empty() || b.parts().empty()) {
    const bool disc_is_a = a.parts().empty();
    const Body& disc = disc_is_a ? a : b;
    const Frame& centre = disc_is_a ? fa : fb;
    const Point p = (disc_is_a ? fb : fa).to_local({centre.x, centre.y});
    for (const Convex& part : (disc_is_a ? b : a).parts()) {
      least = std::min(least, part.gap(p) - disc.disc());
    }
    return least;
  }
  const Frame seen = relative(fa, fb);
  for (const Convex& pa : a.parts()) {
    for (const Convex& pb : b.parts()) least = std::min(least, gap(pa, pb, seen, enough));
  }
  return least;
}

double gap(const Body& body, const Frame& f, const Segment& s) {
  const Segment local{f.to_local(s.p), f.to_local(s.q)};
  if (body.parts().empty()) {
    return distance_to_segment({0.0, 0.0}, local.p, local.q) - body.disc();
  }
  double least = kInfinity;
  for (const Convex& part : body.parts()) least = std::min(least, part.gap(local));
  return least;
}

double gap(const Body& body, const Frame& f, const Circle& disc) {
  const Point centre = f.to_local({disc.x, disc.y});
  if (body.parts().empty()) return length(centre) - body.disc() - disc.r;
  double least = kInfinity;
  for (const Convex& part : body.parts()) least = std::min(least, part.gap(centre) - disc.r);
  return least;
}

}  // namespace clearway
