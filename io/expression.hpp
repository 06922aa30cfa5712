// SPDX-License-Identifier: BSD-3-Clause
/// Loads that are written as numbers or as expressions in x, y (m) and s (load factor).
#pragma once

#include "core/simulation/case_spec.hpp"

#include <memory>
#include <span>
#include <string>

namespace cdca {

/// A text such as "1e6*(1 - 2*x)*s" that can be evaluated. Functions: sqrt sin cos atan2 abs exp
/// log (natural) min max; the constant pi; powers by ^; comparisons and conditionals "a ? b : c".
/// A copy reads its text again, since the program behind it points to its own variables.
class Expression {
 public:
  /// \throws std::invalid_argument with a sentence that names the place, when the text cannot be
  /// read.
  explicit Expression(std::string text);
  Expression(const Expression& other);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression other) noexcept;
  ~Expression();

  const std::string& text() const { return text_; }
  /// Neither x nor y nor s occurs.
  bool is_constant() const;
  /// May be infinite or not a number, as in log(0).
  double operator()(double x, double y, double s) const;

 private:
  struct Program;

  std::string text_;
  std::unique_ptr<Program> program_;
};

/// The load that a text describes. `places` are where it will act, or some of them: on them it is
/// found out whether the load is proportional to s. Evaluating the load where the expression gives
/// no finite number throws an InputError that names the expression, `line` and `key`.
/// \throws InputError when the text cannot be read.
LoadValue expression_load(const std::string& text, std::span<const Vec2> places, int line,
                          const std::string& key);

}  // namespace cdca
