#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>

#include "alea/report/colours.hpp"
#include "alea/report/picture.hpp"

namespace alea {

/// Where a text sits about its anchor.
enum class TextAnchor { left, centre, right };

struct TextStyle {
  double height_px = 11;  ///< of a capital letter
  Rgb colour = colours::ink;
  TextAnchor anchor = TextAnchor::left;
  bool upright = false;  ///< turned a quarter to the left, for the name of a vertical axis
  bool halo = false;     ///< a white rim, for text on top of a picture
};

/// A white sheet to draw on. Coordinates are pixels, x to the right and y down, and may have
/// fractions; what lies off the sheet is cut away. Letters are ASCII.
class Canvas {
 public:
  Canvas(int width, int height, Rgb background = colours::white);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour, int width = 1);
  void arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour, int width = 2);
  void disc(const Eigen::Vector2d& centre, double radius, Rgb colour);
  void circle(const Eigen::Vector2d& centre, double radius, Rgb colour, int width = 1);
  void polygon(std::span<const Eigen::Vector2d> corners, Rgb colour);             ///< filled
  void box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Rgb colour);  ///< filled
  /// `at` is the middle of the text's height.
  void text(const Eigen::Vector2d& at, const std::string& words, const TextStyle& style = {});
  void pixel(int x, int y, Rgb colour);
  void paste(const Picture& picture, int x, int y);

  int width() const;
  int height() const;
  Picture picture() const;

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace alea
