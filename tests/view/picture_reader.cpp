// SPDX-License-Identifier: BSD-3-Clause
#include "picture_reader.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace kappa::test {

int Picture::count(int x0, int y0, int x1, int y1, const std::function<bool(Rgb)>& condition) const {
  int found = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) found += condition(at(x, y)) ? 1 : 0;
  }
  return found;
}

Picture read_picture(const std::string& path) {
  vtkNew<vtkPNGReader> reader;
  EXPECT_EQ(1, std::filesystem::exists(path) ? reader->CanReadFile(path.c_str()) > 0 : 0) << path;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  Picture picture;
  picture.width = image->GetDimensions()[0];
  picture.height = image->GetDimensions()[1];
  EXPECT_EQ(3, image->GetNumberOfScalarComponents());
  const auto* bytes = static_cast<const unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i, bytes += 3) {
    picture.pixels.push_back({bytes[0], bytes[1], bytes[2]});
  }
  return picture;
}

int difference(Rgb a, Rgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

int differing_pixels(const Picture& a, const Picture& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  int found = 0;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) {
    found += same(a.pixels[i], b.pixels[i]) ? 0 : 1;
  }
  return found;
}

std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "kappa-view-XXXXXX").string();
  EXPECT_NE(nullptr, mkdtemp(name.data()));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::filesystem::remove_all(path_);
}

std::size_t TemporaryFolder::file_count() const {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
}

}  // namespace kappa::test
