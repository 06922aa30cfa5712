// SPDX-License-Identifier: BSD-3-Clause
#include "io/expression.hpp"

#include "core/base/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cdca {
namespace {

double value(const std::string& text, double x = 0.0, double y = 0.0, double s = 1.0) {
  return Expression(text)(x, y, s);
}

TEST(Expression, KnowsItsVariablesAndFunctions) {
  EXPECT_EQ(value("1e6*(1 - 2*x)*s", 0.25, 0.0, 0.5), 0.25e6);
  EXPECT_EQ(value("x + 10*y + 100*s", 1.0, 2.0, 3.0), 321.0);
  EXPECT_DOUBLE_EQ(value("sqrt(2)"), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(value("sin(pi/6)"), 0.5);
  EXPECT_DOUBLE_EQ(value("cos(pi/3)"), 0.5);
  EXPECT_DOUBLE_EQ(value("atan2(-1, -1)"), -0.75 * std::numbers::pi);
  EXPECT_EQ(value("abs(-2.5)"), 2.5);
  EXPECT_DOUBLE_EQ(value("exp(1)"), std::numbers::e);
  EXPECT_DOUBLE_EQ(value("log(exp(2))"), 2.0);  // natural
  EXPECT_EQ(value("min(3, 1, 2)"), 1.0);
  EXPECT_EQ(value("max(3, 1, 2)"), 3.0);
  EXPECT_EQ(value("-2^2"), -4.0);
  EXPECT_EQ(value("2^3^2"), 512.0);
}

TEST(Expression, KnowsConditionals) {
  const std::string text = "x < 0.5 ? 1 : (y >= 2 && x != 3 ? 2 : 3)";
  EXPECT_EQ(value(text, 0.4, 0.0), 1.0);
  EXPECT_EQ(value(text, 0.6, 2.0), 2.0);
  EXPECT_EQ(value(text, 0.6, 1.9), 3.0);
  EXPECT_EQ(value("x == 1 ? 5 : 6", 1.0), 5.0);
}

std::string complaint(const std::string& text) {
  try {
    const Expression expression(text);
    return "accepted";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Expression, SaysWhereItIsWrong) {
  EXPECT_EQ(complaint("1e6*(x"),
            "The expression \"1e6*(x\" cannot be read at character 7: a bracket is left open.");
  EXPECT_NE(complaint("2 + foo").find("character 5: \"foo\" is unknown; allowed are x, y, s, pi"),
            std::string::npos);
  EXPECT_NE(complaint("2*x y").find("character 5: \"y\" cannot stand there"), std::string::npos);
  EXPECT_NE(complaint("x*").find("character 3: it ends too early"), std::string::npos);
  EXPECT_NE(complaint("atan2(1)").find("needs more arguments"), std::string::npos);
  EXPECT_NE(complaint("sin(1, 2)").find("too many arguments"), std::string::npos);
  EXPECT_NE(complaint("x = 4").find("character 3: values are compared by \"==\""),
            std::string::npos);
  EXPECT_NE(complaint("x < 1 ? 2").find("no part after \":\""), std::string::npos);
  EXPECT_NE(complaint("x, y").find("2 values"), std::string::npos);
}

TEST(Expression, HasNoOtherNames) {
  for (const auto* text : {"rnd(1)", "_pi", "_e", "log10(x)", "t", "sum(1, 2)", "\"a\"", "X"}) {
    EXPECT_NE(complaint(text), "accepted") << text;
  }
}

TEST(Expression, CopiesAreIndependent) {
  const Expression first("x*s");
  Expression second("y");
  {
    const Expression gone("x + 1");
    second = gone;
  }
  EXPECT_EQ(second(2.0, 9.0, 0.0), 3.0);
  const Expression copy(first);
  EXPECT_EQ(first(2.0, 0.0, 3.0), 6.0);
  EXPECT_EQ(copy(5.0, 0.0, 1.0), 5.0);
  EXPECT_EQ(first(2.0, 0.0, 3.0), 6.0);
}

const std::vector<Vec2> places{{0.1, 0.2}, {0.5, 0.9}, {0.8, 0.3}};

TEST(ExpressionLoad, FindsOutWhetherItIsProportional) {
  const auto is_proportional = [](const std::string& text) {
    return expression_load(text, places, 0, "key").proportional;
  };
  EXPECT_TRUE(is_proportional("1e6*(1 - 2*x)*s"));
  EXPECT_TRUE(is_proportional("s"));
  EXPECT_TRUE(is_proportional("x < 0.5 ? s : 2*s"));
  EXPECT_TRUE(is_proportional("0"));
  EXPECT_FALSE(is_proportional("1e6"));
  EXPECT_FALSE(is_proportional("s^2"));
  EXPECT_FALSE(is_proportional("min(s, 1)"));
  EXPECT_FALSE(is_proportional("x > 0.7 ? 1 : s"));
  EXPECT_FALSE(is_proportional("s*log(x - 0.3)"));
}

TEST(ExpressionLoad, IsAFunctionThatCanBeCopied) {
  LoadValue kept;
  {
    const auto load = expression_load("x*s + y", places, 0, "key");
    EXPECT_EQ(load.text, "x*s + y");
    kept = load;
  }
  EXPECT_EQ(kept.at(2.0, 1.0, 3.0), 7.0);
}

TEST(ExpressionLoad, RefusesWhatIsNotFinite) {
  const auto load = expression_load("log(x)*s", places, 17, "boundary[1].traction[0]");
  EXPECT_EQ(load.at(1.0, 0.0, 1.0), 0.0);
  try {
    load.at(-1.0, 0.0, 1.0);
    FAIL() << "log(-1) was accepted";
  } catch (const InputError& error) {
    const auto& problem = error.problems().at(0);
    EXPECT_EQ(problem.line, 17);
    EXPECT_EQ(problem.key, "boundary[1].traction[0]");
    EXPECT_NE(problem.message.find("\"log(x)*s\""), std::string::npos);
    EXPECT_NE(problem.message.find("x = -1, y = 0, s = 1"), std::string::npos) << problem.message;
  }
  EXPECT_THROW(expression_load("1/x", places, 0, "key").at(0.0, 0.0, 1.0), InputError);
}

TEST(ExpressionLoad, OfAPlainNumberIsReachedAtFactorOne) {
  const auto load = proportional_load(4.0);
  EXPECT_EQ(load.at(3.0, 2.0, 1.0), 4.0);
  EXPECT_EQ(load.at(3.0, 2.0, 0.25), 1.0);
  EXPECT_TRUE(load.proportional);
}

}  // namespace
}  // namespace cdca
