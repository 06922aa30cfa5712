// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/types.hpp"
#include "io/case_cracks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

std::string text_of(const Vec2& at) { return fmt::format("[{:.6g}, {:.6g}]", at.x(), at.y()); }

struct Segment {
  Vec2 start;
  Vec2 end;
  std::size_t crack = 0;

  double low_x() const { return std::min(start.x(), end.x()); }
  double high_x() const { return std::max(start.x(), end.x()); }
  double length() const { return (end - start).norm(); }
};

double distance(const Vec2& point, const Segment& segment) {
  const Vec2 along = segment.end - segment.start;
  const double t = std::clamp((point - segment.start).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - segment.start - t * along).norm();
}

bool meet(const Segment& a, const Segment& b, double tolerance) {
  const Vec2 da = a.end - a.start;
  const Vec2 db = b.end - b.start;
  const bool splits_b = cross(da, b.start - a.start) * cross(da, b.end - a.start) < 0.0;
  const bool splits_a = cross(db, a.start - b.start) * cross(db, a.end - b.start) < 0.0;
  if (splits_a && splits_b) return true;
  return std::min({distance(a.start, b), distance(a.end, b), distance(b.start, a),
                   distance(b.end, a)}) <= tolerance;
}

/// Length over which `b` lies on `a`, m.
double common_length(const Segment& a, const Segment& b, double tolerance) {
  const Vec2 along = (a.end - a.start) / a.length();
  // Both ends of b near the line through a: parallel, and on the same line.
  if (std::abs(cross(along, b.start - a.start)) > tolerance) return 0.0;
  if (std::abs(cross(along, b.end - a.start)) > tolerance) return 0.0;
  const double from = along.dot(b.start - a.start);
  const double to = along.dot(b.end - a.start);
  return std::min(a.length(), std::max(from, to)) - std::max(0.0, std::min(from, to));
}

class GeometryCheck {
 public:
  GeometryCheck(const std::vector<CrackSpec>& cracks, const DomainSpec& domain,
                const std::vector<ConfigNode>& blocks, Problems& problems)
      : cracks_(cracks), domain_(domain), blocks_(blocks), problems_(problems) {
    has_body_ = domain.size.minCoeff() > 0.0;
    double extent = domain.size.maxCoeff();
    for (const auto& crack : cracks) {
      for (const auto& point : crack.points) {
        if (!has_body_) extent = std::max(extent, point.cwiseAbs().maxCoeff());
      }
    }
    tolerance_ = 1e-9 * extent;
  }

