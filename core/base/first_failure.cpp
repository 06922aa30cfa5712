// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/first_failure.hpp"

#include "core/base/errors.hpp"

#include <algorithm>
#include <span>

namespace cdca {

std::string first_failure(Communicator& communicator, const std::string& mine) {
  if (communicator.max(mine.empty() ? 0.0 : 1.0) == 0.0) return {};
  Bytes bytes;
  pack(bytes, std::span<const char>(mine));
  const auto messages = communicator.gather(bytes);
  const auto first =
      std::find_if(messages.begin(), messages.end(), [](const Bytes& b) { return !b.empty(); });
  Bytes shown = first == messages.end() ? Bytes{} : *first;
  communicator.broadcast(shown);
  const auto letters = unpack<char>(shown);
  return {letters.begin(), letters.end()};
}

void fail_together(Communicator& communicator, const std::function<void()>& work) {
  constexpr char between = '\x1f';
  std::string mine;
  try {
    work();
  } catch (const InputError& error) {
    const Problem& p = error.problems().front();
    mine = std::to_string(p.line) + between + p.key + between + p.message;
  } catch (const SolveError& error) {
    mine = between;
    mine += error.what();
  }
  const std::string shown = first_failure(communicator, mine);
  if (shown.empty()) return;
  if (shown.front() == between) throw SolveError(shown.substr(1));
  const auto key = shown.find(between), text = shown.find(between, key + 1);
  throw InputError(std::stoi(shown.substr(0, key)), shown.substr(key + 1, text - key - 1),
                   shown.substr(text + 1));
}

}  // namespace cdca
