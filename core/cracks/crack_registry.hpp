// SPDX-License-Identifier: BSD-3-Clause
/// All cracks of the body, the same on every rank.
#pragma once

#include "core/cracks/crack.hpp"

#include <cstdint>
#include <vector>

namespace cdca {

enum class EventKind : std::int32_t {
  boundary,
  connection,
  coalescence,
  crossing,
  fragment,
  unstable,
  separated
};

const char* name_of(EventKind kind);
/// Of an end that has met something.
EventKind event_of(TipState state);

/// Something that happened to a crack.
struct Event {
  int step = 0;
  int cycle = 0;
  EventKind kind = EventKind::boundary;
  int crack = -1;
  int end = -1;
  int partner = -1;
  Vec2 at{0, 0};  ///< m
};

/// The rectangle that bounds the body, m.
struct Rectangle {
  Vec2 lower{0, 0};
  Vec2 upper{0, 0};
};

/// The replicated crack registry. Every rank applies the same changes from the same numbers, so
/// the copies stay bitwise equal; hash() shows whether they did.
class CrackRegistry {
 public:
  CrackRegistry() = default;
  /// Cracks of a run that goes on, and what has happened to them.
  CrackRegistry(std::vector<Crack> cracks, std::vector<Event> events)
      : cracks_(std::move(cracks)), events_(std::move(events)) {}

  /// Adds an initial crack with two active ends. points: m, at least two.
  void add(std::string name, std::vector<Vec2> points);
  /// Finds where initial cracks end on the rim, on the ends or on the faces of cracks, their own
  /// included, and where they cross (4.1-4.2 at load step 0). Ends nearer than `touch` (m) are
  /// moved onto what they touch; onto the rim those nearer than `rim`, if that is more (m).
  void resolve_initial_meetings(const Rectangle& body, double touch, double rim = 0.0);

  /// Lengthens a crack at one end by a straight segment to `to` (m), which appears now; the end
  /// takes the given state. Ends that meet something write an event. A step to
  /// where the end is already adds no segment.
  void advance(int crack, int end, const Vec2& to, TipState state, int partner,
               const GrowthTime& now);
  /// Moves an end to `at` (m), and all ends that lie in just the same place with it.
  void place_end(int crack, int end, const Vec2& at);
  /// An end that another crack's tip has run into is a tip no more.
  void join_end(int crack, int end, int partner, const GrowthTime& now);
  void record(const Event& event) { events_.push_back(event); }

  const std::vector<Crack>& cracks() const { return cracks_; }
  const std::vector<Event>& events() const { return events_; }
  int active_tips() const;
  /// Total length of all cracks, m.
  double length() const;
  /// Of every bit that decides how the run goes on.
  std::uint64_t hash() const;

 private:
  std::vector<Crack> cracks_;
  std::vector<Event> events_;
};

/// Connected groups of cracks, and whether one of them reaches from side to side.
struct CrackNetwork {
  int clusters = 0;
  double largest = 0.0;  ///< m
  bool spans_x = false;
  bool spans_y = false;
};

/// Cracks that touch within `tolerance` (m) belong to one cluster.
CrackNetwork network_of(const std::vector<Crack>& cracks, const Rectangle& body, double tolerance);

}  // namespace cdca
