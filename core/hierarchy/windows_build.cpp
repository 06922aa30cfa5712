// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/errors.hpp"
#include "core/base/first_failure.hpp"
#include "core/hierarchy/windows.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace cdca {

/// Finds shares, collects the stiffness of every window on the rank that solves it, and lays down
/// who sends what to whom.
class Windows::Builder {
 public:
  Builder(Windows& windows, const WindowPlans& plans, const LocalMesh& mesh,
          const CellUnknowns& unknowns, WindowFactors& factors, const Windows* before,
          const CarriedCells* carried)
      : windows_(windows),
        plans_(plans),
        mesh_(mesh),
        unknowns_(unknowns),
        factors_(factors),
        before_(before),
        carried_(carried),
        held_(std::size_t(unknowns.count()), 0) {
    for (const LocalId u : windows.cells_.held()) held_[std::size_t(u)] = 1;
  }

  void build() {
    windows_.colours_.resize(std::size_t(plans_.colours));
    for (std::size_t w = 0; w < plans_.windows.size(); ++w) add_window(w);
    tell_solvers();
    fail_together(windows_.cells_.communicator(), [&] { place_windows(); });
    set_exchanges();
  }

 private:
  static constexpr int outside = -1, elsewhere = -2;
  /// An unknown of a cell, the same on every rank.
  using Key = std::pair<GlobalId, std::int64_t>;
  struct Entry {
    int row;     ///< member
    int column;  ///< member, or elsewhere: then the key counts
    Key key;
    double value;
  };
  /// What a rank contributes to a window.
  struct Contribution {
    std::vector<Key> keys;
    std::vector<Entry> entries;
  };
  struct Draft {
    int solver = 0;
    std::set<int> ranks;
    std::size_t share = 0;
    Contribution own;
    std::map<int, Contribution> remote;
    const Solved* kept = nullptr;  ///< of before the cracks grew
  };

  int rank() const { return mesh_.rank(); }

  void add_window(std::size_t w) {
    const auto& nodes = plans_.windows[w].nodes;
    std::map<int, int> cells;
    for (const GlobalId id : nodes) ++cells[mesh_.owner(mesh_.grid().node_index(id))];
    Draft draft;
    int most = 0;
    for (const auto& [owner, count] : cells) {
      draft.ranks.insert(owner);
      if (count > most) most = count, draft.solver = owner;
    }
    if (!draft.ranks.count(rank())) return;
    draft.share = windows_.shares_.size();
    draft.kept = find_kept(plans_.windows[w]);
    windows_.shares_.push_back(draft.kept ? carried_share(before_->shares_[draft.kept->share])
                                          : make_share(nodes, draft.own));
    drafts_.emplace(w, std::move(draft));
  }

  /// The window of the same cells before the cracks grew, if all about these is as it was.
  const Solved* find_kept(const WindowPlan& plan) const {
    if (!before_) return nullptr;
    const auto at = before_->own_.find(plan.nodes);
    if (at == before_->own_.end()) return nullptr;
    const auto [colour, place] = at->second;
    const auto same = [&](GlobalId id) {
      return carried_->same(mesh_.find_node(mesh_.grid().node_index(id)));
    };
    if (!std::all_of(plan.nodes.begin(), plan.nodes.end(), same)) return nullptr;
    return &before_->colours_[colour].solved[place];
  }

  Share carried_share(const Share& before) const {
    Share share = before;
    for (LocalId& u : share.members) u = carried_->now(u);
    for (Coupling& c : share.couplings) c.outside = carried_->now(c.outside);
    return share;
  }

  void add_kept(std::size_t w, const Draft& draft) {
    Solved solved;
    solved.share = draft.share;
    solved.size = draft.kept->size;
    solved.found = draft.kept->found;
    if (solved.found.factor) factors_.keep(solved.found);
    place(w, std::move(solved));
  }

  /// Puts a window where it belongs.
  void place(std::size_t w, Solved solved) {
    const WindowPlan& plan = plans_.windows[w];
    auto& list = windows_.colours_[std::size_t(plan.colour)].solved;
    solved_place_[w] = {std::size_t(plan.colour), list.size()};
    if (drafts_.at(w).ranks.size() == 1) windows_.own_.emplace(plan.nodes, solved_place_[w]);
    list.push_back(std::move(solved));
  }

