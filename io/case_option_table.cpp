// SPDX-License-Identifier: BSD-3-Clause
// The table itself; how it is read is in case_options.cpp.
#include "io/case_options.hpp"

namespace cdca {
namespace {

using enum OptionKind;
using enum OptionShape;

constexpr OptionRange positive{.low = 0.0, .low_allowed = false};
constexpr OptionRange not_negative{.low = 0.0};
constexpr OptionRange from_one{.low = 1.0, .high = 1e6};

/// The faces of cracks: in [contact], and in [[crack]] for that crack.
constexpr Option faces(std::string_view section, std::string_view key, std::string_view unit,
                       OptionRange range, std::string_view meaning) {
  return {.section = section, .key = key, .unit = unit, .range = range, .text = meaning};
}

/// A whole number that is not required.
constexpr Option whole(std::string_view section, std::string_view key, OptionRange range,
                       std::string_view standard, std::string_view meaning) {
  return {.section = section,
          .key = key,
          .kind = integer,
          .range = range,
          .standard = standard,
          .text = meaning};
}

constexpr std::string_view laws = "none|frictionless|coulomb|cohesive";
constexpr std::string_view as_in_contact = "As in [contact], for this crack only.";

/// A key of later versions.
constexpr Option later(std::string_view section, std::string_view key, std::string_view unit,
                       std::string_view meaning) {
  return {.section = section, .key = key, .unit = unit, .whole_key_later = true, .text = meaning};
}

constexpr Option option_table[] = {
    {.section = "",
     .key = "title",
     .kind = text,
     .text = "Stands in the results and pictures. Without it the name of the file is the title."},

    {.section = "domain",
     .key = "size",
     .shape = pair,
     .unit = "m",
     .range = positive,
     .required = true,
     .text = "Width and height of the body."},
    {.section = "domain",
     .key = "origin",
     .shape = pair,
     .unit = "m",
     .standard = "[0.0, 0.0]",
     .text = "Lower left corner."},
    {.section = "domain",
     .key = "cells",
     .kind = integer,
     .shape = pair,
     .range = from_one,
     .required = true,
     .text = "Number of elements in x and y. The cells of the method are the nodes, with the "
             "elements round them."},
    later("domain", "mesh", "", "File with a mesh of quads and triangles, instead of `cells`."),
    {.section = "domain",
     .key = "thickness",
     .unit = "m",
     .range = positive,
     .standard = "1.0",
     .text = "Thickness of the body. Forces and energies in the results are those of the whole "
             "thickness."},
    {.section = "domain",
     .key = "plane",
     .kind = choice,
     .choices = "stress|strain",
     .standard = "\"stress\"",
     .text = "Plane stress or plane strain."},
    {.section = "domain",
     .key = "body_force",
     .kind = load,
     .shape = pair,
     .unit = "N/m^3",
     .standard = "[0.0, 0.0]",
     .text = "Force per volume, such as weight."},

    {.section = "material",
     .key = "young",
     .unit = "Pa",
     .range = positive,
     .required = true,
     .text = "Young's modulus."},
    {.section = "material",
     .key = "poisson",
     .range = {.low = -1.0, .high = 0.5, .low_allowed = false, .high_allowed = false},
     .required = true,
     .text = "Poisson's ratio."},
    {.section = "material",
     .key = "tensile_strength",
     .unit = "Pa",
     .range = positive,
     .text = "Strength in tension."},
    {.section = "material",
     .key = "cohesion",
     .unit = "Pa",
     .range = positive,
     .text = "Cohesion of the Mohr-Coulomb criterion."},
    {.section = "material",
     .key = "friction_angle",
     .unit = "degrees",
     .range = {.low = 0.0, .high = 90.0, .high_allowed = false},
     .text = "Friction angle of the Mohr-Coulomb criterion."},
    {.section = "material",
     .key = "toughness",
     .unit = "Pa m^1/2",
     .range = positive,
     .text = "Fracture toughness in mode I."},
    later("material", "field", "", "Random Young's modulus per element."),

    {.section = "contact",
     .key = "law",
     .kind = choice,
     .choices = laws,
     .standard = "\"none\"",
     .text = "\"none\": crack faces do not feel each other, and may overlap in compression. "
             "\"frictionless\": they push; needs `normal_stiffness`. \"coulomb\": they push and "
             "rub; needs `normal_stiffness`, `tangential_stiffness` and `friction`. "
             "\"cohesive\": they hold together until they are torn apart; needs "
             "`normal_stiffness`, `cohesive_stiffness` and `critical_gap`. Cracks "
             "with this law have no K and do not grow. A law ignores the keys of other laws."},
    faces("contact", "normal_stiffness", "Pa/m", positive,
          "Stiffness of touching faces, per area of the faces: they overlap by their pressure "
          "divided by it."),
    faces("contact", "tangential_stiffness", "Pa/m", positive,
          "Stiffness of sticking faces against sliding, per area of the faces. With the law "
          "\"cohesive\": of faces that were pressed together; without it they slide freely."),
    faces("contact", "friction", "", not_negative,
          "Coefficient of friction, for the law \"coulomb\", and for \"cohesive\" with "
          "`tangential_stiffness`."),
    {.section = "contact",
     .key = "cohesion",
     .unit = "Pa",
     .range = not_negative,
     .standard = "0.0",
     .text = "Shear stress that touching faces bear besides friction, with the laws that know "
             "friction."},
    faces("contact", "cohesive_stiffness", "Pa/m", positive,
          "For the law \"cohesive\": slope, per area of the faces, by which the tension between "
          "them falls as they open. Their strength is about `cohesive_stiffness` times "
          "`critical_gap`."),
    faces("contact", "critical_gap", "m", positive,
          "For the law \"cohesive\": opening at which the faces let go."),

    {.section = "enrichment",
     .key = "tip_radius",
     .unit = "m",
     .range = not_negative,
     .standard = "0.0",
     .text =
         "Nodes within this distance of a tip get near-tip functions; 0: the nodes of the tip "
         "element only. Where another crack or the rim is within four elements of the tip, "
         "nodes up to five elements away get them in the proportions of modes I and II. Where a "
         "tip was before it joined a crack or the rim, they stay."},

    {.section = "crack",
     .key = "name",
     .kind = text,
     .text = "Without it the crack is called crack1, crack2, ... by its place in the file."},
    {.section = "crack",
     .key = "points",
     .shape = points,
     .unit = "m",
     .excludes = "center|length|angle",
     .text = "Corners of the polyline, from start to end."},
    {.section = "crack",
     .key = "center",
     .shape = pair,
     .unit = "m",
     .text = "Middle of a straight crack."},
    {.section = "crack",
     .key = "length",
     .unit = "m",
     .range = positive,
     .text = "Its length from end to end."},
    {.section = "crack",
     .key = "angle",
     .unit = "degrees",
     .text = "Its direction from x, counter-clockwise."},
    {.section = "crack", .key = "law", .kind = choice, .choices = laws, .text = as_in_contact},
    faces("crack", "normal_stiffness", "Pa/m", positive, as_in_contact),
    faces("crack", "tangential_stiffness", "Pa/m", positive, as_in_contact),
    faces("crack", "friction", "", not_negative, as_in_contact),
    faces("crack", "cohesion", "Pa", not_negative, as_in_contact),
    faces("crack", "cohesive_stiffness", "Pa/m", positive, as_in_contact),
    faces("crack", "critical_gap", "m", positive, as_in_contact),

    {.section = "crack_field",
     .key = "count",
     .kind = integer,
     .range = from_one,
     .required = true,
     .text = "Number of cracks."},
    {.section = "crack_field",
     .key = "length",
     .shape = limits,
     .unit = "m",
     .range = positive,
     .required = true,
     .text = "Smallest and largest length."},
    {.section = "crack_field",
     .key = "angle",
     .shape = limits,
     .unit = "degrees",
     .standard = "[0.0, 180.0]",
     .text = "Smallest and largest angle from x, counter-clockwise."},
    {.section = "crack_field",
     .key = "region",
     .shape = box,
     .unit = "m",
     .text = "Box in the body that holds the whole cracks. Without it: the body."},
    whole("crack_field", "seed", not_negative, "0", "Start of the random numbers."),

    {.section = "boundary",
     .key = "on",
     .kind = text,
     .excludes = "at",
     .text =
         "\"left\", \"right\", \"bottom\", \"top\", or \"crack:NAME\" for the faces of a crack."},
    {.section = "boundary",
     .key = "at",
     .shape = pair,
     .unit = "m",
     .text = "A point of the body: a support takes the nearest node, a force acts at the point "
             "itself."},
    {.section = "boundary",
     .key = "displacement",
     .kind = support,
     .shape = pair,
     .unit = "m",
     .text = "Prescribed displacement of a side or a point."},
    {.section = "boundary",
     .key = "traction",
     .kind = load,
     .shape = pair,
     .unit = "Pa",
     .text = "Load on a side, in global components."},
    {.section = "boundary",
     .key = "force",
     .kind = load,
     .shape = pair,
     .unit = "N/m",
     .text = "Force at a point, per metre of thickness."},
    {.section = "boundary",
     .key = "pressure",
     .kind = load,
     .unit = "Pa",
     .text = "Pressure on the faces of a crack; positive values open it."},

    {.section = "loading",
     .key = "steps",
     .kind = integer,
     .range = from_one,
     .standard = "1",
     .excludes = "factors",
     .no_standard_if = "mode=critical",
     .text = "Number of equal steps of the load factor from 0 to 1."},
    {.section = "loading",
     .key = "factors",
     .shape = list,
     .range = not_negative,
     .text = "The load factor of every step, increasing."},
    {.section = "loading",
     .key = "mode",
     .kind = choice,
     .choices = "prescribed|critical",
     .standard = "\"prescribed\"",
     .text = "\"prescribed\": the load factors are given. \"critical\": in every step, the load "
             "factor at which the next tip grows; needs a growth criterion, loads proportional to "
             "s, and neither `steps` nor `factors`."},
    whole(
        "loading", "max_events", from_one, "500",
        "Growth events, rows of history.csv, after which a critical loading ends; at the last one "
        "the load is found, but nothing grows."),
    {.section = "loading",
     .key = "min_factor",
     .range = {.low = 0.0, .high = 1.0, .low_allowed = false, .high_allowed = false},
     .standard = "0.05",
     .text = "A critical loading ends when the load factor falls below this part of the largest "
             "one reached."},

    {.section = "growth",
     .key = "criterion",
     .kind = choice,
     .choices = "none|hoop|mixed",
     .standard = "\"none\"",
     .text = "\"none\": cracks do not grow. \"hoop\": towards the largest hoop stress when it "
             "reaches the toughness; needs `material.toughness`. \"mixed\": by tension, and by "
             "shear where `material.cohesion` and `material.friction_angle` are given; needs "
             "`material.tensile_strength`."},
    {.section = "growth",
     .key = "radius",
     .kind = automatic,
     .unit = "m",
     .range = positive,
     .standard = "\"auto\"",
     .text = "Distance from the tip at which \"mixed\" looks at the stresses; \"auto\": from the "
             "material, between 2 and 4 element sides."},
    {.section = "growth",
     .key = "field",
     .kind = choice,
     .choices = "singular|full",
     .standard = "\"singular\"",
     .text = "Stresses by which \"mixed\" judges tension: those of K_I and K_II, or those of the "
             "whole computed field. Shear is always judged by the whole field."},
    {.section = "growth",
     .key = "literal",
     .kind = boolean,
     .standard = "false",
     .text = "true: the stresses at `radius` count as they are, and are not scaled so that "
             "mode I grows at the toughness."},
    {.section = "growth",
     .key = "step",
     .kind = choice,
     .choices = "arrest|fixed",
     .standard = "\"arrest\"",
     .text = "\"arrest\": as far as the stress would still break the material, within "
             "`step_length`. \"fixed\": always `step_length`, given as one number."},
    {.section = "growth",
     .key = "step_length",
     .shape = single_or_limits,
     .range = positive,
     .standard = "[1.0, 4.0]",
     .text = "Limits of a growth step, in `step_unit`; one number for a fixed one."},
    {.section = "growth",
     .key = "step_unit",
     .kind = choice,
     .choices = "element|m",
     .standard = "\"element\"",
     .text = "Unit of `step_length`: the smaller side of an element, or m."},
    {.section = "growth",
     .key = "direction",
     .kind = choice,
     .choices = "corrected|explicit",
     .standard = "\"corrected\"",
     .text = "\"corrected\": the direction of a new segment is corrected until it ends with K_II "
             "near 0. \"explicit\": as the criterion says before the segment is there."},
    whole(
        "growth", "cycles", from_one, "200",
        "Most growth cycles in one load step of a prescribed loading; then an event `unstable` is "
        "noted, and the next load step begins."),

    {.section = "solver",
     .key = "method",
     .kind = choice,
     .choices = "multilevel|krylov|relaxation",
     .standard = "\"multilevel\"",
     .text = "\"multilevel\": conjugate gradients with the rule on all scales as preconditioner. "
             "\"krylov\": with the rule on the grid alone; slower. \"relaxation\": the rule of the "
             "paper alone; much slower."},
    {.section = "solver",
     .key = "tolerance",
     .range = {.low = 1e-14, .high = 0.1},
     .standard = "1e-8",
     .text = "Out-of-balance force at which the solver stops, relative to the load."},
    {.section = "solver",
     .key = "over_relaxation",
     .range = {.low = 0.0, .high = 2.0, .low_allowed = false, .high_allowed = false},
     .standard = "1.0",
     .text = "Factor on every move of the rule; for method \"relaxation\" only."},
    whole("solver", "max_iterations", OptionRange{.low = 0.0, .high = 1e9}, "0",
          "Most iterations of one solve; 0: 200000, or 1000000 sweeps of \"relaxation\"."),
    whole("solver", "condensed_nodes", OptionRange{.low = 0.0, .high = 1e9}, "50000",
          "Grids of up to so many nodes are condensed to touching faces where these are many (an "
          "element of an initial crack for every hundred nodes): faster on few ranks, with more "
          "memory on each. Up to 10000 nodes they always are. Not with cohesive faces."),

    whole("output", "every", from_one, "1", "Load steps between field files."),
    whole("output", "checkpoint_every", OptionRange{.low = 0.0, .high = 1e6}, "10",
          "Load steps between checkpoints, from which `--restart` goes on; 0: none but the one "
          "of a run that is asked to stop."),
    {.section = "output",
     .key = "pictures",
     .kind = boolean,
     .standard = "true",
     .text = "Draw pictures when the run is over."},
};

}  // namespace

std::span<const Option> options() { return option_table; }

}  // namespace cdca
