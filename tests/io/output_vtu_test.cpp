// SPDX-License-Identifier: BSD-3-Clause
// What our writer leaves is read back with VTK's own readers.
#include "core/base/errors.hpp"
#include "io/paraview_index.hpp"
#include "io/text_file.hpp"
#include "io/vtk_writer.hpp"
#include "tests/io/output_samples.hpp"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace cdca {
namespace {

using testing::sample_cracks;
using testing::sample_fields;
using testing::ScratchFolder;
using testing::text_of;

template <class Reader>
vtkSmartPointer<vtkUnstructuredGrid> read(const std::filesystem::path& file) {
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0u);
  return reader->GetOutput();
}

vtkSmartPointer<vtkUnstructuredGrid> read_piece(const std::filesystem::path& file) {
  return read<vtkXMLUnstructuredGridReader>(file);
}

vtkSmartPointer<vtkUnstructuredGrid> read_step(const std::filesystem::path& file) {
  return read<vtkXMLPUnstructuredGridReader>(file);
}

vtkDataArray* array_of(vtkUnstructuredGrid* grid, const ResultArray& info) {
  vtkDataSetAttributes* data = grid->GetCellData();
  if (info.on_points) data = grid->GetPointData();
  return data->GetArray(info.name.c_str());
}

/// Every array of the table is there, as the table says, and no other.
void expect_arrays(vtkUnstructuredGrid* grid, const std::vector<ResultArray>& table) {
  for (const ResultArray& info : table) {
    vtkDataArray* array = array_of(grid, info);
    ASSERT_NE(array, nullptr) << info.name;
    EXPECT_EQ(array->GetNumberOfComponents(), component_count(info)) << info.name;
    EXPECT_EQ(array->GetNumberOfTuples(),
              info.on_points ? grid->GetNumberOfPoints() : grid->GetNumberOfCells());
    for (std::size_t c = 0; c < info.components.size(); ++c)
      EXPECT_STREQ(array->GetComponentName(static_cast<vtkIdType>(c)), info.components[c].c_str());
    EXPECT_EQ(array->GetDataTypeSize(), info.type == "Int32" ? 4 : 8) << info.name;
    EXPECT_EQ(array->GetDataType() == VTK_DOUBLE, info.type == "Float64") << info.name;
  }
  EXPECT_EQ(grid->GetCellData()->GetNumberOfArrays() + grid->GetPointData()->GetNumberOfArrays(),
            static_cast<int>(table.size()));
}

TEST(OutputVtu, KeepsPointsAndPolygons) {
  const ScratchFolder folder;
  const FieldPart part = sample_fields(0, 0.25);
  write_vtu(folder / "a.vtu", part);
  const auto grid = read_piece(folder / "a.vtu");
  ASSERT_EQ(grid->GetNumberOfPoints(), 10);
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  for (vtkIdType i = 0; i < 10; ++i) {
    EXPECT_EQ(grid->GetPoint(i)[0], part.points[static_cast<std::size_t>(2 * i)]);
    EXPECT_EQ(grid->GetPoint(i)[1], part.points[static_cast<std::size_t>(2 * i + 1)]);
    EXPECT_EQ(grid->GetPoint(i)[2], 0.0);
  }
  EXPECT_EQ(grid->GetCellType(0), VTK_TRIANGLE);
  EXPECT_EQ(grid->GetCellType(1), VTK_POLYGON);
  EXPECT_EQ(grid->GetCellType(2), VTK_QUAD);
  const std::vector<vtkIdType> square{4, 8, 9, 5};
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(grid->GetCell(2)->GetPointId(k), square[static_cast<std::size_t>(k)]);
}

