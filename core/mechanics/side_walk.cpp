// SPDX-License-Identifier: BSD-3-Clause
#include "core/mechanics/side_walk.hpp"

namespace cdca {

Vec2 SideGeometry::at(double t) const {
  switch (element_side) {
    case 0: return {t, 0};
    case 1: return {1, t};
    case 2: return {t, 1};
    default: return {0, t};
  }
}

SideGeometry geometry_of(Side side) {
  switch (side) {
    case Side::bottom: return {0, 0, 1, {0, -1}};
    case Side::right: return {1, 1, 2, {1, 0}};
    case Side::top: return {2, 3, 2, {0, 1}};
    case Side::left: break;
  }
  return {3, 0, 3, {-1, 0}};
}

std::vector<Side> sides_at(const StructuredGrid& grid, GridIndex element) {
  std::vector<Side> sides;
  if (element.i == 0) sides.push_back(Side::left);
  if (element.i == grid.nx() - 1) sides.push_back(Side::right);
  if (element.j == 0) sides.push_back(Side::bottom);
  if (element.j == grid.ny() - 1) sides.push_back(Side::top);
  return sides;
}

std::vector<GridIndex> elements_at(const LocalMesh& mesh, Side side) {
  const StructuredGrid& grid = mesh.grid();
  const bool along_x = side == Side::bottom || side == Side::top;
  std::vector<GridIndex> elements;
  for (int k = 0; k < (along_x ? grid.nx() : grid.ny()); ++k) {
    GridIndex e{k, 0};
    if (side == Side::top) e = {k, grid.ny() - 1};
    if (side == Side::left) e = {0, k};
    if (side == Side::right) e = {grid.nx() - 1, k};
    if (mesh.find_element(e) >= 0) elements.push_back(e);
  }
  return elements;
}

}  // namespace cdca
