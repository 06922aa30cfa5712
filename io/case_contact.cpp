// SPDX-License-Identifier: BSD-3-Clause
#include "io/case_contact.hpp"

#include "io/case_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace cdca {
namespace {

using Problems = std::vector<Problem>;

/// A number of the laws, how it is called in descriptions, and the laws that need it or take it.
struct Number {
  std::string_view key;
  double ContactSpec::*member;
  std::string_view unit;
  std::array<bool, 4> needed;  ///< by ContactLaw
  std::array<bool, 4> taken;
};

constexpr Number numbers[] = {
    {"normal_stiffness", &ContactSpec::normal_stiffness, " Pa/m", {0, 1, 1, 1}, {0, 1, 1, 1}},
    {"tangential_stiffness",
     &ContactSpec::tangential_stiffness,
     " Pa/m",
     {0, 0, 1, 0},
     {0, 0, 1, 1}},
    {"friction", &ContactSpec::friction, "", {0, 0, 1, 0}, {0, 0, 1, 1}},
    {"cohesion", &ContactSpec::cohesion, " Pa", {0, 0, 0, 0}, {0, 0, 1, 1}},
    {"cohesive_stiffness", &ContactSpec::cohesive_stiffness, " Pa/m", {0, 0, 0, 1}, {0, 0, 0, 1}},
    {"critical_gap", &ContactSpec::critical_gap, " m", {0, 0, 0, 1}, {0, 0, 0, 1}},
};

constexpr std::string_view law_names[] = {"none", "frictionless", "coulomb", "cohesive"};

ContactLaw law_of(std::string_view name) {
  const auto* place = std::find(std::begin(law_names), std::end(law_names), name);
  return place == std::end(law_names) ? ContactLaw::none : ContactLaw(place - law_names);
}

/// Where a crack finds its keys; `block` is none for faces without a block of their own.
class Faces {
 public:
  Faces(const ConfigNode& root, const ConfigNode* block, std::string path)
      : common_(root.find("contact")), block_(block), path_(std::move(path)) {}

  const ConfigNode* find(std::string_view key) const {
    const auto* own = block_ ? block_->find(key) : nullptr;
    if (own) return own;
    return common_ ? common_->find(key) : nullptr;
  }

  /// As in messages: "crack[0].law" or "contact.law".
  std::string key_of(std::string_view key) const {
    const bool is_own = block_ && block_->find(key);
    return fmt::format("{}.{}", is_own ? path_ : "contact", key);
  }

  ContactSpec spec() const {
    ContactSpec contact;
    if (const auto* law = find("law")) contact.law = law_of(law->text);
    for (const auto& number : numbers) {
      if (const auto* node = find(number.key)) contact.*number.member = node->number;
    }
    return contact;
  }

  bool has_no_law() const {
    const auto* law = find("law");
    return law && law->is_default;
  }

  /// A value that was wrong has been taken out: then it is not missing on top of that.
  bool was_reported(std::string_view key, const Problems& problems) const {
    return std::any_of(problems.begin(), problems.end(), [&](const Problem& problem) {
      return problem.key == fmt::format("contact.{}", key) ||
             problem.key == fmt::format("{}.{}", path_, key);
    });
  }

 private:
  const ConfigNode* common_;
  const ConfigNode* block_;
  std::string path_;
};

/// A law of [contact] that lacks a number lacks it for many cracks: said once.
void add_once(Problem problem, Problems& problems) {
  const bool is_there = std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
    return other.key == problem.key && other.message == problem.message;
  });
  if (!is_there) problems.push_back(std::move(problem));
}

void check_complete(const Faces& faces, Problems& problems) {
  const auto law = faces.spec().law;
  const auto known = problems;
  const auto lacks = [&](std::string_view key, std::string_view why) {
    if (faces.find(key) || faces.was_reported(key, known)) return;
    add_once(problem_at(*faces.find("law"), faces.key_of("law"),
                        fmt::format("The law \"{}\"{} needs {}, which is not given; allowed are a "
                                    "value for it, here or in [contact], or another law.",
                                    law_names[std::size_t(law)], why, key)),
             problems);
  };
  for (const auto& number : numbers) {
    if (number.needed[std::size_t(law)]) lacks(number.key, "");
  }
  if (law == ContactLaw::cohesive && faces.find("friction"))
    lacks("tangential_stiffness", " with friction");
}

/// A law that was forgotten would make faces that do not touch, and nobody would notice.
void check_law_is_given(const ConfigNode& keys, const std::string& path, Problems& problems) {
  for (const auto& number : numbers) {
    const auto* node = keys.find(number.key);
    if (!node || node->is_default) continue;
    problems.push_back(problem_at(
        *node, fmt::format("{}.{}", path, number.key),
        fmt::format("The key \"{}\" has no effect, as no law of the crack faces is given; allowed "
                    "is a law with it, {}.",
                    number.key, quoted_words({"frictionless", "coulomb", "cohesive"}, "or"))));
    return;
  }
}

}  // namespace

ContactSpec contact_of(const ConfigNode& root, const ConfigNode& block) {
  return Faces(root, &block, "crack").spec();
}

ContactSpec common_contact(const ConfigNode& root) {
  return Faces(root, nullptr, "contact").spec();
}

void check_contact(const ConfigNode& root, Problems& problems) {
  const auto* cracks = root.find("crack");
  const Faces common(root, nullptr, "contact");
  const auto* law = common.find("law");
  if (!law) return;  // it was wrong, and is reported
  bool is_law_needed = common.has_no_law();
  if (!cracks || root.find("crack_field")) check_complete(common, problems);
  for (std::size_t i = 0; cracks && i < cracks->items.size(); ++i) {
    const auto path = fmt::format("crack[{}]", i);
    const Faces faces(root, &cracks->items[i], path);
    check_complete(faces, problems);
    const bool is_without = faces.has_no_law() && !faces.was_reported("law", problems);
    if (is_without) check_law_is_given(cracks->items[i], path, problems);
    is_law_needed = is_law_needed && is_without;
  }
  if (is_law_needed) check_law_is_given(*root.find("contact"), "contact", problems);
}

std::string describe_contact(const ContactSpec& contact) {
  const auto law = std::size_t(contact.law);
  std::string text(law_names[law]);
  for (const auto& number : numbers) {
    const double value = contact.*number.member;
    if (!number.taken[law] || (value == 0.0 && !number.needed[law])) continue;
    std::string name(number.key);
    std::replace(name.begin(), name.end(), '_', ' ');
    text += fmt::format(", {} {:.6g}{}", name, value, number.unit);
  }
  return text;
}

}  // namespace cdca