  /// Own members, their couplings to cells outside, and their rows inside.
  Share make_share(const std::vector<GlobalId>& nodes, Contribution& own) {
    place_.resize(std::size_t(unknowns_.count()), outside);  // if any window is not kept
    Share share;
    std::map<LocalId, Key> ghosts;
    for (const GlobalId id : nodes) {
      const LocalId n = mesh_.find_node(mesh_.grid().node_index(id));
      if (n < 0) continue;
      std::int64_t k = 0;
      for (const LocalId u : unknowns_.of_cell(n)) {
        const Key key{id, k++};
        if (!mesh_.owns(n)) {
          place_[std::size_t(u)] = elsewhere;
          ghosts[u] = key;
        } else if (!held_[std::size_t(u)]) {
          place_[std::size_t(u)] = int(share.members.size());
          share.members.push_back(u);
          own.keys.push_back(key);
        }
      }
    }
    const StiffnessRows& rows = windows_.cells_.rows();
    std::vector<std::size_t> row_of(share.members.size());
    std::size_t row = 0, entries = 0;
    for (std::size_t m = 0; m < share.members.size(); ++m) {
      // rows of a cell, and those of the next one, mostly follow each other
      if (++row >= rows.unknown.size() || rows.unknown[row] != share.members[m]) {
        const std::ptrdiff_t found = rows.find(share.members[m]);
        if (found < 0) throw SolveError("a cell of a window has no row of its own");
        row = std::size_t(found);
      }
      row_of[m] = row;
      entries += rows.start[row + 1] - rows.start[row];
    }
    own.entries.reserve(entries);
    for (std::size_t m = 0; m < share.members.size(); ++m) {
      for (std::size_t k = rows.start[row_of[m]]; k < rows.start[row_of[m] + 1]; ++k) {
        const LocalId column = rows.column[k];
        const int place = place_[std::size_t(column)];
        if (place == outside) {
          if (!held_[std::size_t(column)])
            share.couplings.push_back({column, int(m), rows.value[k]});
        } else {
          own.entries.push_back(
              {int(m), place, place == elsewhere ? ghosts.at(column) : Key(), rows.value[k]});
        }
      }
    }
    for (const LocalId u : share.members) place_[std::size_t(u)] = outside;
    for (const auto& [u, key] : ghosts) place_[std::size_t(u)] = outside;
    return share;
  }

  void place_windows() {
    for (auto& [w, draft] : drafts_) {
      if (draft.solver != rank()) continue;
      if (draft.kept) {
        add_kept(w, draft);
      } else {
        add_solved(w, draft);
      }
    }
  }

  /// Ranks that solve a window of mine, or whose cells are in a window that I solve.
  std::vector<int> partners() const {
    std::set<int> found;
    for (const auto& [w, draft] : drafts_) {
      if (draft.solver != rank()) found.insert(draft.solver);
      if (draft.solver == rank()) found.insert(draft.ranks.begin(), draft.ranks.end());
    }
    found.erase(rank());
    return {found.begin(), found.end()};
  }

  void tell_solvers() {
    const auto ranks = partners();
    std::vector<Bytes> outgoing(ranks.size());
    for (std::size_t r = 0; r < ranks.size(); ++r) {
      std::vector<std::int64_t> numbers;
      std::vector<double> values;
      for (auto& [w, draft] : drafts_) {
        if (draft.solver != ranks[r]) continue;
        write(w, draft.own, numbers, values);
        draft.own = {};
      }
      numbers.insert(numbers.begin(), std::int64_t(numbers.size()));
      pack(outgoing[r], std::span<const std::int64_t>(numbers));
      pack(outgoing[r], std::span<const double>(values));
    }
    const auto incoming = windows_.cells_.communicator().exchange(ranks, outgoing);
    for (std::size_t r = 0; r < ranks.size(); ++r) read(ranks[r], incoming[r]);
  }

  void write(std::size_t w, const Contribution& own, std::vector<std::int64_t>& numbers,
             std::vector<double>& values) const {
    numbers.insert(numbers.end(), {std::int64_t(w), std::int64_t(own.keys.size())});
    for (const Key& key : own.keys) numbers.insert(numbers.end(), {key.first, key.second});
    numbers.push_back(std::int64_t(own.entries.size()));
    for (const Entry& e : own.entries) {
      const Key key = e.column == elsewhere ? e.key : own.keys[std::size_t(e.column)];
      numbers.insert(numbers.end(), {e.row, key.first, key.second});
      values.push_back(e.value);
    }
  }

