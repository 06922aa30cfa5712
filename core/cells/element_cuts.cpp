// SPDX-License-Identifier: BSD-3-Clause
#include "core/cells/element_cuts.hpp"

namespace cdca {

ElementCuts::ElementCuts(const StructuredGrid& grid, CrackPaths paths, const ElementCuts& previous)
    : grid_(grid), paths_(std::move(paths)) {
  for (const auto& [id, cut] : previous.cache_) {
    if (paths_.same_steps(previous.paths_, grid_.element_index(id))) cache_.emplace(id, cut);
  }
}

const CutElement* ElementCuts::find(GridIndex element) const {
  if (!touched(element)) return nullptr;
  auto& cut = cache_[grid_.element(element)];
  if (!cut) cut = std::make_shared<const CutElement>(cut_element(paths_, element));
  return cut.get();
}

int ElementCuts::parts(GridIndex element) const {
  const CutElement* cut = find(element);
  return cut ? cut->parts : 1;
}

const std::vector<SidePortion>& ElementCuts::side(GridIndex element, std::size_t side) const {
  static const std::vector<SidePortion> whole{SidePortion{}};
  const CutElement* cut = find(element);
  return cut ? cut->sides[side] : whole;
}

int ElementCuts::part_at(GridIndex element, const Vec2& at) const {
  const CutElement* cut = find(element);
  return cut ? cut->part_at(at - Vec2(element.i, element.j)) : 0;
}

std::vector<int> ElementCuts::parts_at(GridIndex element, const Vec2& at) const {
  const CutElement* cut = find(element);
  if (!cut) return {0};
  std::vector<int> found;
  for (const ElementPolygon& polygon : cut->polygons) {
    if (!polygon.continues && contains(polygon.loop, at - Vec2(element.i, element.j))) {
      found.push_back(polygon.part);
    }
  }
  return found;
}

std::vector<CrackFace> ElementCuts::faces_of(GridIndex element) const {
  std::vector<CrackFace> faces;
  if (const CutElement* cut = find(element)) {
    const Vec2 corner(element.i, element.j);
    for (const InnerFace& f : cut->faces) {
      const PathStep& step = paths_.step_in(element, f.step);
      faces.push_back({corner + f.from, corner + f.to, step.crack, step.segment, element, element,
                       f.plus, f.minus, step.along});
    }
  }
  add_side_faces(element, faces);
  return faces;
}

std::vector<CrackFace> ElementCuts::faces_at(GridIndex e) const {
  std::vector<CrackFace> faces = faces_of(e);
  for (const GridIndex other : {GridIndex{e.i - 1, e.j}, GridIndex{e.i, e.j - 1}}) {
    if (!grid_.has_element(other) || (!touched(e) && !touched(other))) continue;
    std::vector<CrackFace> theirs;
    add_side_faces(other, theirs);
    for (const CrackFace& face : theirs) {
      if (face.plus_element == e || face.minus_element == e) faces.push_back(face);
    }
  }
  return faces;
}

void ElementCuts::add_side_faces(GridIndex e, std::vector<CrackFace>& faces) const {
  const auto add = [&](std::size_t my_side, GridIndex other, std::size_t its_side, Vec2 start,
                       Vec2 along) {
    if (!grid_.has_element(other) || (!touched(e) && !touched(other))) return;
    for (const SideContact& c : contacts(side(e, my_side), side(other, its_side))) {
      if (c.open) continue;
      const PathStep& step = paths_.step_in(c.step_of_second ? other : e, c.step);
      CrackFace face{start + c.t0 * along,
                     start + c.t1 * along,
                     step.crack,
                     step.segment,
                     e,
                     other,
                     c.first,
                     c.second,
                     step.along};
      // `along` has this element on its left for the right side, on its right for the upper one;
      // the face keeps the direction of the crack
      bool mine_is_plus = my_side == 1;
      if ((step.to - step.from).dot(along) < 0) {
        std::swap(face.from, face.to);
        mine_is_plus = !mine_is_plus;
      }
      if (!mine_is_plus) {
        std::swap(face.plus_element, face.minus_element);
        std::swap(face.plus_part, face.minus_part);
      }
      faces.push_back(face);
    }
  };
  add(1, {e.i + 1, e.j}, 3, Vec2(e.i + 1, e.j), Vec2(0, 1));
  add(2, {e.i, e.j + 1}, 0, Vec2(e.i, e.j + 1), Vec2(1, 0));
}

}  // namespace cdca
