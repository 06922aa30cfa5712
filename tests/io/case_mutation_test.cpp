// SPDX-License-Identifier: BSD-3-Clause
// Whatever is done to a case file, the answer is a case or a list of sentences.
#include "tests/io/case_samples.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace cdca {
namespace {

using testing::plate;
using testing::problems_of;

/// Problems have a sentence, a key or a line, and lines of the file; anything else thrown fails the
/// test.
void expect_sentences(const std::string& text, int& refused) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  const auto problems = problems_of(text);
  if (!problems.empty()) ++refused;
  for (const auto& problem : problems) {
    const bool ends = problem.message.ends_with('.') || problem.message.ends_with('?');
    EXPECT_TRUE(ends && problem.message.size() > 20) << problem.message << "\n" << text;
    EXPECT_TRUE(problem.line > 0 || !problem.key.empty()) << problem.message << "\n" << text;
    EXPECT_LE(problem.line, lines) << text;
  }
}

TEST(CaseFileMutation, LosingAnyLetter) {
  int refused = 0;
  for (std::size_t i = 0; i < plate.size(); ++i)
    expect_sentences(std::string(plate).erase(i, 1), refused);
  EXPECT_GT(refused, 200);
}

TEST(CaseFileMutation, LosingAnyLine) {
  int refused = 0;
  for (std::size_t start = 0; start < plate.size();) {
    const auto end = plate.find('\n', start) + 1;
    expect_sentences(std::string(plate).erase(start, end - start), refused);
    start = end;
  }
  EXPECT_GT(refused, 10);
}

TEST(CaseFileMutation, AnyValueForAnyKey) {
  const std::vector<std::string> values{"1",
                                        "-1",
                                        "0",
                                        "1e300",
                                        "9223372036854775807",
                                        "nan",
                                        "true",
                                        "\"x\"",
                                        "\"\"",
                                        "\"free\"",
                                        "\"1/x\"",
                                        "\"log(x-9)\"",
                                        "[]",
                                        "[1]",
                                        "[1, 1]",
                                        "[0, 0]",
                                        "[-1e300, 1e300]",
                                        "[[1, 2]]",
                                        "[[0, 0], [0, 0]]",
                                        "[[0, 0], [1, 1], [2]]",
                                        "[\"s\", \"free\"]",
                                        "{}",
                                        "{a = 1}",
                                        "[{}]",
                                        "1979-05-27",
                                        "07:32:00"};
  int refused = 0;
  for (auto equals = plate.find(" = "); equals != std::string::npos;
       equals = plate.find(" = ", equals + 1)) {
    const auto end = plate.find('\n', equals);
    for (const auto& value : values) {
      expect_sentences(std::string(plate).replace(equals + 3, end - equals - 3, value), refused);
    }
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace cdca
