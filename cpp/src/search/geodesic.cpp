#include "clearway/search/geodesic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace clearway {

namespace {

constexpr double kCell = 2.0;
constexpr double kAllowed = 0.002;  // legal overlap: swell by that much less (m)
constexpr double kTouch = 1e-6;     // passing a polygon this closely is not entering it (m)
constexpr int kArc = 4;             // chords of a half circle
constexpr std::size_t kMostCorners = 20000;

bool enters(const std::vector<Point>& polygon, Point a, Point b) {
  double in = 0.0, out = 1.0;
  const Point d = b - a;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point p = polygon[i], edge = polygon[(i + 1) % n] - p;
    const double scale = kTouch * length(edge);
    // Inside means left of every edge, by more than a touch.
    const double at_a = cross(edge, a - p) - scale, slope = cross(edge, d);
    if (std::abs(slope) < 1e-15) {
      if (at_a <= 0.0) return false;
      continue;
    }
    const double t = -at_a / slope;
    if (slope > 0.0) {
      in = std::max(in, t);
    } else {
      out = std::min(out, t);
    }
    if (in >= out) return false;
  }
  return true;
}

}  // namespace

Geodesic::Geodesic(const Obstacles& obstacles, double radius) : box_(obstacles.box) {
  const double r = std::max(0.0, radius - kAllowed);
  width_ = static_cast<int>((box_.x1 - box_.x0) / kCell) + 1;
  height_ = static_cast<int>((box_.y1 - box_.y0) / kCell) + 1;
  cells_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (const Segment& s : obstacles.segments) {
    std::vector<Point> polygon;
    const double heading = std::atan2(s.q.y - s.p.y, s.q.x - s.p.x);
    for (const bool far : {true, false}) {
      const Point end = far ? s.q : s.p;
      const double from = heading + (far ? -0.5 : 0.5) * std::numbers::pi;
      for (int i = 0; i <= kArc; ++i) {
        const double angle = from + i * std::numbers::pi / kArc;
        polygon.push_back({end.x + r * std::cos(angle), end.y + r * std::sin(angle)});
      }
    }
    add(std::move(polygon));
  }
  for (const Circle& c : obstacles.discs) {
    std::vector<Point> polygon;
    for (int i = 0; i < 4 * kArc; ++i) {
      const double angle = i * kTau / (4 * kArc);
      polygon.push_back({c.x + (c.r + r) * std::cos(angle), c.y + (c.r + r) * std::sin(angle)});
    }
    add(std::move(polygon));
  }
  seen_.resize(corners_.size());
  known_.assign(corners_.size(), false);
}

void Geodesic::add(std::vector<Point> polygon) {
  const auto index = static_cast<std::int32_t>(polygons_.size());
  const std::size_t n = polygon.size();
  Point lo = polygon[0], hi = polygon[0];
  for (std::size_t i = 0; i < n; ++i) {
    corners_.push_back({polygon[i], polygon[(i + n - 1) % n], polygon[(i + 1) % n]});
    lo = {std::min(lo.x, polygon[i].x), std::min(lo.y, polygon[i].y)};
    hi = {std::max(hi.x, polygon[i].x), std::max(hi.y, polygon[i].y)};
  }
  const auto cell = [](double v, int top) {
    return std::clamp(static_cast<int>(std::floor(v / kCell)), 0, top - 1);
  };
  for (int y = cell(lo.y - box_.y0, height_); y <= cell(hi.y - box_.y0, height_); ++y) {
    for (int x = cell(lo.x - box_.x0, width_); x <= cell(hi.x - box_.x0, width_); ++x) {
      cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
             static_cast<std::size_t>(x)]
          .push_back(index);
    }
  }
  polygons_.push_back(std::move(polygon));
}

// Walks the grid row by row along the segment.
bool Geodesic::visible(Point a, Point b) const {
  const auto row = [this](double y) {
    return std::clamp(static_cast<int>(std::floor((y - box_.y0) / kCell)), 0, height_ - 1);
  };
  const auto column = [this](double x) {
    return std::clamp(static_cast<int>(std::floor((x - box_.x0) / kCell)), 0, width_ - 1);
  };
  if (a.y > b.y) std::swap(a, b);
  const double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0.0;
  for (int y = row(a.y); y <= row(b.y); ++y) {
    double x0 = a.x, x1 = b.x;
    if (row(a.y) != row(b.y)) {
      const double low = std::max(a.y, box_.y0 + y * kCell);
      const double high = std::min(b.y, box_.y0 + (y + 1) * kCell);
      x0 = y == row(a.y) ? a.x : a.x + (low - a.y) * slope;
      x1 = y == row(b.y) ? b.x : a.x + (high - a.y) * slope;
    }
    for (int x = column(std::min(x0, x1)); x <= column(std::max(x0, x1)); ++x) {
      for (const std::int32_t i :
           cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x)]) {
        if (enters(polygons_[static_cast<std::size_t>(i)], a, b)) return false;
      }
    }
  }
  return true;
}

// Corners seen from a point at which a shortest way may bend; `own` if the point is one itself.
std::vector<std::int32_t> Geodesic::tangents_from(Point p, const Corner* own) const {
  const auto supports = [](const Corner& c, Point d) {
    const double before = cross(d, c.before - c.at), after = cross(d, c.after - c.at);
    return before * after >= -1e-12;
  };
  std::vector<std::int32_t> out;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Corner& c = corners_[i];
    const Point d = c.at - p;
    if (&c == own || dot(d, d) < 1e-18) continue;
    if (!supports(c, d) || (own && !supports(*own, d))) continue;
    if (visible(p, c.at)) out.push_back(static_cast<std::int32_t>(i));
  }
  return out;
}

const std::vector<std::int32_t>& Geodesic::seen_from(std::int32_t corner) {
  const auto i = static_cast<std::size_t>(corner);
  if (!known_[i]) {
    seen_[i] = tangents_from(corners_[i].at, &corners_[i]);
    known_[i] = true;
  }
  return seen_[i];
}

double Geodesic::operator()(Point from, Point to) {
  const double straight = length(to - from);
  if (corners_.size() > kMostCorners || visible(from, to)) return straight;
  std::vector<double> cost(corners_.size(), std::numeric_limits<double>::infinity());
  using Item = std::pair<double, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
  double best = std::numeric_limits<double>::infinity();
  const auto reach = [&](std::int32_t corner, double g) {
    const auto i = static_cast<std::size_t>(corner);
    const double f = g + length(to - corners_[i].at);
    if (g >= cost[i] || f >= best) return;
    cost[i] = g;
    open.push({f, corner});
  };
  for (const std::int32_t c : tangents_from(from, nullptr)) {
    reach(c, length(corners_[static_cast<std::size_t>(c)].at - from));
  }
  while (!open.empty() && open.top().first < best) {
    const auto [f, corner] = open.top();
    open.pop();
    const Point at = corners_[static_cast<std::size_t>(corner)].at;
    const double g = cost[static_cast<std::size_t>(corner)];
    if (f > g + length(to - at) + 1e-9) continue;
    if (visible(at, to)) best = std::min(best, f);
    for (const std::int32_t next : seen_from(corner)) {
      reach(next, g + length(corners_[static_cast<std::size_t>(next)].at - at));
    }
  }
  return std::max(best, straight);
}

}  // namespace clearway
