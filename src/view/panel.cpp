// SPDX-License-Identifier: BSD-3-Clause
#include "panel.hpp"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <sstream>

namespace kappa::view_detail {
namespace {

constexpr int kDpi = 72;  // at which VTK's font sizes are pixels

vtkIdType add_points(vtkPoints* points, const std::vector<Vec2>& line) {
  const vtkIdType first = points->GetNumberOfPoints();
  for (const Vec2& p : line) points->InsertNextPoint(p.x(), p.y(), 0);
  return first;
}

void add_cell(vtkCellArray* cells, vtkIdType first, std::size_t count) {
  cells->InsertNextCell(static_cast<int>(count));
  for (std::size_t i = 0; i < count; ++i) cells->InsertCellPoint(first + static_cast<vtkIdType>(i));
}

void apply(const TextLook& look, vtkTextProperty* property) {
  property->SetFontFamilyToArial();
  property->SetFontSize(look.size);
  property->SetColor(look.colour.r / 255.0, look.colour.g / 255.0, look.colour.b / 255.0);
  property->SetBold(look.weight == Weight::Bold ? 1 : 0);
  property->SetJustification(static_cast<int>(look.align));
  property->SetVerticalJustificationToTop();
  property->SetLineSpacing(1.15);
}

}  // namespace

Panel::Panel(vtkRenderer* renderer) : renderer_(renderer) {}

Panel::~Panel() {
  clear();
}

void Panel::clear() {
  for (const auto& actor : actors_) renderer_->RemoveActor2D(actor);
  actors_.clear();
}

void Panel::fill(const std::vector<std::vector<Vec2>>& polygons, const std::vector<Rgb>& colours) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> scalars;
  scalars->SetNumberOfComponents(3);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    add_cell(cells, add_points(points, polygons[i]), polygons[i].size());
    const unsigned char colour[3] = {colours[i].r, colours[i].g, colours[i].b};
    scalars->InsertNextTypedTuple(colour);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  data->GetCellData()->SetScalars(scalars);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUseCellData();
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  renderer_->AddActor2D(actor);
  actors_.push_back(actor);
}

void Panel::outline(const std::vector<Vec2>& line, Rgb colour) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  add_cell(cells, add_points(points, line), line.size());
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor2D>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.r / 255.0, colour.g / 255.0, colour.b / 255.0);
  renderer_->AddActor2D(actor);
  actors_.push_back(actor);
}

void Panel::text(const Vec2& at, const std::string& text, const TextLook& look) {
  const auto actor = make_text(look);
  actor->SetInput(text.c_str());
  // Centring on the height of a capital letter keeps one base line whatever the letters.
  actor->SetPosition(at.x(), at.y() + 0.40 * look.size);
  renderer_->AddActor2D(actor);
  actors_.emplace_back(actor);
}

vtkSmartPointer<vtkTextActor> make_text(const TextLook& look) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  apply(look, actor->GetTextProperty());
  return actor;
}

int text_width(const std::string& text, const TextLook& look) {
  vtkNew<vtkTextProperty> property;
  apply(look, property);
  int box[4] = {0, 0, 0, 0};
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, text, box, kDpi);
  return box[1] - box[0] + 1;
}

std::string wrap(const std::string& text, int width, const TextLook& look) {
  std::istringstream words(text);
  std::string all, line;
  for (std::string word; words >> word;) {
    const std::string longer = line.empty() ? word : line + " " + word;
    if (!line.empty() && text_width(longer, look) > width) {
      all += line + "\n";
      line = word;
    } else {
      line = longer;
    }
  }
  return all + line;
}

std::string fit(const std::vector<std::string>& entries, int width, const TextLook& look) {
  std::string line;
  for (const std::string& entry : entries) {
    const std::string longer = line.empty() ? entry : line + "      " + entry;
    if (text_width(longer, look) > width) break;
    line = longer;
  }
  return line;
}

std::vector<Vec2> rectangle(double x0, double y0, double x1, double y1) {
  return {Vec2(x0, y0), Vec2(x1, y0), Vec2(x1, y1), Vec2(x0, y1)};
}

}  // namespace kappa::view_detail