  void read(int from, const Bytes& bytes) {
    std::int64_t count = 0;
    std::memcpy(&count, bytes.data(), sizeof count);
    std::vector<std::int64_t> numbers(std::size_t(count) + 1);
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(std::int64_t));
    std::vector<double> values(bytes.size() / 8 - numbers.size());
    if (!values.empty())
      std::memcpy(values.data(), bytes.data() + 8 * numbers.size(), 8 * values.size());
    std::size_t value = 0;
    for (std::size_t at = 1; at < numbers.size();) {
      Contribution& c = drafts_.at(std::size_t(numbers[at])).remote[from];
      const auto members = std::size_t(numbers[at + 1]);
      at += 2;
      for (std::size_t m = 0; m < members; ++m, at += 2)
        c.keys.emplace_back(numbers[at], numbers[at + 1]);
      const auto entries = std::size_t(numbers[at++]);
      for (std::size_t e = 0; e < entries; ++e, at += 3) {
        c.entries.push_back(
            {int(numbers[at]), elsewhere, {numbers[at + 1], numbers[at + 2]}, values[value++]});
      }
    }
  }

  void add_solved(std::size_t w, Draft& draft) {
    std::map<Key, int> slot;
    Solved solved;
    solved.share = draft.share;
    solved.size = windows_.shares_[draft.share].members.size();
    const bool shared = !draft.remote.empty();
    const auto name = [&](const Contribution& c, int first) {
      for (std::size_t k = 0; k < c.keys.size(); ++k) slot.emplace(c.keys[k], first + int(k));
    };
    if (shared) name(draft.own, 0);
    for (const auto& [from, c] : draft.remote) {
      name(c, int(solved.size));
      solved.size += c.keys.size();
    }
    StiffnessEntries entries;
    int first = 0;
    const auto add = [&](const Contribution& c) {
      for (const Entry& e : c.entries) {
        int column = e.column;
        if (column == elsewhere) {
          const auto found = slot.find(e.key);
          if (found == slot.end()) continue;  // held there
          column = found->second;
        }
        entries.emplace_back(first + e.row, column, e.value);
      }
      first += int(c.keys.size());
    };
    entries.reserve(draft.own.entries.size());
    add(draft.own);
    for (const auto& [from, c] : draft.remote) add(c);
    if (solved.size > 0) solved.found = factors_.of(solved.size, entries);
    place(w, std::move(solved));
    draft.own = {};
  }

  void set_exchanges() {
    const auto ranks = partners();
    std::vector<double> near_border(windows_.colours_.size(), 0.0);
    for (auto& [w, draft] : drafts_) {
      for (const Coupling& c : windows_.shares_[draft.share].couplings) {
        if (c.outside >= windows_.cells_.owned())
          near_border[std::size_t(plans_.windows[w].colour)] = 1.0;
      }
    }
    windows_.cells_.communicator().max(std::span<double>(near_border));
    for (std::size_t c = 0; c < windows_.colours_.size(); ++c) {
      Colour& colour = windows_.colours_[c];
      colour.near_border = near_border[c] > 0;
      for (const int other : ranks) {
        std::size_t sent = colour.send_offsets.back(), received = colour.receive_offsets.back();
        for (auto& [w, draft] : drafts_) {
          if (std::size_t(plans_.windows[w].colour) != c) continue;
          if (draft.solver == other) {
            colour.sent.push_back(draft.share);
            sent += windows_.shares_[draft.share].members.size();
          } else if (draft.solver == rank() && draft.remote.count(other)) {
            const std::size_t count = draft.remote.at(other).keys.size();
            const auto [of, at] = solved_place_.at(w);
            windows_.colours_[of].solved[at].remote.emplace_back(received, count);
            received += count;
          }
        }
        if (sent == colour.send_offsets.back() && received == colour.receive_offsets.back())
          continue;
        colour.ranks.push_back(other);
        colour.send_offsets.push_back(sent);
        colour.receive_offsets.push_back(received);
      }
    }
  }

  Windows& windows_;
  const WindowPlans& plans_;
  const LocalMesh& mesh_;
  const CellUnknowns& unknowns_;
  WindowFactors& factors_;
  const Windows* before_;
  const CarriedCells* carried_;
  std::vector<char> held_;
  std::vector<int> place_;
  std::map<std::size_t, Draft> drafts_;
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> solved_place_;
};

Windows::Windows(const WindowPlans& plans, const LocalMesh& mesh, const CellUnknowns& unknowns,
                 const CellStiffness& cells, WindowFactors& factors, const Windows* before,
                 const CarriedCells* carried)
    : cells_(cells) {
  Builder(*this, plans, mesh, unknowns, factors, before, carried).build();
}

}  // namespace cdca
