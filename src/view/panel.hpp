// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

#include "kappa/core/labels.hpp"
#include "kappa/core/types.hpp"

class vtkActor2D;
class vtkRenderer;
class vtkTextActor;

namespace kappa::view_detail {

enum class Align { Left, Centre, Right };
enum class Weight { Normal, Bold };

struct TextLook {
  int size = 22;  ///< pixels
  Rgb colour{30, 32, 36};
  Align align = Align::Left;
  Weight weight = Weight::Normal;
};

/// Flat drawing on a renderer, in pixels from the lower left corner of its viewport.
class Panel {
 public:
  explicit Panel(vtkRenderer* renderer);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  void clear();
  /// Fills convex polygons; polygon i has colour i.
  void fill(const std::vector<std::vector<Vec2>>& polygons, const std::vector<Rgb>& colours);
  /// Draws a line of one pixel width through the points, in their order.
  void outline(const std::vector<Vec2>& line, Rgb colour);
  /// Writes text. The first line is centred on the height of `at`, further lines follow below.
  void text(const Vec2& at, const std::string& text, const TextLook& look);

 private:
  vtkRenderer* renderer_;
  std::vector<vtkSmartPointer<vtkActor2D>> actors_;
};

/// A text actor with the fonts of the panels. Its position is the upper left corner of the text.
vtkSmartPointer<vtkTextActor> make_text(const TextLook& look);

/// Width of a text in pixels.
int text_width(const std::string& text, const TextLook& look);

/// `text` with some blanks replaced by line breaks. A line is wider than `width` pixels only if it is a single word.
std::string wrap(const std::string& text, int width, const TextLook& look);

/// The first of `entries`, as many as fit on one line of `width` pixels, with gaps between them.
std::string fit(const std::vector<std::string>& entries, int width, const TextLook& look);

/// Corners of a rectangle, counter-clockwise from the lower left.
std::vector<Vec2> rectangle(double x0, double y0, double x1, double y1);

}  // namespace kappa::view_detail
