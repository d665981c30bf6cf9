// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkActor.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>
#include <vector>

#include "camera.hpp"
#include "kappa/scan/scan.hpp"
#include "kappa/view/figure.hpp"
#include "legend.hpp"
#include "shape.hpp"

class vtkRenderWindow;

namespace kappa::view_detail {

struct SceneOptions {
  Rgb background{237, 240, 244};
  double point_size = 0;           ///< as in FigureOptions, but in pixels of the window
  std::optional<Shading> shading;  ///< empty: as in FigureOptions
  Camera camera;
  double line_width = 1;  ///< of edges and directions, in pixels of the window
};

/// A scan in colours on the left of a window and its legend in a strip on the right. Figures and the viewer draw it. It
/// refers to the scan, which must outlive it. Methods with an Execution throw Cancelled; the scene is then incomplete.
class Scene {
 public:
  Scene(const Scan& scan, const SceneOptions& options, const Execution& run);

  void add_to(vtkRenderWindow* window);
  /// Divides a window of that size in pixels between the picture and the legend. Text is 22 `scale` pixels high. The
  /// upper `top` and the lower `bottom` pixels of the picture are kept free of data.
  void layout(int width, int height, double scale, double top, double bottom);
  /// Moves the camera to where all data are seen, if its zoom is 1.
  void look(const Camera& camera);

  void show_values(const std::vector<double>& values, const ScalarStyle& style, const ColourRange& range,
                   const Execution& run);
  /// Gives the values shown the colours of another range.
  void change_range(const ColourRange& range);
  void show_labels(const std::vector<Label>& labels, const Execution& run);
  /// Shows the scan alone, in one colour, with an empty legend.
  void show_plain(const Execution& run);
  void show_edges(Edges edges, const Execution& run);
  /// Shows some directions in place of those shown before; fields that have not one direction a point are left out.
  void show_directions(const DirectionFields& fields, Directions which, const Execution& run);

  vtkRenderer* picture() { return picture_; }
  /// Colour of text that can be read on the background.
  Rgb text_colour() const;

 private:
  void show_layers(const std::vector<Layer>& layers);
  vtkSmartPointer<vtkActor> make_actor(const Layer& layer) const;
  void set_material(vtkProperty* property) const;
  void add_directions(const std::vector<Vec3>& directions, Rgb colour, const Execution& run);
  void draw_legend();

  const Scan& scan_;
  SceneOptions options_;
  Shape shape_;
  vtkNew<vtkRenderer> picture_, strip_;
  vtkNew<vtkLookupTable> colours_;
  std::unique_ptr<Panel> legend_;
  std::vector<vtkSmartPointer<vtkActor>> actors_, directions_;
  vtkSmartPointer<vtkActor> edges_;

  enum class Shown { Plain, Values, Labels } shown_ = Shown::Plain;
  ScalarStyle style_;
  ColourRange range_;
  FieldFacts facts_;
  std::vector<Label> labels_;
  int width_ = 1, height_ = 1;
  double scale_ = 1, top_ = 0, bottom_ = 0;
};

}  // namespace kappa::view_detail
