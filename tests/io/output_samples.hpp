// SPDX-License-Identifier: BSD-3-Clause
/// Small results to write, and a folder to write them into.
#pragma once

#include "core/simulation/snapshot.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>

namespace cdca::testing {

/// A folder of its own for the running test, removed afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("cdca_") + info->test_suite_name() + "_" + info->name() + "_" +
             std::to_string(getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A unit square cut into a triangle and a pentagon, and a whole square right of it, shifted in x
/// by `shift`; values differ everywhere.
inline FieldPart sample_fields(int owner, double shift) {
  FieldPart part;
  part.points = {0,   0, 0.5, 0, 0, 0.5,                // triangle
                 0.5, 0, 1,   0, 1, 1,   0, 1, 0, 0.5,  // pentagon: its own points on the cut
                 2,   0, 2,   1};                       // the right side of the whole square
  for (std::size_t i = 0; i < part.points.size(); i += 2) part.points[i] += shift;
  for (std::size_t i = 0; i < part.points.size(); ++i)
    part.displacement.push_back(0.001 * static_cast<double>(i) + owner);
  part.offsets = {0, 3, 8, 12};
  part.connectivity = {0, 1, 2, 3, 4, 5, 6, 7, 4, 8, 9, 5};
  for (int p = 0; p < 3; ++p) {
    for (int c = 0; c < 4; ++c) part.stress.push_back(1e6 * p + 1e5 * c + 0.125 + owner);
    part.principal.insert(part.principal.end(), {2e6 + p, 1e6 + p});
    part.young.push_back(7.6e10 + p);
  }
  part.element = {(std::int64_t{1} << 40) + owner, (std::int64_t{1} << 40) + owner, 7 + owner};
  part.kind = {1, 1, 0};
  part.pieces = {2, 2, 1};
  part.owner = {owner, owner, owner};
  return part;
}

/// Two crack lines.
inline CrackPart sample_cracks() {
  CrackPart part;
  part.points = {0, 0.5, 0.5, 0, 0.5, 0, 0.75, 0.25};
  part.crack = {0, 3};
  part.age = {0, 2};
  part.opening = {1e-6, 2e-6, 2.5e-6, -1e-9};
  part.slip = {0, 1e-7, -1e-7, 3e-7};
  part.contact_state = {0, 2};
  part.normal_traction = {0.0, -1.5e5};
  part.tangential_traction = {0.0, 6.5e4};
  return part;
}

/// A run after two load steps, with two supports that report reactions.
inline Summary sample_summary() {
  Summary summary;
  summary.version = "0.1.0";
  summary.title = "A plate";
  summary.ranks = 2;
  summary.elements = 4017;
  summary.nodes = 4160;
  summary.unknowns = 8400;
  summary.load_factor = 1.0;
  summary.reaction_names = {"bottom", "top"};
  summary.steps = {{1, 0.5, {{{0.0, -10.0}}, {{0.0, 10.0}}}, 1.5, 0.012, 1, 1, 40, 0.25},
                   {2, 1.0, {{{0.1, -20.0}}, {{-0.1, 20.0}}}, 6.0, 0.013, 1, 2, 41, 0.5}};
  TipRecord mouth;
  mouth.state = "boundary";
  TipRecord tip;
  tip.step = 2;
  tip.end = 1;
  tip.at = {0.012, 0.026};
  tip.k1 = 1.0 / 3.0 * 1e6;
  tip.k2 = -12.5;
  tip.u_tension = 0.75;
  tip.angle_deg = -0.1;
  summary.tips = {mouth, tip};
  summary.cracks = {{"edge", {{0.0, 0.026}, {0.012, 0.026}}, 0.012}};
  summary.network = {1, 0.012, false, false};
  summary.events = {{0, 0, "boundary", 0, 0, -1, {0.0, 0.026}}};
  summary.performance = {1.25, 0.5, 0.625, 0.125, 3, 41, {100000000, 110000000}, {4200, 4200}};
  return summary;
}

}  // namespace cdca::testing
