#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "alea/report/canvas.hpp"

namespace alea {

/// The rectangle of a canvas that a panel may fill, labels included (pixels).
struct PanelArea {
  double left = 0;
  double top = 0;
  double width = 0;
  double height = 0;
};

/// The rectangle of a sheet with `columns` x `rows` equal panels that panel `number` fills, from
/// the upper left, row by row; `margin_px` between them.
PanelArea grid_panel(const Canvas& canvas, int columns, int rows, int number, double margin_px = 6);

struct AxesOptions {
  std::string title;
  std::string x_name;  ///< with its unit, e.g. "x (m)"
  std::string y_name;
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< shown at least
  Eigen::Vector2d high = Eigen::Vector2d::Ones();
  bool equal_scale = true;  ///< one unit is as long upwards as sideways
  bool grid = true;
  bool frame = true;     ///< false: no ticks, no frame, just the place
  bool whole_x = false;  ///< x counts things: ticks at whole numbers only
};

/// Axes in a panel: ticks at round numbers, and places in the data's own units; y points up.
class Axes {
 public:
  Axes(Canvas& canvas, const PanelArea& area, const AxesOptions& options);

  /// Pixel of a place.
  Eigen::Vector2d at(const Eigen::Vector2d& place) const;
  /// Place of a pixel.
  Eigen::Vector2d place(const Eigen::Vector2d& pixel) const;
  double pixels_per_x() const { return scale_.x(); }

  void points(std::span<const Eigen::Vector2d> places, Rgb colour, double radius_px = 1);
  void point(const Eigen::Vector2d& place, Rgb colour, double radius_px = 1);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour, int width_px = 1);
  void polyline(std::span<const Eigen::Vector2d> places, Rgb colour, int width_px = 1);
  void text(const Eigen::Vector2d& place, const std::string& words, const TextStyle& style = {});
  /// Names with a spot of their colour, in the upper right corner of the panel.
  void legend(const std::vector<std::pair<std::string, Rgb>>& entries);

  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }
  Canvas& canvas() { return *canvas_; }

 private:
  void draw_frame(const AxesOptions& options, const PanelArea& area);

  Canvas* canvas_;
  Eigen::Vector2d low_, high_;                // shown
  Eigen::Vector2d upper_left_, lower_right_;  // pixels
  Eigen::Vector2d scale_;                     // pixels per unit
};

/// Names with a spot of their colour, in a row that begins at a pixel.
void draw_legend_row(Canvas& canvas, const Eigen::Vector2d& at,
                     const std::vector<std::pair<std::string, Rgb>>& entries);

/// Round numbers in [low, high], about `count` of them; one step is 1, 2 or 5 times a power of ten.
std::vector<double> round_ticks(double low, double high, int count);

/// A bar that explains a colour scale: `names` at its lower end, middle and upper end.
void draw_colour_bar(Canvas& canvas, const PanelArea& area, Rgb (*colour)(double), double low,
                     double high, const std::vector<std::string>& names);

}  // namespace alea
