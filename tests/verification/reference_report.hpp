// SPDX-License-Identifier: BSD-3-Clause
/// Results beside their references: lines for the log, rows for docs/verification.md.
#pragma once

#include "tests/verification/reference_cases.hpp"

#include <string>
#include <vector>

namespace cdca::testing {

/// One computed number beside its reference.
struct Comparison {
  std::string place;     ///< "tip (12, 0)"
  std::string quantity;  ///< "K_I"
  double computed = 0.0;
  double reference = 0.0;
  double error = 0.0;    ///< as the tolerance of the case measures it
  double allowed = 0.0;  ///< largest error within the tolerance

  double share() const { return error / allowed; }
};

struct ReferenceResult {
  std::string id;
  std::string grid;  ///< "80 x 160"
  std::vector<Comparison> comparisons;
  std::string note;  ///< instead of comparisons: where the case is tested

  /// The comparison that comes nearest to its tolerance, or is farthest beyond.
  const Comparison& worst() const;
};

/// Errors of K_I and K_II as the tolerance of the case measures them:
///
///   K_rel with KII_abs_over_Kmax or K_abs_over_Kmax   K_I relative to its reference (to K_max
///   where
///                          that is below K_max / 1000), K_II relative to K_max of the whole case
///   K_rel alone            both relative to |K| = sqrt(K_I^2 + K_II^2) of the tip
///   K_rel_of_max           both relative to K_max, the largest |K| of the case
///   KII_rel                closed cracks: K_I relative to |K|, at most KI_abs_over_KII if that is
///                          there; K_II relative to its reference
///
/// A tip without intensity counts with K_max, and that of a case without any with `unit`.
std::vector<Comparison> compare_tips(const std::vector<ExpectedTip>& expected,
                                     const std::vector<ExpectedTip>& computed,
                                     const ReferenceTolerance& tolerance, double unit = 1.0);

/// One line for every comparison.
std::string log_of(const ReferenceResult& result);

/// Puts the result's row into the table between the lines "<!-- results -->" and
/// "<!-- end of results -->" of the Markdown file that the environment variable
/// CDCA_VERIFICATION_TABLE names; makes the file if there is none. Rows of other cases stay. Does
/// nothing without the variable.
void write_row(const ReferenceResult& result);

}  // namespace cdca::testing