TEST(OutputVtu, KeepsEveryValueBitForBit) {
  const ScratchFolder folder;
  const FieldPart part = sample_fields(1, 0.0);
  write_vtu(folder / "a.vtu", part);
  const auto grid = read_piece(folder / "a.vtu");
  expect_arrays(grid, field_arrays());
  auto* displacement = grid->GetPointData()->GetArray("displacement");
  for (vtkIdType i = 0; i < 10; ++i) {
    EXPECT_EQ(displacement->GetComponent(i, 0), part.displacement[static_cast<std::size_t>(2 * i)]);
    EXPECT_EQ(displacement->GetComponent(i, 1),
              part.displacement[static_cast<std::size_t>(2 * i + 1)]);
    EXPECT_EQ(displacement->GetComponent(i, 2), 0.0);
  }
  auto* cells = grid->GetCellData();
  for (std::size_t p = 0; p < 3; ++p) {
    const auto cell = static_cast<vtkIdType>(p);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_EQ(cells->GetArray("stress")->GetComponent(cell, static_cast<int>(c)),
                part.stress[4 * p + c]);
    EXPECT_EQ(cells->GetArray("principal_stress")->GetComponent(cell, 1),
              part.principal[2 * p + 1]);
    EXPECT_EQ(cells->GetArray("young")->GetTuple1(cell), part.young[p]);
    EXPECT_EQ(cells->GetArray("kind")->GetTuple1(cell), part.kind[p]);
    EXPECT_EQ(cells->GetArray("pieces")->GetTuple1(cell), part.pieces[p]);
    EXPECT_EQ(cells->GetArray("owner")->GetTuple1(cell), part.owner[p]);
    EXPECT_EQ(cells->GetArray("element")->GetVariantValue(cell).ToTypeInt64(), part.element[p]);
  }
}

TEST(OutputVtu, DrawsHollowQuadsAsPolygons) {
  const ScratchFolder folder;
  FieldPart part = sample_fields(0, 0.0);
  part.points[2 * 9] = 1.2;  // the upper right corner of the square comes in behind the diagonal
  part.points[2 * 9 + 1] = 0.2;
  write_vtu(folder / "a.vtu", part);
  EXPECT_EQ(read_piece(folder / "a.vtu")->GetCellType(2), VTK_POLYGON);
}

TEST(OutputVtu, KeepsCrackLines) {
  const ScratchFolder folder;
  const CrackPart part = sample_cracks();
  write_vtu(folder / "c.vtu", part);
  const auto grid = read_piece(folder / "c.vtu");
  expect_arrays(grid, crack_arrays());
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  ASSERT_EQ(grid->GetNumberOfPoints(), 4);
  EXPECT_EQ(grid->GetCellType(1), VTK_LINE);
  EXPECT_EQ(grid->GetCell(1)->GetPointId(0), 2);
  EXPECT_EQ(grid->GetPoint(3)[0], 0.75);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto id = static_cast<vtkIdType>(i);
    EXPECT_EQ(grid->GetPointData()->GetArray("opening")->GetTuple1(id), part.opening[i]);
    EXPECT_EQ(grid->GetPointData()->GetArray("slip")->GetTuple1(id), part.slip[i]);
  }
  auto* cells = grid->GetCellData();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto id = static_cast<vtkIdType>(i);
    EXPECT_EQ(cells->GetArray("crack")->GetTuple1(id), part.crack[i]);
    EXPECT_EQ(cells->GetArray("age")->GetTuple1(id), part.age[i]);
    EXPECT_EQ(cells->GetArray("contact_state")->GetTuple1(id), part.contact_state[i]);
    EXPECT_EQ(cells->GetArray("normal_traction")->GetTuple1(id), part.normal_traction[i]);
    EXPECT_EQ(cells->GetArray("tangential_traction")->GetTuple1(id), part.tangential_traction[i]);
  }
}

TEST(OutputVtu, JoinsTheRanksOfAStep) {
  const ScratchFolder folder;
  // The second of three ranks has nothing to draw.
  write_vtu(folder / piece_file(12, 0), sample_fields(0, 0.0));
  write_vtu(folder / piece_file(12, 1), FieldPart{});
  write_vtu(folder / piece_file(12, 2), sample_fields(2, 2.0));
  write_text(folder / step_file(12), pvtu_text(field_arrays(), 12, 3));
  const auto grid = read_step(folder / step_file(12));
  expect_arrays(grid, field_arrays());
  ASSERT_EQ(grid->GetNumberOfCells(), 6);
  ASSERT_EQ(grid->GetNumberOfPoints(), 20);
  auto* owner = grid->GetCellData()->GetArray("owner");
  EXPECT_EQ(owner->GetTuple1(0), 0);
  EXPECT_EQ(owner->GetTuple1(5), 2);
  EXPECT_EQ(grid->GetPoint(19)[0], 4.0);
}

