// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk_writer.hpp"

#include "core/base/errors.hpp"
#include "io/paraview_index.hpp"
#include "io/text_file.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <string>

namespace cdca {
namespace {

void demand(bool fits, const std::filesystem::path& file) {
  if (!fits)
    throw IoError("Cannot write " + file.string() + ": its lists of points and values do not fit.");
}

/// `width` values of every tuple, padded with zeros up to the components of the array.
template <class VtkArray, class T>
vtkNew<VtkArray> filled(const std::vector<T>& values, std::size_t width, std::size_t components) {
  vtkNew<VtkArray> array;
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size() / width));
  auto* out = array->GetPointer(0);
  for (std::size_t i = 0; i < values.size(); i += width) {
    for (std::size_t c = 0; c < components; ++c)
      *out++ = c < width ? static_cast<typename VtkArray::ValueType>(values[i + c]) : 0;
  }
  return array;
}

vtkNew<vtkPoints> points_of(const std::vector<double>& xy) {
  const auto coordinates = filled<vtkDoubleArray>(xy, 2, 3);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(coordinates);
  return points;
}

/// The arrays of one grid, added by the names of the table that the .pvtu is written from.
class GridArrays {
 public:
  GridArrays(vtkUnstructuredGrid* grid, const std::vector<ResultArray>& table,
             const std::filesystem::path& file)
      : grid_(grid), table_(table), file_(file) {}

  void add(const std::string& name, const std::vector<double>& values, std::size_t width = 1) {
    add_as<vtkDoubleArray>(name, values, width);
  }
  void add(const std::string& name, const std::vector<int>& values) {
    add_as<vtkTypeInt32Array>(name, values, 1);
  }
  void add(const std::string& name, const std::vector<std::int64_t>& values) {
    add_as<vtkTypeInt64Array>(name, values, 1);
  }

 private:
  template <class VtkArray, class T>
  void add_as(const std::string& name, const std::vector<T>& values, std::size_t width) {
    const auto info = std::find_if(table_.begin(), table_.end(),
                                   [&](const ResultArray& array) { return array.name == name; });
    demand(info != table_.end(), file_);
    const vtkIdType tuples =
        info->on_points ? grid_->GetNumberOfPoints() : grid_->GetNumberOfCells();
    demand(values.size() == width * static_cast<std::size_t>(tuples), file_);
    const auto array =
        filled<VtkArray>(values, width, static_cast<std::size_t>(component_count(*info)));
    array->SetName(name.c_str());
    for (std::size_t c = 0; c < info->components.size(); ++c)
      array->SetComponentName(static_cast<vtkIdType>(c), info->components[c].c_str());
    vtkDataSetAttributes* data = grid_->GetCellData();
    if (info->on_points) data = grid_->GetPointData();
    data->AddArray(array);
  }

  vtkUnstructuredGrid* grid_;
  const std::vector<ResultArray>& table_;
  const std::filesystem::path& file_;
};

/// VTK 9.2 crashes when the disk is full: it only makes the text, and we write it.
void write(const std::filesystem::path& file, vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(grid);
  // Inline, not appended: ParaView 5.11 cannot read appended data with current versions of expat.
  writer->SetDataModeToBinary();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // higher levels cost more time and save a few percent
  if (writer->Write() != 1) throw IoError("VTK cannot make the text of " + file.string() + ".");
  write_text(file, writer->GetOutputString());
}

bool is_convex_quad(const FieldPart& part, const std::int64_t* corner) {
  const auto point = [&](int k) {
    const auto i = 2 * static_cast<std::size_t>(corner[k % 4]);
    return Vec2(part.points[i], part.points[i + 1]);
  };
  for (int k = 0; k < 4; ++k)
    if (cross(point(k + 1) - point(k), point(k + 2) - point(k + 1)) < 0.0) return false;
  return true;
}

/// VTK's own triangles and quads where that is what a polygon is; its quads must be convex.
unsigned char type_of_polygon(const FieldPart& part, std::size_t polygon) {
  const std::int64_t start = part.offsets[polygon];
  const std::int64_t corners = part.offsets[polygon + 1] - start;
  if (corners == 3) return VTK_TRIANGLE;
  if (corners == 4 && is_convex_quad(part, part.connectivity.data() + start)) return VTK_QUAD;
  return VTK_POLYGON;
}

bool is_sound(const FieldPart& part) {
  const auto points = static_cast<std::int64_t>(part.points.size() / 2);
  return part.points.size() % 2 == 0 && !part.offsets.empty() && part.offsets.front() == 0 &&
         part.offsets.back() == static_cast<std::int64_t>(part.connectivity.size()) &&
         std::is_sorted(part.offsets.begin(), part.offsets.end()) &&
         std::all_of(part.connectivity.begin(), part.connectivity.end(),
                     [&](std::int64_t i) { return i >= 0 && i < points; });
}

vtkNew<vtkCellArray> cells_of(const std::vector<std::int64_t>& offsets,
                              const std::vector<std::int64_t>& connectivity) {
  const auto starts = filled<vtkCellArray::ArrayType64>(offsets, 1, 1);
  const auto corners = filled<vtkCellArray::ArrayType64>(connectivity, 1, 1);
  vtkNew<vtkCellArray> cells;
  cells->SetData(starts, corners);
  return cells;
}

}  // namespace

void write_vtu(const std::filesystem::path& file, const FieldPart& part) {
  demand(is_sound(part), file);
  const auto points = points_of(part.points);
  const auto cells = cells_of(part.offsets, part.connectivity);
  vtkNew<vtkUnsignedCharArray> types;
  for (std::size_t p = 0; p + 1 < part.offsets.size(); ++p)
    types->InsertNextValue(type_of_polygon(part, p));
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(types, cells);

  GridArrays arrays(grid, field_arrays(), file);
  arrays.add("displacement", part.displacement, 2);
  arrays.add("stress", part.stress, 4);
  arrays.add("principal_stress", part.principal, 2);
  arrays.add("young", part.young);
  arrays.add("kind", part.kind);
  arrays.add("pieces", part.pieces);
  arrays.add("owner", part.owner);
  arrays.add("element", part.element);
  write(file, grid);
}

void write_vtu(const std::filesystem::path& file, const CrackPart& part) {
  demand(part.points.size() % 4 == 0, file);
  const auto points = points_of(part.points);
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> connectivity;
  for (std::size_t i = 0; i <= part.points.size() / 2; ++i) {
    if (i % 2 == 0) offsets.push_back(static_cast<std::int64_t>(i));
    if (i < part.points.size() / 2) connectivity.push_back(static_cast<std::int64_t>(i));
  }
  const auto cells = cells_of(offsets, connectivity);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(VTK_LINE, cells);

  GridArrays arrays(grid, crack_arrays(), file);
  arrays.add("opening", part.opening);
  arrays.add("slip", part.slip);
  arrays.add("crack", part.crack);
  arrays.add("age", part.age);
  arrays.add("contact_state", part.contact_state);
  arrays.add("normal_traction", part.normal_traction);
  arrays.add("tangential_traction", part.tangential_traction);
  write(file, grid);
}

}  // namespace cdca
