// SPDX-License-Identifier: BSD-3-Clause
#include "parallel/together.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
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
  if (comm.max(message.empty() ? 0.0 : 1.0) == 0.0) return;

  Bytes mine;
  pack(mine, std::span<const char>(message));
  const auto messages = comm.gather(mine);
  const auto first = std::find_if(messages.begin(), messages.end(),
                                  [](const Bytes& bytes) { return !bytes.empty(); });
  Bytes shown = first == messages.end() ? Bytes{} : *first;
  comm.broadcast(shown);
  const auto letters = unpack<char>(shown);
  throw IoError(std::string(letters.begin(), letters.end()));
}

}  // namespace cdca