TEST(OutputVtu, FirstRankMayBeTheEmptyOne) {
  const ScratchFolder folder;
  write_vtu(folder / piece_file(1, 0), CrackPart{});
  write_vtu(folder / piece_file(1, 1), sample_cracks());
  write_text(folder / step_file(1), pvtu_text(crack_arrays(), 1, 2));
  const auto grid = read_step(folder / step_file(1));
  expect_arrays(grid, crack_arrays());
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetCellData()->GetArray("crack")->GetTuple1(1), 3);
}

TEST(OutputVtu, EmptyPartsAreSoundFiles) {
  const ScratchFolder folder;
  write_vtu(folder / "f.vtu", FieldPart{});
  write_vtu(folder / "c.vtu", CrackPart{});
  for (const auto* name : {"f.vtu", "c.vtu"}) {
    const auto grid = read_piece(folder / name);
    EXPECT_EQ(grid->GetNumberOfCells(), 0);
    EXPECT_EQ(grid->GetNumberOfPoints(), 0);
  }
}

TEST(OutputVtu, UsesTheFormThatParaViewCanRead) {
  const ScratchFolder folder;
  write_vtu(folder / "a.vtu", sample_fields(0, 0.0));
  const std::string text = text_of(folder / "a.vtu");
  EXPECT_NE(text.find("format=\"binary\""), std::string::npos);
  EXPECT_NE(text.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(text.find("compressor=\"vtkZLibDataCompressor\""), std::string::npos);
  EXPECT_EQ(text.find("AppendedData"), std::string::npos);
}

TEST(OutputVtu, LargePartsSurvive) {
  const ScratchFolder folder;
  // Several of VTK's compression blocks: 40000 squares with points of their own.
  FieldPart part;
  for (int p = 0; p < 40000; ++p) {
    const double x = p % 200;
    const double y = p / 200;
    part.points.insert(part.points.end(), {x, y, x + 1, y, x + 1, y + 1, x, y + 1});
    for (int k = 0; k < 8; ++k) part.displacement.push_back(1e-6 * p + k);
    for (int k = 0; k < 4; ++k) part.connectivity.push_back(4 * p + k);
    part.offsets.push_back(4 * p + 4);
    part.stress.insert(part.stress.end(), {1.0 * p, 2.0 * p, 3.0 * p, 4.0 * p});
    part.principal.insert(part.principal.end(), {5.0 * p, 6.0 * p});
    part.young.push_back(1e9);
    part.element.push_back(p);
  }
  part.kind.assign(40000, 0);
  part.pieces.assign(40000, 1);
  part.owner.assign(40000, 0);
  write_vtu(folder / "a.vtu", part);
  const auto grid = read_piece(folder / "a.vtu");
  ASSERT_EQ(grid->GetNumberOfCells(), 40000);
  int wrong = 0;
  for (vtkIdType p = 0; p < 40000; ++p) {
    const auto i = static_cast<std::size_t>(p);
    wrong += grid->GetCellData()->GetArray("stress")->GetComponent(p, 3) != part.stress[4 * i + 3];
    wrong += grid->GetPointData()->GetArray("displacement")->GetComponent(4 * p + 3, 1) !=
             part.displacement[8 * i + 7];
  }
  EXPECT_EQ(wrong, 0);
}

TEST(OutputVtu, RefusesListsThatDoNotFit) {
  const ScratchFolder folder;
  FieldPart part = sample_fields(0, 0.0);
  part.young.pop_back();
  EXPECT_THROW(write_vtu(folder / "a.vtu", part), IoError);
  part = sample_fields(0, 0.0);
  part.connectivity.back() = 10;
  EXPECT_THROW(write_vtu(folder / "a.vtu", part), IoError);
  part = sample_fields(0, 0.0);
  part.displacement.resize(18);
  EXPECT_THROW(write_vtu(folder / "a.vtu", part), IoError);
  CrackPart cracks = sample_cracks();
  cracks.points.resize(6);
  EXPECT_THROW(write_vtu(folder / "c.vtu", cracks), IoError);
}

TEST(OutputVtu, SaysWhichFileItCannotWrite) {
  const ScratchFolder folder;
  const auto file = folder / "missing" / "a.vtu";
  try {
    write_vtu(file, sample_fields(0, 0.0));
    FAIL() << "there is no folder to write into";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace cdca