  void run() {
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < cracks_.size(); ++i) {
      if (cracks_[i].points.empty()) continue;
      check_outside(i);
      if (has_segment_of_no_length(i)) continue;
      const auto own = segments_of(i);
      check_itself(i, own);
      check_sides(i, own);
      segments.insert(segments.end(), own.begin(), own.end());
    }
    check_pairs(std::move(segments));
  }

 private:
  void add(std::size_t crack, std::size_t point, const std::string& message) {
    const auto* points = blocks_[crack].find("points");
    if (points) {
      problems_.push_back(problem_at(points->items[point],
                                     fmt::format("crack[{}].points[{}]", crack, point), message));
    } else {
      problems_.push_back(problem_at(*blocks_[crack].find("center"),
                                     fmt::format("crack[{}].center", crack), message));
    }
  }

  std::vector<Segment> segments_of(std::size_t i) const {
    std::vector<Segment> out;
    const auto& points = cracks_[i].points;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      out.push_back({points[k], points[k + 1], i});
    return out;
  }

  void check_outside(std::size_t i) {
    if (!has_body_) return;
    const Vec2 low = domain_.origin;
    const Vec2 high = domain_.origin + domain_.size;
    for (std::size_t k = 0; k < cracks_[i].points.size(); ++k) {
      const Vec2& at = cracks_[i].points[k];
      const double outside = std::max((low - at).maxCoeff(), (at - high).maxCoeff());
      if (outside <= tolerance_) continue;
      add(i, k,
          fmt::format(
              "The crack \"{}\" reaches {}, which is {:.3g} m outside of the body; allowed are "
              "points from {} to {}.",
              cracks_[i].name, text_of(at), outside, text_of(low), text_of(high)));
    }
  }

  bool has_segment_of_no_length(std::size_t i) {
    const auto& points = cracks_[i].points;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      if ((points[k + 1] - points[k]).norm() > tolerance_) continue;
      add(i, k + 1,
          fmt::format(
              "The crack \"{}\" has a segment of zero length at {}; allowed are points that "
              "differ from the point before.",
              cracks_[i].name, text_of(points[k])));
      return true;
    }
    return false;
  }

  void check_itself(std::size_t i, const std::vector<Segment>& own) {
    for (std::size_t k = 0; k + 1 < own.size(); ++k) {
      const Vec2 back = (own[k].start - own[k].end) / own[k].length();
      const Vec2 on = (own[k + 1].end - own[k + 1].start) / own[k + 1].length();
      if (on.dot(back) < 0.0 || std::abs(cross(back, on)) > 1e-6) continue;
      add(i, k + 1,
          fmt::format(
              "The crack \"{}\" folds back onto itself at {}; allowed are kinks of less than "
              "180 degrees.",
              cracks_[i].name, text_of(own[k].end)));
      return;
    }
    for (std::size_t k = 0; k < own.size(); ++k) {
      for (std::size_t j = k + 2; j < own.size(); ++j) {
        if (!meet(own[k], own[j], tolerance_)) continue;
        add(i, j,
            fmt::format(
                "The crack \"{}\" crosses or touches itself: its segment from {} meets the one "
                "from {}; allowed is a polyline that does not meet itself.",
                cracks_[i].name, text_of(own[j].start), text_of(own[k].start)));
        return;
      }
    }
  }

  void check_sides(std::size_t i, const std::vector<Segment>& own) {
    if (!has_body_) return;
    const Vec2 high = domain_.origin + domain_.size;
    for (std::size_t k = 0; k < own.size(); ++k) {
      for (const int axis : {0, 1}) {
        for (const double side : {domain_.origin[axis], high[axis]}) {
          const bool on_side = std::abs(own[k].start[axis] - side) <= tolerance_ &&
                               std::abs(own[k].end[axis] - side) <= tolerance_;
          if (!on_side) continue;
          add(i, k,
              fmt::format(
                  "The crack \"{}\" runs along a side of the body from {} to {}, where it cuts "
                  "nothing; allowed are segments inside of the body.",
                  cracks_[i].name, text_of(own[k].start), text_of(own[k].end)));
        }
      }
    }
  }

  /// Segments sorted by their left ends: only those that overlap in x are compared.
  void check_pairs(std::vector<Segment> segments) {
    std::stable_sort(segments.begin(), segments.end(),
                     [](const Segment& a, const Segment& b) { return a.low_x() < b.low_x(); });
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (std::size_t j = i + 1; j < segments.size(); ++j) {
        if (segments[j].low_x() > segments[i].high_x() + tolerance_) break;
        check_pair(segments[i], segments[j]);
      }
    }
    for (const auto& [first, second] : on_each_other_) report_pair(first, second);
  }

  void check_pair(const Segment& a, const Segment& b) {
    if (a.crack == b.crack) return;
    const bool a_is_longer = a.length() >= b.length();
    const double common =
        a_is_longer ? common_length(a, b, tolerance_) : common_length(b, a, tolerance_);
    if (common > 10.0 * tolerance_) on_each_other_.insert(std::minmax(a.crack, b.crack));
  }

  bool are_same(const CrackSpec& a, const CrackSpec& b) const {
    const auto near = [&](const Vec2& p, const Vec2& q) { return (p - q).norm() <= tolerance_; };
    return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), near) ||
           std::equal(a.points.begin(), a.points.end(), b.points.rbegin(), b.points.rend(), near);
  }

  void report_pair(std::size_t first, std::size_t second) {
    const auto& a = cracks_[first];
    const auto& b = cracks_[second];
    const auto other = fmt::format("crack[{}] \"{}\"", first, a.name);
    add(second, 0,
        are_same(a, b) ? fmt::format("The crack \"{}\" is given twice: it is the same line as {}; "
                                     "allowed is each crack once.",
                                     b.name, other)
                       : fmt::format("The crack \"{}\" runs along a part of {}; allowed are cracks "
                                     "that cross or touch, "
                                     "but do not lie on each other.",
                                     b.name, other));
  }

  const std::vector<CrackSpec>& cracks_;
  const DomainSpec& domain_;
  const std::vector<ConfigNode>& blocks_;
  Problems& problems_;
  bool has_body_ = false;
  double tolerance_ = 0.0;
  std::set<std::pair<std::size_t, std::size_t>> on_each_other_;
};

}  // namespace

void check_crack_geometry(const std::vector<CrackSpec>& cracks, const DomainSpec& domain,
                          const std::vector<ConfigNode>& blocks, std::vector<Problem>& problems) {
  GeometryCheck(cracks, domain, blocks, problems).run();
}

}  // namespace cdca
