// SPDX-License-Identifier: BSD-3-Clause
#include "legend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace kappa::view_detail {
namespace {

constexpr int kBarColours = 256;
constexpr Rgb kLine{90, 94, 100};

/// Looks of a legend's texts.
struct Looks {
  TextLook title, normal, small;
  explicit Looks(const LegendPlace& place) {
    const auto size = [&](double pixels) { return std::max(9, static_cast<int>(std::lround(pixels * place.scale))); };
    title = {size(25), place.text, Align::Left, Weight::Bold};
    normal = {size(22), place.text, Align::Left, Weight::Normal};
    const auto towards_grey = [](std::uint8_t c) { return static_cast<std::uint8_t>((2 * c + 128) / 3); };
    small = {size(18), {towards_grey(place.text.r), towards_grey(place.text.g), towards_grey(place.text.b)}};
  }
};

std::size_t line_count(const std::string& text) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// The bar itself in the rectangle, with a point at an end that is clipped.
void draw_bar(Panel& panel, const std::vector<Vec2>& box, ColourMap map, bool low_clipped, bool high_clipped) {
  const double x0 = box[0].x(), x1 = box[2].x(), y0 = box[0].y(), y1 = box[2].y();
  const double middle = 0.5 * (x0 + x1), tip = 0.8 * (x1 - x0);
  std::vector<std::vector<Vec2>> parts;
  std::vector<Rgb> colours;
  for (int i = 0; i < kBarColours; ++i) {
    const double a = y0 + (y1 - y0) * i / kBarColours, b = y0 + (y1 - y0) * (i + 1) / kBarColours;
    parts.push_back(rectangle(x0, a, x1, b));
    colours.push_back(map_colour(map, (i + 0.5) / kBarColours));
  }
  std::vector<Vec2> border = {Vec2(x0, y1), Vec2(x0, y0)};
  if (low_clipped) {
    parts.push_back({Vec2(x0, y0), Vec2(middle, y0 - tip), Vec2(x1, y0)});
    colours.push_back(map_colour(map, 0));
    border.emplace_back(middle, y0 - tip);
  }
  border.insert(border.end(), {Vec2(x1, y0), Vec2(x1, y1)});
  if (high_clipped) {
    parts.push_back({Vec2(x0, y1), Vec2(x1, y1), Vec2(middle, y1 + tip)});
    colours.push_back(map_colour(map, 1));
    border.emplace_back(middle, y1 + tip);
  }
  border.emplace_back(x0, y1);
  panel.fill(parts, colours);
  panel.outline(border, kLine);
}

void draw_ticks(Panel& panel, const std::vector<Vec2>& box, const ColourRange& range, double scale,
                const TextLook& look) {
  const std::vector<double> ticks = round_ticks(range);
  const std::vector<std::string> texts = tick_texts(ticks);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double t = (ticks[i] - range.low) / (range.high - range.low);
    const double y = box[0].y() + t * (box[2].y() - box[0].y());
    panel.outline({Vec2(box[2].x(), y), Vec2(box[2].x() + 8 * scale, y)}, kLine);
    panel.text(Vec2(box[2].x() + 14 * scale, y), texts[i], look);
  }
}

void draw_swatch(Panel& panel, double x, double y, double size, Rgb colour) {
  std::vector<Vec2> box = rectangle(x, y - 0.5 * size, x + size, y + 0.5 * size);
  panel.fill({box}, {colour});
  box.push_back(box.front());
  panel.outline(box, kLine);
}

}  // namespace

FieldFacts field_facts(const std::vector<double>& values, const std::vector<Vec3>& points) {
  FieldFacts facts;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = values[i];
    if (!is_finite(points[i])) continue;
    if (!std::isfinite(v)) {
      ++facts.no_value;
      continue;
    }
    facts.min = facts.values == 0 ? v : std::min(facts.min, v);
    facts.max = facts.values == 0 ? v : std::max(facts.max, v);
    ++facts.values;
  }
  return facts;
}

void draw_colour_bar(Panel& panel, const LegendPlace& place, const ScalarStyle& style, const ColourRange& range,
                     const FieldFacts& facts) {
  const double s = place.scale, left = 24 * s;
  const Looks looks(place);
  const int width = place.width - static_cast<int>(36 * s);
  const std::string title = wrap(style.name, width, looks.title);
  const double title_lines = static_cast<double>(line_count(title));
  const double title_y = place.height - 70 * s;
  panel.text(Vec2(left, title_y), title, looks.title);
  const double unit_y = title_y - 31 * s * title_lines;
  if (!style.unit.empty()) panel.text(Vec2(left, unit_y), style.unit, looks.normal);

  const bool low = facts.values > 0 && facts.min<range.low, high = facts.values> 0 && facts.max > range.high;
  const double top = unit_y - 95 * s, bottom = 170 * s;
  const std::vector<Vec2> box = rectangle(left, bottom, left + 34 * s, top);
  draw_bar(panel, box, style.map, low, high);
  draw_ticks(panel, box, range, s, looks.normal);
  if (high) panel.text(Vec2(left + 48 * s, top + 30 * s), "max " + three_digits(facts.max), looks.small);
  if (low) panel.text(Vec2(left + 48 * s, bottom - 30 * s), "min " + three_digits(facts.min), looks.small);
  if (facts.no_value > 0) {
    draw_swatch(panel, left, 72 * s, 30 * s, kNoValueColour);
    panel.text(Vec2(left + 46 * s, 72 * s), "no value", looks.normal);
    panel.text(Vec2(left + 46 * s, 44 * s), percent(facts.no_value, facts.no_value + facts.values), looks.small);
  }
}

void draw_label_legend(Panel& panel, const LegendPlace& place, const std::vector<Label>& labels) {
  std::array<std::size_t, kLabelCount> counts{};
  for (const Label label : labels) ++counts[static_cast<std::size_t>(label)];
  const double s = place.scale, left = 24 * s;
  const Looks looks(place);
  double y = place.height - 70 * s;
  panel.text(Vec2(left, y), "surface kind", looks.title);
  y -= 62 * s;
  for (int i = 1; i <= kLabelCount; ++i) {
    const auto label = static_cast<std::size_t>(i % kLabelCount);  // Undefined comes last
    if (counts[label] == 0) continue;
    draw_swatch(panel, left, y - 13 * s, 40 * s, label_colour(static_cast<Label>(label)));
    panel.text(Vec2(left + 54 * s, y), name(static_cast<Label>(label)), looks.normal);
    panel.text(Vec2(left + 54 * s, y - 28 * s), percent(counts[label], labels.size()), looks.small);
    y -= 78 * s;
  }
}

std::string percent(std::size_t part, std::size_t whole) {
  const double share = whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  if (part > 0 && share < 0.1) return "< 0.1 %";
  if (part < whole && share > 99.9) return "> 99.9 %";
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", share);
  return text;
}

}  // namespace kappa::view_detail
