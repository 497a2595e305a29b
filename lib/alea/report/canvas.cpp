#include "alea/report/canvas.hpp"

#include <opencv2/imgproc.hpp>

namespace alea {
namespace {

constexpr int sub_pixel_bits = 4;
constexpr int font = cv::FONT_HERSHEY_SIMPLEX;
constexpr double font_height_px = 22;  // of a capital at scale 1

cv::Scalar scalar(Rgb colour) {
  return {static_cast<double>(colour.red), static_cast<double>(colour.green),
          static_cast<double>(colour.blue)};
}

cv::Point fixed_point(const Eigen::Vector2d& p) {
  const double scale = 1 << sub_pixel_bits;
  // Far off the sheet a coordinate would no longer fit its integer.
  const Eigen::Vector2d held = p.cwiseMax(-1e5).cwiseMin(1e5);
  return {cvRound(held.x() * scale), cvRound(held.y() * scale)};
}

cv::Point whole_point(const Eigen::Vector2d& p) {
  const Eigen::Vector2d held = p.cwiseMax(-1e6).cwiseMin(1e6);
  return {cvRound(held.x()), cvRound(held.y())};
}

void put_text(cv::Mat& sheet, const cv::Point& at, const std::string& words,
              const TextStyle& style) {
  const double scale = style.height_px / font_height_px;
  if (style.halo)
    cv::putText(sheet, words, at, font, scale, scalar(colours::white), 4, cv::LINE_AA);
  cv::putText(sheet, words, at, font, scale, scalar(style.colour), 1, cv::LINE_AA);
}

}  // namespace

struct Canvas::Sheet {
  cv::Mat pixels;
};

Canvas::Canvas(int width, int height, Rgb background) : sheet_(std::make_unique<Sheet>()) {
  sheet_->pixels = cv::Mat(height, width, CV_8UC3, scalar(background));
}

Canvas::~Canvas() = default;

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour, int width) {
  cv::line(sheet_->pixels, fixed_point(from), fixed_point(to), scalar(colour), width, cv::LINE_AA,
           sub_pixel_bits);
}

void Canvas::arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour, int width) {
  const Eigen::Vector2d along = to - from;
  line(from, to, colour, width);
  if (along.norm() < 1) return;
  const Eigen::Vector2d back = -along.normalized() * (5.0 + 2.0 * width);
  const Eigen::Vector2d side(-0.4 * back.y(), 0.4 * back.x());
  const std::array<Eigen::Vector2d, 3> head{to, to + back + side, to + back - side};
  polygon(head, colour);
}

void Canvas::disc(const Eigen::Vector2d& centre, double radius, Rgb colour) {
  cv::circle(sheet_->pixels, fixed_point(centre), cvRound(radius * (1 << sub_pixel_bits)),
             scalar(colour), cv::FILLED, cv::LINE_AA, sub_pixel_bits);
}

void Canvas::circle(const Eigen::Vector2d& centre, double radius, Rgb colour, int width) {
  cv::circle(sheet_->pixels, fixed_point(centre), cvRound(radius * (1 << sub_pixel_bits)),
             scalar(colour), width, cv::LINE_AA, sub_pixel_bits);
}

void Canvas::polygon(std::span<const Eigen::Vector2d> corners, Rgb colour) {
  std::vector<cv::Point> fixed;
  for (const Eigen::Vector2d& corner : corners) fixed.push_back(fixed_point(corner));
  cv::fillConvexPoly(sheet_->pixels, fixed, scalar(colour), cv::LINE_AA, sub_pixel_bits);
}

void Canvas::box(const Eigen::Vector2d& low, const Eigen::Vector2d& high, Rgb colour) {
  cv::rectangle(sheet_->pixels, whole_point(low), whole_point(high), scalar(colour), cv::FILLED);
}

void Canvas::text(const Eigen::Vector2d& at, const std::string& words, const TextStyle& style) {
  int below = 0;
  const cv::Size size = cv::getTextSize(words, font, style.height_px / font_height_px, 1, &below);
  const double share = style.anchor == TextAnchor::left     ? 0.0
                       : style.anchor == TextAnchor::centre ? 0.5
                                                            : 1.0;
  const double half_px = style.height_px / 2;
  if (!style.upright) {
    put_text(sheet_->pixels, whole_point(at + Eigen::Vector2d(-share * size.width, half_px)), words,
             style);
    return;
  }
  // OpenCV writes from left to right only: turn the sheet, write, and turn it back.
  cv::Mat turned;
  cv::rotate(sheet_->pixels, turned, cv::ROTATE_90_CLOCKWISE);
  const Eigen::Vector2d there(height() - at.y(), at.x());
  put_text(turned, whole_point(there + Eigen::Vector2d(-share * size.width, half_px)), words,
           style);
  cv::rotate(turned, sheet_->pixels, cv::ROTATE_90_COUNTERCLOCKWISE);
}

void Canvas::pixel(int x, int y, Rgb colour) {
  if (x < 0 || y < 0 || x >= width() || y >= height()) return;
  sheet_->pixels.at<cv::Vec3b>(y, x) = {colour.red, colour.green, colour.blue};
}

void Canvas::paste(const Picture& picture, int x, int y) {
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
      pixel(x + column, y + row, picture.at(column, row));
}

int Canvas::width() const {
  return sheet_->pixels.cols;
}

int Canvas::height() const {
  return sheet_->pixels.rows;
}

Picture Canvas::picture() const {
  const cv::Mat& pixels = sheet_->pixels;
  return {pixels.cols, pixels.rows,
          std::vector<std::uint8_t>(pixels.data, pixels.data + pixels.total() * 3)};
}

}  // namespace alea
