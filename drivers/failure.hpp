// SPDX-License-Identifier: BSD-3-Clause
/// From exceptions to exit statuses, the same on all ranks.
#pragma once

#include "core/base/communicator.hpp"

#include <exception>
#include <functional>
#include <string>

namespace cdca {

enum class ExitStatus : int { done = 0, wrong_input = 2, failed_solve = 3, failed_io = 4 };

struct Failure {
  ExitStatus status;
  std::string text;  ///< for the user, a line per problem
};

/// What an exception means. `case_file` is named in front of problems of the input.
Failure failure_of(const std::exception& error, const std::string& case_file);

/// Does the job on this rank. When it throws on all ranks, the root prints why and all ranks return
/// the status. When it throws on some ranks only, the others will never meet them again: the caller
/// must go straight to the end of MPI, and if that does not come within `patience_s`, a rank that
/// failed ends the whole run with its status, having printed its reason.
ExitStatus run_guarded(const std::function<void()>& job, const std::string& case_file,
                       const Communicator& ranks, double patience_s = 5.0);

}  // namespace cdca
