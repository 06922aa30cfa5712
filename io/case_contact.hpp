// SPDX-License-Identifier: BSD-3-Clause
/// The laws of crack faces in a case file.
#pragma once

#include "core/mechanics/contact_law.hpp"
#include "io/config_node.hpp"

#include <string>
#include <vector>

namespace cdca {

/// The law of a crack's faces: the keys of its block, and those of [contact] where it has none.
ContactSpec contact_of(const ConfigNode& root, const ConfigNode& block);

/// The law of faces without a block of their own: cracks of [crack_field].
ContactSpec common_contact(const ConfigNode& root);

/// Reports laws whose numbers are not all given, and numbers where no law is given at all.
void check_contact(const ConfigNode& root, std::vector<Problem>& problems);

/// What it understood: "coulomb, normal stiffness 4e+13 Pa/m, ...".
std::string describe_contact(const ContactSpec& contact);

}  // namespace cdca
