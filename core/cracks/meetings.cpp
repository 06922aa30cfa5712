// SPDX-License-Identifier: BSD-3-Clause
#include "core/cracks/meetings.hpp"

#include "core/cracks/obstacles.hpp"
#include "core/cracks/segments.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace cdca {

namespace {

/// What an increment meets. Of meetings at the same distance the first kind comes first.
enum class MeetingKind { with_what_is_there, with_an_ended_one, with_each_other };

struct Meeting {
  double later = 0.0;  ///< the way to it, m; the longer one when two come to it
  MeetingKind kind = MeetingKind::with_what_is_there;
  std::size_t first = 0;   ///< number of the increment
  std::size_t second = 0;  ///< of the other one, if any
  Vec2 at{0, 0};
};

/// Takes the meetings of a cycle in the order in which they come.
class MeetingQueue {
 public:
  MeetingQueue(const CrackRegistry& registry, const Rectangle& body, double touch,
               std::vector<Increment> increments)
      : registry_(registry),
        obstacles_(registry, body, touch),
        touch_(touch),
        incs_(std::move(increments)),
        targets_(incs_.size()),
        ended_(incs_.size(), 0),
        queue_(Earlier{1e-6 * touch}) {
    for (const Increment& inc : incs_) growing_.insert({inc.crack, inc.end});
    for (std::size_t k = 0; k < incs_.size(); ++k) {
      targets_[k] = obstacles_.target_of(incs_[k].crack, incs_[k].end, incs_[k].to);
      if (targets_[k]) expect(targets_[k]->distance, MeetingKind::with_what_is_there, k, k);
    }
    for (std::size_t a = 0; a < incs_.size(); ++a) {
      for (std::size_t b = a + 1; b < incs_.size(); ++b) expect_each_other(a, b);
    }
  }

  std::vector<Increment> run() {
    while (!queue_.empty()) {
      const Meeting next = *queue_.begin();
      queue_.erase(queue_.begin());
      if (ended_[next.first]) continue;
      if (next.kind == MeetingKind::with_what_is_there) end_on_target(next.first);
      if (next.kind == MeetingKind::with_an_ended_one) end_on(next.first, next.second, next.at);
      if (next.kind == MeetingKind::with_each_other && !ended_[next.second]) connect(next);
    }
    return std::move(incs_);
  }

 private:
  /// Ways that differ by rounding are equally long.
  struct Earlier {
    double unit;
    bool operator()(const Meeting& a, const Meeting& b) const {
      return std::tuple(std::round(a.later / unit), a.kind, a.first, a.second) <
             std::tuple(std::round(b.later / unit), b.kind, b.first, b.second);
    }
  };

  bool near(const Vec2& x, const Vec2& y) const { return (x - y).norm() <= touch_; }

  void expect(double later, MeetingKind kind, std::size_t first, std::size_t second,
              const Vec2& at = Vec2(0, 0)) {
    queue_.insert({later, kind, first, second, at});
  }

  /// A meeting of two increments, if nothing comes before it.
  void expect_each_other(std::size_t a, std::size_t b) {
    const Increment &one = incs_[a], &two = incs_[b];
    const auto hit = hit_of(one.from, one.to, two.from, two.to, touch_);
    const auto crossing = crossing_of(one.from, one.to, two.from, two.to);
    const bool clean = crossing && hit->distance == crossing->on_first * one.length();
    std::optional<Vec2> at;
    if (!clean) at = place_between(one, two);
    if (!at && hit) at = hit->at;
    // at the start of one of them they meet what was there before
    if (!at || near(*at, one.from) || near(*at, two.from)) return;
    const double later = std::max((*at - one.from).norm(), (*at - two.from).norm());
    expect(later, MeetingKind::with_each_other, a, b, *at);
  }

  /// Where two tips meet that head for each other and do not simply cross: each divides the way
  /// between them by its own step. They meet when one lies within the other's step; or when they
  /// come, both going straight on, within the rest of their steps as long as they are ahead of each
  /// other. They see each other under 60 degrees when gap (cos t + sqrt(3) sin t) is what both have
  /// gone.
  std::optional<Vec2> place_between(const Increment& one, const Increment& two) const {
    const Vec2 across = two.from - one.from;
    const double gap = across.norm(), steps = one.length() + two.length();
    if (gap <= touch_ || gap > steps) return std::nullopt;
    if (!lies_ahead(one.from, one.to - one.from, two.from)) return std::nullopt;
    if (!lies_ahead(two.from, two.to - two.from, one.from)) return std::nullopt;
    const double cosine = std::min(across.dot(one.direction()), -across.dot(two.direction())) / gap;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const bool close = gap <= std::max(one.length(), two.length());
    if (!close && gap * (cosine + std::numbers::sqrt3 * sine) > steps) return std::nullopt;
    const Vec2 at = one.from + one.length() / steps * across;
    if (obstacles_.on_the_way(one.crack, one.end, at)) return std::nullopt;
    if (obstacles_.on_the_way(two.crack, two.end, at)) return std::nullopt;
    return at;
  }

