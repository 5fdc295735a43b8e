#include "clearway/space/statics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clearway {

namespace {

constexpr double kFinestCell = 0.1;
constexpr double kMaxCells = 4e6;
constexpr double kBucket = 2.0;
constexpr double kBeyond = 0.5;  // how far past the body a bucket look-up sees

double distance(Point p, const Segment& s) {
  const Point d = s.q - s.p;
  const double length2 = dot(d, d);
  const double t = length2 > 0.0 ? std::clamp(dot(p - s.p, d) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - s.p.x - t * d.x, p.y - s.p.y - t * d.y);
}

}  // namespace

Statics::Statics(Obstacles obstacles, double reach)
    : box_(obstacles.box), reach_(reach), saturation_(std::max(4.0, reach + 2.0)) {
  if (!(box_.x1 > box_.x0 && box_.y1 > box_.y0)) throw std::invalid_argument("site box is empty");
  segments_ = std::move(obstacles.segments);
  discs_ = std::move(obstacles.discs);
  const double area = (box_.x1 - box_.x0) * (box_.y1 - box_.y0);
  cell_ = std::max(kFinestCell, std::sqrt(area / kMaxCells));
  inverse_cell_ = 1.0 / cell_;
  width_ = static_cast<int>(std::ceil((box_.x1 - box_.x0) / cell_));
  height_ = static_cast<int>(std::ceil((box_.y1 - box_.y0) / cell_));
  unit_ = saturation_ / 255.0;
  fill_field(obstacles);
  fill_buckets();
}

void Statics::fill_field(const Obstacles& obstacles) {
  field_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 255);
  const double half_diagonal = cell_ * std::numbers::sqrt2 / 2.0;
  const auto lower = [&](Box span, const auto& distance_to) {
    const int ix0 = std::max(0, static_cast<int>((span.x0 - saturation_ - box_.x0) / cell_));
    const int iy0 = std::max(0, static_cast<int>((span.y0 - saturation_ - box_.y0) / cell_));
    const int ix1 =
        std::min(width_ - 1, static_cast<int>((span.x1 + saturation_ - box_.x0) / cell_));
    const int iy1 =
        std::min(height_ - 1, static_cast<int>((span.y1 + saturation_ - box_.y0) / cell_));
    for (int iy = iy0; iy <= iy1; ++iy) {
      std::uint8_t* row = &field_[static_cast<std::size_t>(iy) * static_cast<std::size_t>(width_)];
      for (int ix = ix0; ix <= ix1; ++ix) {
        const Point p{box_.x0 + (ix + 0.5) * cell_, box_.y0 + (iy + 0.5) * cell_};
        const double d = (distance_to(p) - half_diagonal) / unit_;
        if (d < row[ix]) row[ix] = static_cast<std::uint8_t>(std::max(0.0, d));
      }
    }
  };
  for (const Segment& s : segments_) {
    lower({std::min(s.p.x, s.q.x), std::min(s.p.y, s.q.y), std::max(s.p.x, s.q.x),
           std::max(s.p.y, s.q.y)},
          [&s](Point p) { return distance(p, s); });
  }
  for (const Circle& c : discs_) {
    lower({c.x - c.r, c.y - c.r, c.x + c.r, c.y + c.r},
          [&c](Point p) { return std::hypot(p.x - c.x, p.y - c.y) - c.r; });
  }
  for (const auto& solid : obstacles.solids) block_inside(solid, true);
  if (!obstacles.bounds.empty()) block_inside(obstacles.bounds, false);
}

// Zero every cell whose centre lies inside (or outside) the polygon, row by row.
void Statics::block_inside(const std::vector<Point>& polygon, bool inside) {
  std::vector<double> crossings;
  const std::size_t n = polygon.size();
  for (int iy = 0; iy < height_; ++iy) {
    const double y = box_.y0 + (iy + 0.5) * cell_;
    crossings.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const Point a = polygon[i], b = polygon[(i + 1) % n];
      if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    if (crossings.empty() && inside) continue;
    std::sort(crossings.begin(), crossings.end());
    std::uint8_t* row = &field_[static_cast<std::size_t>(iy) * static_cast<std::size_t>(width_)];
    std::size_t k = 0;
    for (int ix = 0; ix < width_; ++ix) {
      const double x = box_.x0 + (ix + 0.5) * cell_;
      while (k < crossings.size() && crossings[k] < x) ++k;
      if ((k % 2 == 1) == inside) row[ix] = 0;
    }
  }
}

