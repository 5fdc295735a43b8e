#include "clearway/geometry/body.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace clearway {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMaxVertices = 64;

Point nearest_on_segment(Point p, Point a, Point b) {
  const Point ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return {a.x + t * ab.x, a.y + t * ab.y};
}

double distance_to_segment(Point p, Point a, Point b) {
  return length(p - nearest_on_segment(p, a, b));
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
  rectangle_ = {
      {middle.x, middle.y, u.x / length(u), u.y / length(u)}, 0.5 * length(u), 0.5 * length(v)};
}

double Convex::gap(Point p, Point* axis) const {
  double deepest = -kInfinity;
  std::size_t side = 0;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    const double depth = dot(normals_[i], p) - offsets_[i];
    if (depth <= deepest) continue;
    deepest = depth;
    side = i;
  }
  if (axis) *axis = normals_[side];
  if (deepest <= 0.0) return deepest;
  double nearest = kInfinity;
  const std::size_t n = vertices_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point q = nearest_on_segment(p, vertices_[i], vertices_[(i + 1) % n]);
    const double distance = length(p - q);
    if (distance >= nearest) continue;
    nearest = distance;
    if (axis && distance > 1e-9) *axis = {(p.x - q.x) / distance, (p.y - q.y) / distance};
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

double Convex::separation(const Point* points, std::size_t count, double enough,
                          Point* axis) const {
  double best = -kInfinity;
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    double lo = kInfinity;
    for (std::size_t j = 0; j < count; ++j) lo = std::min(lo, dot(normals_[i], points[j]));
    if (lo - offsets_[i] <= best) continue;
    best = lo - offsets_[i];
    *axis = normals_[i];
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

Frame composed(const Frame& a, const Frame& b) {
  const Point p = a.to_world({b.x, b.y});
  return {p.x, p.y, a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s};
}

Point turned(const Frame& f, Point v) { return {f.c * v.x - f.s * v.y, f.s * v.x + f.c * v.y}; }

Separation separation(const Rectangle& a, const Frame& fa, const Rectangle& b, const Frame& fb) {
  const Frame p = composed(fa, a.centre), q = composed(fb, b.centre);
  const double dx = q.x - p.x, dy = q.y - p.y;
  const double c = std::abs(p.c * q.c + p.s * q.s), s = std::abs(p.c * q.s - p.s * q.c);
  const double along[4] = {p.c * dx + p.s * dy, -p.s * dx + p.c * dy, q.c * dx + q.s * dy,
                           -q.s * dx + q.c * dy};
  const double gaps[4] = {std::abs(along[0]) - a.along - c * b.along - s * b.across,
                          std::abs(along[1]) - a.across - s * b.along - c * b.across,
                          std::abs(along[2]) - b.along - c * a.along - s * a.across,
                          std::abs(along[3]) - b.across - s * a.along - c * a.across};
  const std::size_t first = gaps[0] >= gaps[1] ? 0 : 1, second = gaps[2] >= gaps[3] ? 2 : 3;
  const std::size_t best = gaps[first] >= gaps[second] ? first : second;
  const Frame& own = best < 2 ? p : q;
  const double sign = along[best] < 0.0 ? -1.0 : 1.0;
  const Point axis = best % 2 == 0 ? Point{own.c, own.s} : Point{-own.s, own.c};
  return {gaps[best], {sign * axis.x, sign * axis.y}};
}

Separation separation(const Convex& a, const Frame& fa, const Convex& b, const Frame& fb,
                      double enough) {
  const Rectangle *first_box = a.rectangle(), *second_box = b.rectangle();
  if (first_box && second_box) return separation(*first_box, fa, *second_box, fb);
  Point buffer[kMaxVertices];
  const auto place = [&buffer](const std::vector<Point>& vertices, const Frame& f) {
    for (std::size_t i = 0; i < vertices.size(); ++i) buffer[i] = f.to_world(vertices[i]);
  };
  const Frame seen = relative(fa, fb);
  Point axis;
  place(b.vertices(), seen);
  const double first = a.separation(buffer, b.vertices().size(), enough, &axis);
  Separation best{first, turned(fa, axis)};
  if (first >= enough) return best;
  place(a.vertices(), inverse(seen));
  const double second = b.separation(buffer, a.vertices().size(), enough, &axis);
  if (second <= first) return best;
  const Point back = turned(fb, axis);
  return {second, {-back.x, -back.y}};
}

Separation separation(const Convex& a, const Frame& fa, double disc, const Frame& centre) {
  Point axis;
  const double gap = a.gap(fa.to_local({centre.x, centre.y}), &axis) - disc;
  return {gap, turned(fa, axis)};
}

}  // namespace

Separation separation(const Body& a, const Convex* part_a, const Frame& fa, const Body& b,
                      const Convex* part_b, const Frame& fb, double enough) {
  if (part_a && part_b) return separation(*part_a, fa, *part_b, fb, enough);
  if (part_a) return separation(*part_a, fa, b.disc(), fb);
  if (part_b) {
    const Separation other = separation(*part_b, fb, a.disc(), fa);
    return {other.gap, {-other.axis.x, -other.axis.y}};
  }
  const Point d{fb.x - fa.x, fb.y - fa.y};
  const double distance = length(d);
  const Point axis = distance > 0.0 ? Point{d.x / distance, d.y / distance} : Point{1.0, 0.0};
  return {distance - a.disc() - b.disc(), axis};
}

double gap(const Body& a, const Frame& fa, const Body& b, const Frame& fb, double enough) {
  double least = kInfinity;
  for_each_separation(a, fa, b, fb, enough,
                      [&least](const Separation& s) { least = std::min(least, s.gap); });
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
