// SPDX-License-Identifier: BSD-3-Clause
// Files exchanged with VTK, an independent reader and writer of VTP.
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include "kappa/scan/scan.hpp"
#include "support.hpp"

namespace kappa {
namespace {

constexpr vtkIdType kSide = 60;  // more points than one block of the compressed format holds

Vec3 grid_point(vtkIdType i) {
  const auto x = static_cast<double>(i % kSide), y = static_cast<double>(i / kSide);
  return {512700.123456789 + x, 5403547.987654321 + y, 0.01 * x * y};
}

void fill(vtkPolyData& data) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> normals;
  normals->SetName("MyNormals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkUnsignedCharArray> label;
  label->SetName("label");
  for (vtkIdType i = 0; i < kSide * kSide; ++i) {
    points->InsertNextPoint(grid_point(i).data());
    normals->InsertNextTuple3(0, 0.5, 1);
    label->InsertNextValue(static_cast<unsigned char>(i % 7));
  }
  vtkNew<vtkCellArray> quads;
  for (vtkIdType i = 0; i + kSide + 1 < kSide * kSide; ++i) {
    if (i % kSide + 1 < kSide) quads->InsertNextCell({i, i + 1, i + kSide + 1, i + kSide});
  }
  data.SetPoints(points);
  data.SetPolys(quads);
  data.GetPointData()->SetNormals(normals);
  data.GetPointData()->AddArray(label);
}

void expect_grid(const Scan& scan) {
  ASSERT_EQ(scan.points.size(), static_cast<std::size_t>(kSide * kSide));
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    ASSERT_EQ(test::position(scan, i), grid_point(static_cast<vtkIdType>(i))) << i;
  }
  ASSERT_EQ(scan.normals.size(), scan.points.size());
  EXPECT_EQ(scan.normals.back(), Vec3(0, 0.5, 1));
  ASSERT_EQ(scan.fields.size(), 1u);
  EXPECT_EQ(scan.fields[0].type, Field::Type::UInt8);
  EXPECT_EQ(scan.fields[0].values[8], 1);
  ASSERT_EQ(scan.faces.size(), static_cast<std::size_t>((kSide - 1) * (kSide - 1)));
  EXPECT_EQ(std::vector<Index>(scan.faces[0].begin(), scan.faces[0].end()), (std::vector<Index>{0, 1, 61, 60}));
}

class VtkWriterModes : public testing::TestWithParam<std::tuple<int, bool, bool, bool>> {};

TEST_P(VtkWriterModes, AreRead) {
  const auto [mode, compressed, base64, wide] = GetParam();
  const test::TemporaryFolder folder;
  vtkNew<vtkPolyData> data;
  fill(*data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(folder.file("a.vtp").c_str());
  writer->SetDataMode(mode);
  if (!compressed) writer->SetCompressorTypeToNone();
  writer->SetEncodeAppendedData(base64);
  writer->SetHeaderType(wide ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  ASSERT_EQ(writer->Write(), 1);
  expect_grid(read_scan(folder.file("a.vtp")));
}

INSTANTIATE_TEST_SUITE_P(All, VtkWriterModes,
                         testing::Combine(testing::Values(vtkXMLWriter::Ascii, vtkXMLWriter::Binary,
                                                          vtkXMLWriter::Appended),
                                          testing::Bool(), testing::Bool(), testing::Bool()));

TEST(VtkExchange, BigEndianIsRead) {
  const test::TemporaryFolder folder;
  vtkNew<vtkPolyData> data;
  fill(*data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(folder.file("a.vtp").c_str());
  writer->SetByteOrderToBigEndian();
  ASSERT_EQ(writer->Write(), 1);
  expect_grid(read_scan(folder.file("a.vtp")));
}

Scan small_mesh() {
  Scan scan;
  for (int i = 0; i < 5; ++i) scan.points.emplace_back(512700.123456789 + i, 5403547.987654321, i * i);
  scan.normals.assign(5, Vec3::UnitZ());
  scan.faces.add({0, 1, 2, 3, 4});
  scan.faces.add(0, 1, 2);
  for (const char* name : {"mean_curvature", "dir_min_x", "dir_min_y", "dir_min_z"}) {
    scan.fields.push_back({name, Field::Type::Float64, {0, 1, 2, 3, 4}});
  }
  scan.fields.push_back({"a<b & \"c\"", Field::Type::UInt16, {0, 1, 2, 3, 65535}});
  return scan;
}

TEST(VtkExchange, VtkReadsMeshes) {
  const test::TemporaryFolder folder;
  const Scan scan = small_mesh();
  write_scan(folder.file("a.vtp"), scan);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.file("a.vtp").c_str());
  reader->Update();
  vtkPolyData& data = *reader->GetOutput();
  ASSERT_EQ(data.GetNumberOfPoints(), 5);
  for (vtkIdType i = 0; i < 5; ++i) {
    EXPECT_EQ(Vec3(data.GetPoint(i)), scan.points[static_cast<std::size_t>(i)]);
  }
  ASSERT_EQ(data.GetNumberOfPolys(), 2);
  EXPECT_EQ(data.GetCell(0)->GetNumberOfPoints(), 5);
  EXPECT_EQ(data.GetCell(1)->GetPointId(2), 2);
  vtkPointData& arrays = *data.GetPointData();
  ASSERT_NE(arrays.GetNormals(), nullptr);
  EXPECT_EQ(arrays.GetNormals()->GetComponent(4, 2), 1);
  ASSERT_NE(arrays.GetArray("Mean_Curvature"), nullptr);
  ASSERT_NE(arrays.GetArray("dir_min"), nullptr);
  EXPECT_EQ(arrays.GetArray("dir_min")->GetNumberOfComponents(), 3);
  EXPECT_EQ(arrays.GetArray("dir_min")->GetComponent(3, 1), 3);
  ASSERT_NE(arrays.GetArray("a<b & \"c\""), nullptr);
  EXPECT_EQ(arrays.GetArray("a<b & \"c\"")->GetComponent(4, 0), 65535);
}

TEST(VtkExchange, VtkReadsCloudsAsVertices) {
  const test::TemporaryFolder folder;
  Scan scan = small_mesh();
  scan.faces.clear();
  write_scan(folder.file("a.vtp"), scan);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.file("a.vtp").c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), 5);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfVerts(), 5);
}

}  // namespace
}  // namespace kappa
