// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/view/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>

#include "kappa/core/error.hpp"
#include "kappa/core/percentiles.hpp"
#include "kappa/core/types.hpp"

namespace kappa {
namespace {

/// CIELAB, D65.
struct Lab {
  double l, a, b;
};

double lab_inverse(double t) {
  constexpr double kKnee = 6.0 / 29.0;
  return t > kKnee ? t * t * t : 3 * kKnee * kKnee * (t - 4.0 / 29.0);
}

std::uint8_t srgb_byte(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

Rgb to_srgb(const Lab& c) {
  const double fy = (c.l + 16) / 116;
  const double x = 0.95047 * lab_inverse(fy + c.a / 500);
  const double y = lab_inverse(fy);
  const double z = 1.08883 * lab_inverse(fy - c.b / 200);
  return {srgb_byte(3.2406 * x - 1.5372 * y - 0.4986 * z), srgb_byte(-0.9689 * x + 1.8758 * y + 0.0415 * z),
          srgb_byte(0.0557 * x - 0.2040 * y + 1.0570 * z)};
}

/// From the neutral colour (side = 0) to blue (sign < 0) or red (sign > 0) at side = 1. In the spherical form of
/// CIELAB (magnitude, saturation, hue) a straight line has even steps; the hue turns a little on its way because the
/// neutral colour is lighter than the ends.
Lab diverging_lab(int sign, double side) {
  constexpr double kEnd = 80, kNeutral = 88, kSaturation = 1.08;
  const double hue_end = sign < 0 ? -1.1 : 0.5;
  const double spin = kSaturation * std::sqrt(kNeutral * kNeutral - kEnd * kEnd) / (kEnd * std::sin(kSaturation));
  const double hue_neutral = sign < 0 ? hue_end - spin : hue_end + spin;
  const double m = kNeutral + side * (kEnd - kNeutral);
  const double s = side * kSaturation;
  const double h = hue_neutral + side * (hue_end - hue_neutral);
  return {m * std::cos(s), m * std::sin(s) * std::cos(h), m * std::sin(s) * std::sin(h)};
}

/// Lightness grows evenly while the hue turns from violet over green to yellow.
Lab sequential_lab(double t) {
  const double hue = (312 - 214 * t) * kPi / 180;
  const double chroma = 46 - 88 * t + 118 * t * t;  // kept inside sRGB
  return {18 + 74 * t, chroma * std::cos(hue), chroma * std::sin(hue)};
}

double percentile(std::vector<double>& sorted, double p) {
  const double at = p / 100 * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const double low = sorted[i], high = sorted[std::min(i + 1, sorted.size() - 1)];
  return low + (at - static_cast<double>(i)) * (high - low);
}

void validate_style(const ScalarStyle& style) {
  if (style.range &&
      !(std::isfinite(style.range->low) && std::isfinite(style.range->high) && style.range->low < style.range->high)) {
    throw Error(ErrorCode::InvalidArgument, "the colour range [" + std::to_string(style.range->low) + ", " +
                                                std::to_string(style.range->high) +
                                                "] needs finite ends with low < high");
  }
  if (!(style.percentile > 50 && style.percentile <= 100)) {
    throw Error(ErrorCode::InvalidArgument, "the percentile of the colour range is " +
                                                std::to_string(style.percentile) + "; choose one in (50, 100]");
  }
}

ColourRange diverging_range(std::vector<double>& values, double p) {
  for (double& v : values) v = std::abs(v);
  std::sort(values.begin(), values.end());
  double m = values.empty() ? 1.0 : percentile(values, p);
  // A field that is 0 almost everywhere still shows where it is not.
  if (m <= 0) m = values.back() > 0 ? values.back() : 1.0;
  return {-m, m};
}

ColourRange sequential_range(std::vector<double>& values, double p) {
  if (values.empty()) return {0, 1};
  std::sort(values.begin(), values.end());
  ColourRange range{percentile(values, 100 - p), percentile(values, p)};
  if (!(range.low < range.high)) range = {values.front(), values.back()};
  if (!(range.low < range.high)) {
    const double half = range.low == 0 ? 0.5 : 0.5 * std::abs(range.low);
    range = {range.low - half, range.high + half};
  }
  return range;
}

double first_tick(const ColourRange& range, double step) {
  return std::ceil(range.low / step - 1e-9);
}
double last_tick(const ColourRange& range, double step) {
  return std::floor(range.high / step + 1e-9);
}

/// The widest round step that gives enough ticks.
double round_step(const ColourRange& range) {
  constexpr double kFewest = 4;
  for (int power = static_cast<int>(std::ceil(std::log10(range.high - range.low)));; --power) {
    for (const double factor : {5.0, 2.0, 1.0}) {
      const double step = factor * std::pow(10.0, power);
      if (last_tick(range, step) - first_tick(range, step) + 1 >= kFewest) return step;
    }
  }
}

std::string fixed(int decimals, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// "2.0e-5" rather than "2.0e-05".
std::string scientific(int decimals, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*e", decimals, value);
  std::string text = buffer;
  const std::size_t e = text.find('e');
  std::size_t first = e + 2;
  while (first + 1 < text.size() && text[first] == '0') text.erase(first, 1);
  if (text[e + 1] == '+') text.erase(e + 1, 1);
  return text;
}

}  // namespace

Rgb map_colour(ColourMap map, double t) {
  t = std::clamp(t, 0.0, 1.0);
  if (map == ColourMap::Sequential) return to_srgb(sequential_lab(t));
  return to_srgb(diverging_lab(t < 0.5 ? -1 : 1, std::abs(2 * t - 1)));
}

ColourRange colour_range(const std::vector<double>& values, const ScalarStyle& style) {
  validate_style(style);
  if (style.range) return *style.range;
  std::vector<double> finite;
  finite.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
  return style.map == ColourMap::Diverging ? diverging_range(finite, style.percentile)
                                           : sequential_range(finite, style.percentile);
}

std::vector<double> round_ticks(const ColourRange& range) {
  const double step = round_step(range);
  std::vector<double> ticks;
  for (double i = first_tick(range, step); i <= last_tick(range, step); i += 1) {
    ticks.push_back(i == 0 ? 0.0 : i * step);  // never -0
  }
  return ticks;
}

std::vector<std::string> tick_texts(const std::vector<double>& ticks) {
  double largest = 0, step = 0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    largest = std::max(largest, std::abs(ticks[i]));
    if (i > 0) step = ticks[i] - ticks[i - 1];
  }
  const int step_power = step > 0 ? static_cast<int>(std::floor(std::log10(step) + 1e-9)) : 0;
  const bool exponent = largest > 0 && (largest >= 1e5 || largest < 1e-3);
  std::vector<std::string> texts;
  for (const double tick : ticks) {
    if (tick == 0 && exponent) {
      texts.push_back("0");
    } else if (exponent) {
      const int own = static_cast<int>(std::floor(std::log10(std::abs(tick)) + 1e-9));
      texts.push_back(scientific(std::max(0, own - step_power), tick));
    } else {
      texts.push_back(fixed(std::max(0, -step_power), tick));
    }
  }
  return texts;
}

}  // namespace kappa