  void end_on_target(std::size_t k) {
    Increment& inc = incs_[k];
    const Target& target = *targets_[k];
    // the way to a target that lies aside is a new one
    std::size_t other = k;
    WayHit first{target.distance - touch_, target.at};
    for (std::size_t j = 0; j < incs_.size(); ++j) {
      if (!ended_[j]) continue;
      const auto hit = hit_of(inc.from, target.at, incs_[j].from, incs_[j].to, touch_);
      if (!hit || near(hit->at, inc.from) || hit->distance >= first.distance) continue;
      first = *hit;
      other = j;
    }
    if (other != k) return end_on(k, other, first.at);
    inc.to = target.at;
    inc.state = target.state;
    inc.partner = target.partner;
    find_partner_end(inc);
    leave(k);
  }

  /// A tip that is met is a tip no more, unless it moves on in this cycle: then its old place is
  /// one on the face.
  void find_partner_end(Increment& inc) const {
    if (inc.partner < 0) return;
    const Crack& crack = registry_.cracks()[std::size_t(inc.partner)];
    for (int end = 0; end < 2; ++end) {
      if (crack.end_point(end) != inc.to) continue;
      if (crack.ends[std::size_t(end)].state != TipState::active) continue;
      if (growing_.count({inc.partner, end})) continue;
      inc.state = TipState::connected;
      inc.partner_end = end;
    }
  }

  void end_on(std::size_t k, std::size_t ended, const Vec2& at) {
    incs_[k].to = at;
    incs_[k].state = TipState::coalesced;
    incs_[k].partner = incs_[ended].crack;
    leave(k);
  }

  void connect(const Meeting& m) {
    Increment &one = incs_[m.first], &two = incs_[m.second];
    one.to = two.to = m.at;
    one.state = two.state = TipState::connected;
    one.partner = two.crack;
    one.partner_end = two.end;
    two.partner = one.crack;
    two.partner_end = one.end;
    leave(m.first);
    leave(m.second);
  }

  /// An increment has ended: the others may come across it.
  void leave(std::size_t ended) {
    ended_[ended] = 1;
    const Increment& there = incs_[ended];
    for (std::size_t k = 0; k < incs_.size(); ++k) {
      if (ended_[k]) continue;
      const auto hit = hit_of(incs_[k].from, incs_[k].to, there.from, there.to, touch_);
      if (hit && !near(hit->at, incs_[k].from))
        expect(hit->distance, MeetingKind::with_an_ended_one, k, ended, hit->at);
    }
  }

  const CrackRegistry& registry_;
  Obstacles obstacles_;
  double touch_;
  std::vector<Increment> incs_;  ///< as they would be alone, once ended as they are
  std::vector<std::optional<Target>> targets_;
  std::vector<char> ended_;
  std::set<std::pair<int, int>> growing_;  ///< crack and end
  std::set<Meeting, Earlier> queue_;
};

}  // namespace

std::vector<Increment> resolve_meetings(const CrackRegistry& registry, const Rectangle& body,
                                        double touch, std::vector<Increment> increments) {
  std::sort(increments.begin(), increments.end(), [](const Increment& a, const Increment& b) {
    return std::pair(a.crack, a.end) < std::pair(b.crack, b.end);
  });
  return MeetingQueue(registry, body, touch, std::move(increments)).run();
}

void apply_increments(const std::vector<Increment>& increments, double touch,
                      const GrowthTime& when, CrackRegistry& registry) {
  for (const Increment& i : increments) {
    if (i.length() <= touch) registry.place_end(i.crack, i.end, i.to);
    registry.advance(i.crack, i.end, i.to, i.state, i.partner, when);
  }
  for (const Increment& i : increments) {
    if (i.partner_end >= 0) registry.join_end(i.partner, i.partner_end, i.crack, when);
  }
}

}  // namespace cdca
