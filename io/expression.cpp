// SPDX-License-Identifier: BSD-3-Clause
#include "io/expression.hpp"

#include "core/base/errors.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace cdca {
namespace {

double least(const double* values, int count) { return *std::min_element(values, values + count); }
double largest(const double* values, int count) {
  return *std::max_element(values, values + count);
}

/// Only what the manual names: the library's own set has random numbers and other spellings.
void define_functions(mu::Parser& parser) {
  parser.ClearFun();
  parser.ClearConst();
  parser.DefineConst("pi", std::numbers::pi);
  parser.DefineFun("sqrt", static_cast<double (*)(double)>(std::sqrt));
  parser.DefineFun("sin", static_cast<double (*)(double)>(std::sin));
  parser.DefineFun("cos", static_cast<double (*)(double)>(std::cos));
  parser.DefineFun("atan2", static_cast<double (*)(double, double)>(std::atan2));
  parser.DefineFun("abs", static_cast<double (*)(double)>(std::fabs));
  parser.DefineFun("exp", static_cast<double (*)(double)>(std::exp));
  parser.DefineFun("log", static_cast<double (*)(double)>(std::log));
  parser.DefineFun("min", least);
  parser.DefineFun("max", largest);
}

/// The library takes "x = 4" for an assignment.
std::size_t find_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool compares_before =
        i > 0 && std::string_view("<>!=").find(text[i - 1]) != std::string_view::npos;
    const bool compares_after = i + 1 < text.size() && text[i + 1] == '=';
    if (!compares_before && !compares_after) return i;
  }
  return std::string::npos;
}

std::string reason(const mu::ParserError& error) {
  std::string token = error.GetToken();
  token.erase(token.find_last_not_of(' ') + 1);
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return fmt::format(
          "\"{}\" is unknown; allowed are x, y, s, pi and the functions sqrt, sin, cos, "
          "atan2, abs, exp, log, min and max",
          token);
    case mu::ecUNEXPECTED_EOF: return "it ends too early";
    case mu::ecMISSING_PARENS: return "a bracket is left open";
    case mu::ecTOO_FEW_PARAMS: return fmt::format("{} needs more arguments", token);
    case mu::ecTOO_MANY_PARAMS: return fmt::format("{} has too many arguments", token);
    case mu::ecMISSING_ELSE_CLAUSE: return "a conditional has no part after \":\"";
    default:
      return token.empty() ? "it is not complete" : fmt::format("\"{}\" cannot stand there", token);
  }
}

[[noreturn]] void refuse(const std::string& text, std::ptrdiff_t position, const std::string& why) {
  const auto character = std::clamp<std::ptrdiff_t>(position, 0, std::ssize(text)) + 1;
  throw std::invalid_argument(fmt::format(
      "The expression \"{}\" cannot be read at character {}: {}.", text, character, why));
}

}  // namespace

struct Expression::Program {
  double x = 0.0;
  double y = 0.0;
  double s = 0.0;
  mu::Parser parser;
};

Expression::Expression(std::string text)
    : text_(std::move(text)), program_(std::make_unique<Program>()) {
  auto& parser = program_->parser;
  define_functions(parser);
  parser.DefineVar("x", &program_->x);
  parser.DefineVar("y", &program_->y);
  parser.DefineVar("s", &program_->s);
  if (const auto place = find_assignment(text_); place != std::string::npos) {
    refuse(text_, static_cast<std::ptrdiff_t>(place),
           "values are compared by \"==\", not by \"=\"");
  }
  try {
    parser.SetExpr(text_);
    int results = 0;
    parser.Eval(results);
    if (results != 1) refuse(text_, 0, fmt::format("it gives {} values instead of one", results));
  } catch (const mu::ParserError& error) {
    refuse(text_, error.GetPos(), reason(error));
  }
}

Expression::Expression(const Expression& other) : Expression(other.text_) {}
Expression::Expression(Expression&&) noexcept = default;
Expression::~Expression() = default;

Expression& Expression::operator=(Expression other) noexcept {
  std::swap(text_, other.text_);
  std::swap(program_, other.program_);
  return *this;
}

bool Expression::is_constant() const { return program_->parser.GetUsedVar().empty(); }

double Expression::operator()(double x, double y, double s) const {
  program_->x = x;
  program_->y = y;
  program_->s = s;
  return program_->parser.Eval();
}

namespace {

bool is_proportional(const Expression& expression, std::span<const Vec2> places) {
  double scale = 0.0;
  for (const auto& at : places) scale = std::max(scale, std::abs(expression(at.x(), at.y(), 1.0)));
  for (const auto& at : places) {
    const double full = expression(at.x(), at.y(), 1.0);
    for (const double s : {0.0, 0.31, 0.73, 1.9}) {
      // Written so that a value that is no number counts as not proportional.
      if (!(std::abs(expression(at.x(), at.y(), s) - s * full) <= 1e-9 * scale)) return false;
    }
  }
  return true;
}

}  // namespace

LoadValue expression_load(const std::string& text, std::span<const Vec2> places, int line,
                          const std::string& key) try {
  const Expression expression(text);
  LoadValue load;
  load.text = text;
  load.proportional = is_proportional(expression, places);
  load.at = [expression, line, key](double x, double y, double s) {
    const double value = expression(x, y, s);
    if (std::isfinite(value)) return value;
    throw InputError(
        line, key,
        fmt::format("The expression \"{}\" gives {} at x = {}, y = {}, s = {}; a finite "
                    "number is needed wherever it acts.",
                    expression.text(), value, x, y, s));
  };
  return load;
} catch (const std::invalid_argument& error) {
  throw InputError(line, key, error.what());
}

}  // namespace cdca
