// SPDX-License-Identifier: BSD-3-Clause
// The sections of a case file, in the order of the manual.
#include "io/case_options.hpp"

namespace cdca {
namespace {

constexpr OptionSection section_table[] = {
    {.name = "", .text = "Keys at the top of the file, before the first table."},
    {.name = "domain", .text = "The body: a rectangle with a regular grid."},
    {.name = "material", .text = "Linear elastic and isotropic."},
    {.name = "contact",
     .text = "What the faces of cracks do to each other. Every crack takes the keys of its own "
             "[[crack]] block first, then these; cracks of [crack_field] take these."},
    {.name = "enrichment", .text = "Near-tip functions."},
    {.name = "crack",
     .repeated = true,
     .text = "One block per initial crack, a polyline: either `points`, or `center`, `length` and "
             "`angle`. Cracks may cross, touch each other and end on the sides of the body."},
    {.name = "crack_field",
     .optional = true,
     .text = "Random straight cracks besides the [[crack]] blocks, called random1, random2, ...; "
             "the same for the same seed. Without this table there are none."},
    {.name = "boundary",
     .repeated = true,
     .text = "Supports and loads, one block per place: a side or the faces of a crack (`on`), or a "
             "point (`at`). Together the supports must hold the body against translation and "
             "rotation."},
    {.name = "loading", .text = "How the load factor s goes up."},
    {.name = "growth", .text = "When and where cracks grow."},
    {.name = "solver", .text = "How equilibrium is found."},
    {.name = "output", .text = "What is written into the result folder."},
    {.name = "region",
     .repeated = true,
     .later = true,
     .text = "Parts of the body with their own material, and holes."},
};

}  // namespace

std::span<const OptionSection> option_sections() { return section_table; }

}  // namespace cdca
