// SPDX-License-Identifier: BSD-3-Clause
#include "core/hierarchy/front_factor.hpp"

#include "core/base/dense_product.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cdca {

namespace {

/// The later unknowns that each couples to once all before it have been eliminated, ascending.
/// Every one but the last of a part passes its own on to the first of them.
std::vector<std::vector<int>> coupled_later(const Eigen::SparseMatrix<double>& lower) {
  const auto size = std::size_t(lower.cols());
  std::vector<std::vector<int>> later(size), passed(size);
  std::vector<int> seen(size, -1);
  for (std::size_t j = 0; j < size; ++j) {
    std::vector<int>& own = later[j];
    std::vector<int> others;
    const auto is_new = [&](int row) {
      if (row <= int(j) || seen[std::size_t(row)] == int(j)) return false;
      seen[std::size_t(row)] = int(j);
      return true;
    };
    // most of one has been passed on in order
    if (!passed[j].empty())
      std::ranges::copy_if(later[std::size_t(passed[j].back())], std::back_inserter(own), is_new);
    const int* rows = lower.innerIndexPtr();
    std::copy_if(rows + lower.outerIndexPtr()[j], rows + lower.outerIndexPtr()[j + 1],
                 std::back_inserter(others), is_new);
    for (const int before : passed[j])
      std::ranges::copy_if(later[std::size_t(before)], std::back_inserter(others), is_new);
    std::ranges::sort(others);
    const auto middle = std::ptrdiff_t(own.size());
    own.insert(own.end(), others.begin(), others.end());
    std::inplace_merge(own.begin(), own.begin() + middle, own.end());
    if (!own.empty()) passed[std::size_t(own.front())].push_back(int(j));
  }
  return later;
}

/// Whether fronts become one though that fills in zeros: small ones cost more to handle than to
/// eliminate. count: unknowns of both; part: zeros among their entries of L.
bool worth_joining(Eigen::Index count, double part) {
  constexpr Eigen::Index tiny = 4, small = 16;
  return count <= tiny || part < (count <= small ? 0.3 : 0.05);
}

}  // namespace

void FrontFactor::lay_fronts(const Eigen::SparseMatrix<double>& lower) {
  fronts_.clear();
  values_.clear();
  auto later = coupled_later(lower);
  for (std::size_t j = 0; j < later.size(); ++j) {
    fronts_.push_back({.first = int(j), .later = std::move(later[j])});
    while (joins_the_one_before()) {
    }
  }
  link_fronts(int(later.size()));
  number_entries();
  lower_.clear();
  rest_.clear();
}

bool FrontFactor::joins_the_one_before() {
  if (fronts_.size() < 2) return false;
  Front &last = fronts_.back(), &before = *std::prev(fronts_.end(), 2);
  if (before.later.empty() || before.later.front() != last.first) return false;
  const int count = before.count + last.count;
  const double filled_in =
      double(before.count) * double(last.rows() - Eigen::Index(before.later.size()));
  const double zeros = before.zeros + last.zeros + filled_in;
  const double entries = double(count) * double(before.count + last.rows());
  if (zeros > 0.0 && !worth_joining(count, zeros / entries)) return false;
  before.count = count;
  before.zeros = zeros;
  before.later = std::move(last.later);
  fronts_.pop_back();
  return true;
}

void FrontFactor::link_fronts(int unknowns) {
  std::vector<int> front_of(static_cast<std::size_t>(unknowns));
  for (std::size_t f = 0; f < fronts_.size(); ++f)
    std::fill_n(front_of.begin() + fronts_[f].first, fronts_[f].count, int(f));
  taken_up_.assign(fronts_.size(), {});
  row_.assign(std::size_t(unknowns), 0);
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    Front& front = fronts_[f];
    if (front.later.empty()) continue;
    const auto number = std::size_t(front_of[std::size_t(front.later.front())]);
    taken_up_[number].push_back(int(f));
    const Front& next = fronts_[number];
    for (const int u : front.later) {
      const auto at = std::ranges::lower_bound(next.later, u) - next.later.begin();
      const bool eliminated_there = u < next.first + next.count;
      front.rows_in_next.push_back(eliminated_there ? u - next.first : next.count + int(at));
    }
  }
}

void FrontFactor::number_entries() {
  std::size_t lower = 0, rest = 0;
  for (Front& f : fronts_) {
    f.lower = lower;
    f.rest = rest;
    lower += std::size_t(f.rows()) * std::size_t(f.count);
    rest += f.later.size() * f.later.size();
  }
  entries_ = Eigen::Index(lower);
  rest_entries_ = Eigen::Index(rest);
}

