// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/together.hpp"

#include "core/base/errors.hpp"
#include "core/base/first_failure.hpp"

#include <exception>
#include <string>

namespace cdca {

void together(Communicator& comm, const std::function<void()>& work) {
  std::string message;
  try {
    work();
  } catch (const std::exception& error) {
    message = error.what();
    if (message.empty()) message = "A file could not be written.";
  }
  const std::string first = first_failure(comm, message);
  if (!first.empty()) throw IoError(first);
}

}  // namespace cdca