void Statics::fill_buckets() {
  bucket_width_ = static_cast<int>((box_.x1 - box_.x0) / kBucket) + 1;
  bucket_height_ = static_cast<int>((box_.y1 - box_.y0) / kBucket) + 1;
  const double near = reach_ + kBeyond + kBucket * std::numbers::sqrt2 / 2.0;
  std::vector<std::vector<std::int32_t>> lists(static_cast<std::size_t>(bucket_width_) *
                                               static_cast<std::size_t>(bucket_height_));
  const auto put = [&](Box span, std::int32_t item, const auto& distance_to) {
    const auto index = [](double v, int top) {
      return std::clamp(static_cast<int>(std::floor(v / kBucket)), 0, top - 1);
    };
    for (int iy = index(span.y0 - near - box_.y0, bucket_height_);
         iy <= index(span.y1 + near - box_.y0, bucket_height_); ++iy) {
      for (int ix = index(span.x0 - near - box_.x0, bucket_width_);
           ix <= index(span.x1 + near - box_.x0, bucket_width_); ++ix) {
        const Point centre{box_.x0 + (ix + 0.5) * kBucket, box_.y0 + (iy + 0.5) * kBucket};
        if (distance_to(centre) <= near) {
          lists[static_cast<std::size_t>(iy) * static_cast<std::size_t>(bucket_width_) +
                static_cast<std::size_t>(ix)]
              .push_back(item);
        }
      }
    }
  };
  std::int32_t item = 0;
  for (const Segment& s : segments_) {
    put({std::min(s.p.x, s.q.x), std::min(s.p.y, s.q.y), std::max(s.p.x, s.q.x),
         std::max(s.p.y, s.q.y)},
        item++, [&s](Point p) { return distance(p, s); });
  }
  for (const Circle& c : discs_) {
    put({c.x - c.r, c.y - c.r, c.x + c.r, c.y + c.r}, item++,
        [&c](Point p) { return std::hypot(p.x - c.x, p.y - c.y) - c.r; });
  }
  bucket_start_.assign(1, 0);
  for (const auto& list : lists) {
    bucket_items_.insert(bucket_items_.end(), list.begin(), list.end());
    bucket_start_.push_back(static_cast<std::int32_t>(bucket_items_.size()));
  }
}

double Statics::cover_gap(const Body& body, const Frame& f) const {
  double least = saturation_;
  for (const Circle& c : body.cover()) {
    const Point p = f.to_world({c.x, c.y});
    least = std::min(least, clearance(p.x, p.y) - c.r);
  }
  return least;
}

double Statics::gap(const Body& body, const Frame& f) const {
  double least = reach_ + kBeyond - body.circumradius();
  const int ix = std::clamp(static_cast<int>((f.x - box_.x0) / kBucket), 0, bucket_width_ - 1);
  const int iy = std::clamp(static_cast<int>((f.y - box_.y0) / kBucket), 0, bucket_height_ - 1);
  const std::size_t bucket =
      static_cast<std::size_t>(iy) * static_cast<std::size_t>(bucket_width_) +
      static_cast<std::size_t>(ix);
  const auto num_segments = static_cast<std::int32_t>(segments_.size());
  for (std::int32_t k = bucket_start_[bucket]; k < bucket_start_[bucket + 1]; ++k) {
    const std::int32_t item = bucket_items_[static_cast<std::size_t>(k)];
    const double g =
        item < num_segments
            ? clearway::gap(body, f, segments_[static_cast<std::size_t>(item)])
            : clearway::gap(body, f, discs_[static_cast<std::size_t>(item - num_segments)]);
    least = std::min(least, g);
  }
  return least;
}

bool Statics::clear(const Body& body, const Frame& start, const Twist& motion, double required,
                    double slack) const {
  const double travel = motion.length() + std::abs(motion.c) * body.circumradius();
  // The far end is the likeliest to be blocked.
  const Frame last = moved(start, motion);
  if (cover_gap(body, last) - required < 0.0 && gap(body, last) - required < -1e-7) return false;
  double progress = 0.0;
  while (true) {
    const Frame f = moved(start, motion.part(progress));
    double room = cover_gap(body, f) - required;
    if (room < 0.2) {
      const double exact = gap(body, f) - required;
      if (exact < -1e-7) return false;
      room = std::max(room, exact + slack);
    }
    if (progress >= 1.0) return true;
    progress = travel > 0.0 ? std::min(1.0, progress + room / travel) : 1.0;
  }
}

}  // namespace clearway
