#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/render/road_field.h>

#include <algorithm>
#include <cmath>

namespace placegraph::synthetic {

RoadField::RoadField(const std::vector<Roadway>& roadways) {
  low_ = Eigen::Vector2d::Constant(1e30);
  high_ = -low_;
  for (const Roadway& roadway : roadways) {
    for (const Eigen::Vector2d& p : roadway.centre) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
  }
  const Eigen::Vector2d extent = high_ - low_;
  require(extent.allFinite() && extent.maxCoeff() < 20000 && extent.minCoeff() >= 0,
          "synthetic world: the path's extent must be below 20 km");
  low_ = (low_.array() - (kReach_m + 2)).floor();
  high_ = (high_.array() + (kReach_m + 2)).ceil();
  nx_ = static_cast<int>(high_[0] - low_[0]) + 1;
  nz_ = static_cast<int>(high_[1] - low_[1]) + 1;
  nodes_.resize(static_cast<std::size_t>(nx_) * nz_);
  for (std::size_t i = 0; i < roadways.size(); ++i) {
    half_widths_.push_back(static_cast<float>(roadways[i].half_width_m));
    add(roadways[i], static_cast<int>(i));
  }
}

void RoadField::add(const Roadway& roadway, int index) {
  const double reach = kReach_m + roadway.half_width_m;
  double along = 0;
  for (std::size_t i = 0; i + 1 < roadway.centre.size(); ++i) {
    const Eigen::Vector2d &a = roadway.centre[i], &b = roadway.centre[i + 1];
    const double length = (b - a).norm();
    if (length <= 0) continue;
    const Eigen::Vector2d direction = (b - a) / length;
    const Eigen::Vector2d low = a.cwiseMin(b).array() - reach - low_.array(),
                          high = a.cwiseMax(b).array() + reach - low_.array();
    const int x0 = std::max(0, floor_int(low[0])), x1 = std::min(nx_ - 1, floor_int(high[0]) + 1);
    const int z0 = std::max(0, floor_int(low[1])), z1 = std::min(nz_ - 1, floor_int(high[1]) + 1);
    for (int z = z0; z <= z1; ++z) {
      for (int x = x0; x <= x1; ++x) {
        const Eigen::Vector2d p = low_ + Eigen::Vector2d(x, z) - a;
        const double s = std::clamp(p.dot(direction), 0.0, length);
        const double distance = (p - s * direction).norm();
        Node& node = nodes_[static_cast<std::size_t>(z) * nx_ + x];
        node.edge = std::min(node.edge, static_cast<float>(distance - roadway.half_width_m));
        // Right of (dx, dz), with x right and z forward, is (dz, -dx).
        const double side = p[0] * direction[1] - p[1] * direction[0];
        if (roadway.marked && distance < std::abs(node.lateral)) {
          node.lateral = static_cast<float>(side < 0 ? -distance : distance);
          node.along = static_cast<float>(along + s);
          node.road = index;
        }
      }
    }
    along += length;
  }
}

RoadField::Sample RoadField::sample(double x, double z) const {
  Sample out;
  const double gx = x - low_[0], gz = z - low_[1];
  if (!(gx >= 0 && gz >= 0 && gx < nx_ - 1 && gz < nz_ - 1)) {
    out.edge = static_cast<float>(kReach_m);
    return out;
  }
  const int ix = static_cast<int>(gx), iz = static_cast<int>(gz);
  const float fx = static_cast<float>(gx - ix), fz = static_cast<float>(gz - iz);
  const Node* n = &nodes_[static_cast<std::size_t>(iz) * nx_ + ix];
  const Node &a = n[0], &b = n[1], &c = n[nx_], &d = n[nx_ + 1];
  const auto blend = [&](float Node::*m) {
    return mix(mix(a.*m, b.*m, fx), mix(c.*m, d.*m, fx), fz);
  };
  out.edge = blend(&Node::edge);
  const auto [low, high] = std::minmax({a.along, b.along, c.along, d.along});
  const auto [left, right] = std::minmax({a.lateral, b.lateral, c.lateral, d.lateral});
  out.marked = a.road >= 0 && a.road == b.road && a.road == c.road && a.road == d.road &&
               high - low < 2.5F && right - left < 2.0F;
  if (out.marked) {
    out.along = blend(&Node::along);
    out.lateral = blend(&Node::lateral);
    out.road = static_cast<std::uint32_t>(a.road);
    out.half_width = half_widths_[a.road];
  }
  return out;
}

}  // namespace placegraph::synthetic
