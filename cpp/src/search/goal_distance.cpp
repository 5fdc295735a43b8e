#include "clearway/search/goal_distance.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

GoalDistance::GoalDistance(const Statics& statics, double radius, double goal_x, double goal_y,
                           double cell)
    : box_(statics.box()),
      inverse_cell_(1.0 / cell),
      width_(static_cast<int>(std::ceil((box_.x1 - box_.x0) / cell))),
      height_(static_cast<int>(std::ceil((box_.y1 - box_.y0) / cell))) {
  const auto w = static_cast<std::size_t>(width_);
  const std::size_t num_cells = w * static_cast<std::size_t>(height_);
  distance_.assign(num_cells, kUnreachable);
  // The field is a lower bound; give back what it and the cell's extent may take away.
  const double needed = std::max(0.0, radius - 0.5 * std::numbers::sqrt2 * cell - statics.loss());
  std::vector<std::uint8_t> open(num_cells);
  for (int iy = 0; iy < height_; ++iy) {
    for (int ix = 0; ix < width_; ++ix) {
      open[static_cast<std::size_t>(iy) * w + static_cast<std::size_t>(ix)] =
          statics.clearance(box_.x0 + (ix + 0.5) * cell, box_.y0 + (iy + 0.5) * cell) >= needed;
    }
  }
  struct Move {
    int dx, dy;
    float length;
  };
  std::vector<Move> moves;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int longest = std::max(std::abs(dx), std::abs(dy));
      if (longest == 0 || (longest == 2 && std::abs(dx) + std::abs(dy) != 3)) continue;
      moves.push_back({dx, dy, static_cast<float>(cell * std::hypot(dx, dy))});
    }
  }
  // Buckets as wide as the shortest move: within one, order does not matter.
  std::vector<std::vector<std::int32_t>> buckets(1);
  const auto bucket_of = [cell](float d) { return static_cast<std::size_t>(d / cell); };
  const int gx = std::clamp(static_cast<int>((goal_x - box_.x0) / cell), 0, width_ - 1);
  const int gy = std::clamp(static_cast<int>((goal_y - box_.y0) / cell), 0, height_ - 1);
  buckets[0].push_back(gy * width_ + gx);
  distance_[static_cast<std::size_t>(buckets[0][0])] = 0.0F;
  for (std::size_t b = 0; b < buckets.size(); ++b) {
    for (std::size_t i = 0; i < buckets[b].size(); ++i) {
      const std::int32_t at = buckets[b][i];
      const float d = distance_[static_cast<std::size_t>(at)];
      if (bucket_of(d) != b) continue;  // reached more cheaply meanwhile
      const int x = at % width_, y = at / width_;
      for (const Move& m : moves) {
        const int nx = x + m.dx, ny = y + m.dy;
        if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
        const auto next = static_cast<std::size_t>(ny) * w + static_cast<std::size_t>(nx);
        if (!open[next] || d + m.length >= distance_[next]) continue;
        distance_[next] = d + m.length;
        const std::size_t target = bucket_of(d + m.length);
        if (target >= buckets.size()) buckets.resize(target + 1);
        buckets[target].push_back(static_cast<std::int32_t>(next));
      }
    }
  }
  // Poses of bodies close to obstacles may lie in cells that are not open: go on from the rim.
  for (int round = 0; round < 2; ++round) {
    std::vector<float> wider = distance_;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * w + static_cast<std::size_t>(x);
        if (distance_[at] < kUnreachable) continue;
        for (const Move& m : moves) {
          const int nx = x + m.dx, ny = y + m.dy;
          if (nx < 0 || ny < 0 || nx >= width_ || ny >= height_) continue;
          const float d =
              distance_[static_cast<std::size_t>(ny) * w + static_cast<std::size_t>(nx)];
          if (d < kUnreachable) wider[at] = std::min(wider[at], d + m.length);
        }
      }
    }
    distance_.swap(wider);
  }
}

}  // namespace clearway
