#include "alea/markerless/wall_correlation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <opencv2/core.hpp>

namespace alea {
namespace {

/// Points of vertical surfaces seen from above, upright frame.
struct WallPoint {
  Eigen::Vector2d place_m;
  std::complex<float> facing;
};

std::vector<WallPoint> wall_points(const PreparedScan& scan) {
  std::vector<WallPoint> points;
  for (std::size_t i = 0; i < scan.fine.size(); ++i) {
    const Eigen::Vector3d n = scan.upright_from_scan * scan.fine.normals[i].cast<double>();
    if (std::abs(n.z()) > 0.5) continue;
    const Eigen::Vector3d p = scan.upright_from_scan * scan.fine.positions[i];
    const Eigen::Vector2f facing = n.head<2>().normalized().cast<float>();
    points.push_back({p.head<2>(), {facing.x(), facing.y()}});
  }
  return points;
}

double reach_m(const std::vector<WallPoint>& points) {
  std::vector<double> reach;
  for (const WallPoint& p : points) reach.push_back(p.place_m.norm());
  if (reach.empty()) return 0;
  const auto at = reach.begin() + static_cast<long>(reach.size() * 95 / 100);
  std::nth_element(reach.begin(), at, reach.end());
  return *at;
}

struct Raster {
  int cells;
  double cell_m;
  double shift_m(int cell) const { return cell_m * (cell >= cells / 2 ? cell - cells : cell); }
};

/// How two surfaces count whose normals differ by an angle d: (1 + cos d)^2 / 4, by its Fourier
/// series. The two faces of a wall count nothing, neither for nor against: from inside and outside
/// of a building the true pose has nothing but such pairs on its walls.
constexpr std::array<float, 3> harmonics{0.375F, 0.5F, 0.125F};

/// One image for each harmonic: sums of exp(i k facing) of the points turned by `yaw`. High walls
/// count by the root of their points, so that one facade does not outvote everything else.
using Images = std::array<cv::Mat, harmonics.size()>;

Images images_of(const std::vector<WallPoint>& points, double yaw, const Raster& raster) {
  Images images;
  for (cv::Mat& image : images) image = cv::Mat::zeros(raster.cells, raster.cells, CV_32FC2);
  const double c = std::cos(yaw), s = std::sin(yaw);
  const std::complex<float> turn(static_cast<float>(c), static_cast<float>(s));
  for (const WallPoint& p : points) {
    const double x = c * p.place_m.x() - s * p.place_m.y();
    const double y = s * p.place_m.x() + c * p.place_m.y();
    const int column = static_cast<int>(std::floor(x / raster.cell_m)) + raster.cells / 2;
    const int row = static_cast<int>(std::floor(y / raster.cell_m)) + raster.cells / 2;
    if (column < 0 || column >= raster.cells || row < 0 || row >= raster.cells) continue;
    const std::complex<float> facing = p.facing * turn;
    std::complex<float> power = 1;
    for (cv::Mat& image : images) {
      image.at<cv::Vec2f>(row, column) += cv::Vec2f(power.real(), power.imag());
      power *= facing;
    }
  }
  for (int row = 0; row < raster.cells; ++row)
    for (int column = 0; column < raster.cells; ++column) {
      const float count = images[0].at<cv::Vec2f>(row, column)[0];
      if (!(count > 0)) continue;
      for (cv::Mat& image : images) image.at<cv::Vec2f>(row, column) *= 1 / std::sqrt(count);
    }
  return images;
}

Images spectra_of(const Images& images) {
  Images spectra;
  for (std::size_t k = 0; k < images.size(); ++k) cv::dft(images[k], spectra[k]);
  return spectra;
}

/// Real part of the circular correlation: cell (dy, dx) for the shift that moves `moving`.
cv::Mat correlation(const Images& fixed_spectra, const Images& moving_spectra) {
  cv::Mat sum = cv::Mat::zeros(fixed_spectra[0].size(), CV_32FC2), product, back, real;
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    cv::mulSpectrums(fixed_spectra[k], moving_spectra[k], product, 0, true);
    cv::scaleAdd(product, harmonics[k], sum, sum);
  }
  cv::idft(sum, back, cv::DFT_SCALE);
  cv::extractChannel(back, real, 0);
  return real;
}

struct Peak {
  float value;
  int row, column;
};

std::vector<Peak> highest_peaks(const cv::Mat& correlation, int count) {
  constexpr int reach = 2;  // cells: nearer ones are one peak
  const int n = correlation.rows;
  std::vector<Peak> peaks;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const float value = correlation.at<float>(row, column);
      if (static_cast<int>(peaks.size()) == count && value <= peaks.back().value) continue;
      bool highest = value > 0;
      for (int dr = -reach; dr <= reach && highest; ++dr)
        for (int dc = -reach; dc <= reach; ++dc)
          if ((dr != 0 || dc != 0) &&
              correlation.at<float>((row + dr + n) % n, (column + dc + n) % n) > value)
            highest = false;
      if (!highest) continue;
      const auto place =
          std::find_if(peaks.begin(), peaks.end(), [&](const Peak& p) { return p.value < value; });
      peaks.insert(place, {value, row, column});
      if (static_cast<int>(peaks.size()) > count) peaks.pop_back();
    }
  return peaks;
}

double energy(const Images& images) {
  double sum = 0;
  for (std::size_t k = 0; k < images.size(); ++k)
    sum += harmonics[k] * cv::norm(images[k], cv::NORM_L2SQR);
  return std::sqrt(sum);
}

}  // namespace

struct WallCorrelation::Data {
  Raster raster{};
  std::vector<WallPoint> moving;
  Images fixed_spectra;
  double fixed_energy = 0;
};

WallCorrelation::WallCorrelation(const PreparedScan& fixed, const PreparedScan& moving,
                                 const WallCorrelationOptions& options) {
  auto data = std::make_unique<Data>();
  const std::vector<WallPoint> of_fixed = wall_points(fixed);
  data->moving = wall_points(moving);
  Raster raster{options.image_cells, options.cell_m};
  const double reach = std::max(reach_m(of_fixed), reach_m(data->moving));
  if (2 * reach > raster.cells * raster.cell_m) raster.cells *= 2;
  raster.cell_m = std::max(raster.cell_m, 2 * reach / raster.cells);
  data->raster = raster;
  const Images images = images_of(of_fixed, 0, raster);
  data->fixed_spectra = spectra_of(images);
  data->fixed_energy = energy(images);
  data_ = std::move(data);
}

WallCorrelation::~WallCorrelation() = default;

std::vector<WallShift> WallCorrelation::best(double yaw_rad, int count) const {
  const Images images = images_of(data_->moving, yaw_rad, data_->raster);
  const double most = data_->fixed_energy * energy(images);
  if (!(most > 0)) return {};
  const cv::Mat response = correlation(data_->fixed_spectra, spectra_of(images));
  std::vector<WallShift> shifts;
  for (const Peak& peak : highest_peaks(response, count))
    shifts.push_back(
        {{data_->raster.shift_m(peak.column), data_->raster.shift_m(peak.row)}, peak.value / most});
  return shifts;
}

}  // namespace alea
