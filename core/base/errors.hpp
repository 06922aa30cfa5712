// SPDX-License-Identifier: BSD-3-Clause
/// The three ways in which a run can fail; the driver turns each into an exit status and one clear
/// message.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cdca {

/// One thing that is wrong with a case: where it stands, what was found there, what is allowed.
struct Problem {
  int line = 0;         ///< 1-based line of the case file; 0 when no line can be named
  std::string key;      ///< key path, as in "crack[1].points"
  std::string message;  ///< one full sentence: what was found and what is allowed
};

/// The input is wrong (exit status 2). Carries every problem that was found, not only the first.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems)
      : std::runtime_error(problems.empty() ? "wrong input" : problems.front().message),
        problems_(std::move(problems)) {}
  InputError(int line, std::string key, std::string message)
      : InputError(std::vector<Problem>{{line, std::move(key), std::move(message)}}) {}

  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// The equilibrium was not reached or an invariant broke (exit status 3).
class SolveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The states of touching faces did not settle; a smaller load step may help.
class ContactError : public SolveError {
 public:
  using SolveError::SolveError;
};

/// There is no equilibrium: a part of the body slides off on its faces, and nothing stops it.
class SlidesOff : public ContactError {
 public:
  using ContactError::ContactError;
};

/// A file could not be read or written (exit status 4).
class IoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace cdca
