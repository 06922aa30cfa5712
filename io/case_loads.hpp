// SPDX-License-Identifier: BSD-3-Clause
/// Loads of a case: values of the file as functions of place and load factor.
#pragma once

#include "core/simulation/case_spec.hpp"
#include "io/config_node.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cdca {

/// Reads the loads of one place of the body. `places` are points where they act; expressions must
/// be finite there at the load factors of `spec`, and proportional to it in critical mode.
class LoadReader {
 public:
  LoadReader(const CaseSpec& spec, std::vector<Vec2> places, std::vector<Problem>& problems)
      : spec_(spec), places_(std::move(places)), problems_(problems) {}

  /// A number or an expression; none for zero.
  std::optional<LoadValue> load(const ConfigNode& value, const std::string& path) const;
  /// A number or an expression; none for "free".
  std::optional<LoadValue> support(const ConfigNode& value, const std::string& path) const;
  LoadVector load_pair(const ConfigNode& value, const std::string& path) const;
  LoadVector support_pair(const ConfigNode& value, const std::string& path) const;

 private:
  void check_factor(const LoadValue& load, const ConfigNode& value, const std::string& path) const;
  std::optional<LoadValue> read(const ConfigNode& value, const std::string& path) const;

  const CaseSpec& spec_;
  std::vector<Vec2> places_;
  std::vector<Problem>& problems_;
};

/// Points inside the body, on a side without its ends, and in the middle of a crack's segments.
std::vector<Vec2> places_in(const DomainSpec& domain);
std::vector<Vec2> places_on(const DomainSpec& domain, Side side);
std::vector<Vec2> places_on(const CrackSpec& crack);

/// Both ends of a side, m.
std::array<Vec2, 2> ends_of(const DomainSpec& domain, Side side);

}  // namespace cdca
