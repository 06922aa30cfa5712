// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_file.hpp"

#include "io/case_builder.hpp"
#include "io/case_effective.hpp"
#include "io/case_overrides.hpp"
#include "io/case_validation.hpp"
#include "io/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace cdca {
namespace {

std::string read_text(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  const bool is_folder = std::filesystem::is_directory(path);
  if (file && !is_folder) text << file.rdbuf();
  if (file.good() && !is_folder) return text.str();
  const std::string reason = is_folder ? "it is a folder" : std::strerror(errno);
  throw InputError(0, "",
                   fmt::format("The case file \"{}\" cannot be read: {}; allowed is a TOML file.",
                               path, reason));
}

/// Problems without a line come last: they are about what is not in the file.
void sort_by_line(std::vector<Problem>& problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return (a.line > 0 && b.line == 0) || (a.line > 0 && a.line < b.line);
  });
}

}  // namespace

CaseSpec read_case(const std::string& path, const std::vector<std::string>& overrides) {
  return read_case_text(read_text(path), path, overrides);
}

CaseSpec read_case(const std::string& path, const std::vector<std::string>& overrides,
                   Communicator& ranks) {
  // The first byte says whether the rest is the text or the reason why there is none.
  std::string message;
  if (ranks.is_root()) {
    try {
      message = "t" + read_text(path);
    } catch (const InputError& error) {
      message = std::string("e") + error.what();
    }
  }
  Bytes bytes;
  pack(bytes, std::span<const char>(message));
  ranks.broadcast(bytes);
  const auto received = unpack<char>(bytes);
  const std::string text(received.begin() + 1, received.end());
  if (received.front() == 'e') throw InputError(0, "", text);
  return read_case_text(text, path, overrides);
}

CaseSpec read_case_text(const std::string& text, const std::string& file,
                        const std::vector<std::string>& overrides) {
  ConfigNode root = parse_toml(text);
  std::vector<Problem> problems;
  apply_overrides(root, overrides, problems);
  validate_case(root, problems);
  if (!root.find("title"))
    root.set("title", text_node(std::filesystem::path(file).stem().string()));
  CaseSpec spec = build_case(root, problems);
  if (!problems.empty()) {
    sort_by_line(problems);
    throw InputError(std::move(problems));
  }
  spec.file = file;
  spec.effective = effective_input(root);
  return spec;
}

}  // namespace cdca