bool FrontFactor::factorize(const Eigen::SparseMatrix<double>& lower) {
  const double* values = lower.valuePtr();
  const bool anew = values_.empty();
  lower_.resize(std::size_t(entries_), 0.0);
  rest_.resize(std::size_t(rest_entries_), 0.0);
  std::vector<char> renewed(fronts_.size(), 0);
  renewed_ = 0;
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    const Front& front = fronts_[f];
    const auto begin = std::size_t(lower.outerIndexPtr()[front.first]);
    const auto end = std::size_t(lower.outerIndexPtr()[front.first + front.count]);
    const auto& before = taken_up_[f];
    const bool same =
        !anew && std::equal(values + begin, values + end, values_.data() + begin) &&
        std::ranges::none_of(before, [&](int b) { return renewed[std::size_t(b)] != 0; });
    if (same) continue;
    renewed[f] = 1;
    ++renewed_;
    assemble(front, lower);
    for (const int b : before) add_rest(fronts_[std::size_t(b)], front);
    if (!eliminate(front)) {
      values_.clear();
      return false;
    }
  }
  values_.assign(values, values + lower.nonZeros());
  return true;
}

void FrontFactor::assemble(const Front& front, const Eigen::SparseMatrix<double>& lower) {
  Dense columns = lower_of(front);
  Dense rest = rest_of(front);
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    columns.col(k).tail(columns.rows() - k).setZero();
  for (Eigen::Index k = 0; k < rest.cols(); ++k) rest.col(k).tail(rest.rows() - k).setZero();
  for (int k = 0; k < front.count; ++k) row_[std::size_t(front.first + k)] = k;
  for (std::size_t k = 0; k < front.later.size(); ++k)
    row_[std::size_t(front.later[k])] = front.count + int(k);
  for (int k = 0; k < front.count; ++k) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, front.first + k); it; ++it)
      columns(row_[std::size_t(it.row())], k) = it.value();
  }
}

void FrontFactor::add_rest(const Front& before, const Front& front) {
  Dense columns = lower_of(front), rest = rest_of(front);
  const Dense from = rest_of(before);
  const auto& to = before.rows_in_next;
  for (Eigen::Index c = 0; c < from.cols(); ++c) {
    const int column = to[std::size_t(c)];
    // rows of what is left count from the later unknowns on
    const int skipped = column < front.count ? 0 : front.count;
    double* into = skipped == 0 ? &columns(0, column) : &rest(0, column - skipped);
    for (Eigen::Index r = c; r < from.rows(); ++r) into[to[std::size_t(r)] - skipped] += from(r, c);
  }
}

bool FrontFactor::eliminate(const Front& front) {
  constexpr Eigen::Index panel = 32;
  Dense l = lower_of(front);
  const Eigen::Index rows = l.rows(), count = l.cols(), left = rows - count;
  Eigen::VectorXd weights(panel);
  for (Eigen::Index first = 0; first < count; first += panel) {
    const Eigen::Index width = std::min(panel, count - first);
    if (first > 0) {
      const Eigen::MatrixXd weighted =
          l.block(first, 0, width, first) * l.diagonal().head(first).asDiagonal();
      add_product(-1.0, l.block(first, 0, rows - first, first), weighted, Transposed::second,
                  l.block(first, first, rows - first, width));
    }
    for (Eigen::Index j = first; j < first + width; ++j) {
      const Eigen::Index done = j - first;
      auto column = l.col(j).tail(rows - j);
      weights.head(done) =
          l.row(j).segment(first, done).transpose().cwiseProduct(l.diagonal().segment(first, done));
      column.noalias() -= l.block(j, first, rows - j, done) * weights.head(done);
      const double pivot = column[0];
      if (pivot == 0.0 || !std::isfinite(pivot)) return false;
      column.tail(rows - j - 1) /= pivot;
    }
  }
  if (left == 0) return true;
  const auto below = l.bottomRows(left);
  const Eigen::MatrixXd weighted = below * l.diagonal().asDiagonal();
  add_lower_product(-1.0, below, weighted, Transposed::second, rest_of(front));
  return true;
}

void FrontFactor::solve(Eigen::VectorXd& values) const {
  Eigen::VectorXd later(row_.size());
  for (const Front& f : fronts_) {
    const ConstDense l = lower_of(f);
    const Eigen::Index left = l.rows() - l.cols();
    auto own = values.segment(f.first, f.count);
    auto rest = later.head(left);
    rest.setZero();
    for (Eigen::Index j = 0; j < f.count; ++j) {
      own.tail(f.count - j - 1) -= own[j] * l.col(j).segment(j + 1, f.count - j - 1);
      rest += own[j] * l.col(j).tail(left);
    }
    for (Eigen::Index k = 0; k < left; ++k) values[f.later[std::size_t(k)]] -= rest[k];
    own.array() /= l.diagonal().array();
  }
  for (auto f = fronts_.rbegin(); f != fronts_.rend(); ++f) {
    const ConstDense l = lower_of(*f);
    const Eigen::Index left = l.rows() - l.cols();
    auto own = values.segment(f->first, f->count);
    for (Eigen::Index k = 0; k < left; ++k) later[k] = values[f->later[std::size_t(k)]];
    for (Eigen::Index j = f->count; j-- > 0;) {
      own[j] -= l.col(j).tail(left).dot(later.head(left)) +
                l.col(j).segment(j + 1, f->count - j - 1).dot(own.tail(f->count - j - 1));
    }
  }
}

}  // namespace cdca
