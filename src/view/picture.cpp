// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <unistd.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "kappa/core/error.hpp"

namespace kappa::view_detail {
namespace {

[[noreturn]] void cannot_write(const std::string& path, const std::string& reason) {
  throw Error(ErrorCode::FileWrite, "the picture '" + path + "' cannot be written: " + reason);
}

/// One row of the file from the rows of the window; `width` and `reduction` in pixels of the window.
void reduce_row(const unsigned char* in, int width, int reduction, unsigned char* out) {
  const int count = reduction * reduction;
  for (int x = 0; x < width / reduction; ++x) {
    for (int c = 0; c < 3; ++c) {
      int sum = count / 2;
      for (int k = 0; k < count; ++k) sum += in[(k / reduction * width + x * reduction + k % reduction) * 3 + c];
      *out++ = static_cast<unsigned char>(sum / count);
    }
  }
}

vtkSmartPointer<vtkImageData> reduce(vtkUnsignedCharArray* pixels, int width, int height, int reduction,
                                     const Execution& run) {
  constexpr std::size_t kRows = 16;  // polled once for so many rows of the file
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width / reduction, height / reduction, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* const out = static_cast<unsigned char*>(image->GetScalarPointer());
  const unsigned char* const in = pixels->GetPointer(0);
  const std::size_t row_in = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(reduction);
  const std::size_t row_out = 3 * static_cast<std::size_t>(width / reduction);
  parallel_for(static_cast<std::size_t>(height / reduction), kRows, run, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t y = begin; y < end; ++y) reduce_row(in + y * row_in, width, reduction, out + y * row_out);
  });
  return image;
}

void write_bytes(const std::string& path, vtkUnsignedCharArray* bytes) {
  const std::string temporary = path + ".part" + std::to_string(getpid());
  std::ofstream file(temporary, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->GetPointer(0)), bytes->GetNumberOfValues());
  file.close();
  std::error_code failure;
  if (file) std::filesystem::rename(temporary, path, failure);
  if (file && !failure) return;
  const std::string reason = failure ? failure.message() : std::strerror(errno);
  std::filesystem::remove(temporary, failure);
  cannot_write(path, reason);
}

}  // namespace

Quiet::Quiet() : before_(vtkObject::GetGlobalWarningDisplay()) {
  vtkObject::SetGlobalWarningDisplay(0);
}

Quiet::~Quiet() {
  vtkObject::SetGlobalWarningDisplay(before_);
}

void check_picture_path(const std::string& path) {
  const std::filesystem::path file(path);
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (file.extension() != ".png" && file.extension() != ".PNG") cannot_write(path, "pictures are PNG, name it .png");
  std::error_code failure;
  if (!std::filesystem::is_directory(folder, failure))
    cannot_write(path, "there is no folder '" + folder.string() + "'");
  if (std::filesystem::is_directory(file, failure)) cannot_write(path, "it is a folder");
  if (access(folder.c_str(), W_OK) != 0) cannot_write(path, std::strerror(errno));
}

void write_picture(const std::string& path, vtkRenderWindow* window, int reduction, const Execution& run) {
  check_cancelled(run);
  const int width = window->GetSize()[0], height = window->GetSize()[1];
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels);
  if (pixels->GetNumberOfValues() != static_cast<vtkIdType>(width) * height * 3) {
    throw Error(ErrorCode::Unavailable,
                "the display could not draw '" + path + "'; unset DISPLAY to draw on a virtual one");
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(reduce(pixels, width, height, reduction, stage(run, 0.0, 0.5)));
  writer->WriteToMemoryOn();
  writer->Write();
  check_cancelled(run);
  if (writer->GetResult() == nullptr) cannot_write(path, "it could not be encoded");
  write_bytes(path, writer->GetResult());
  if (run.progress) run.progress(1.0);
}

}  // namespace kappa::view_detail
