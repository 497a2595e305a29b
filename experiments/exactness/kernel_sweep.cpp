#include "experiments/exactness/kernel_sweep.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "alea/core/rigid_transform.hpp"
#include "alea/core/seed.hpp"
#include "experiments/engine/cpu_clock.hpp"
#include "experiments/exactness/kernel_chain.hpp"

namespace alea::experiments::exactness {
namespace {

constexpr std::uint32_t experiment_number = 42;
constexpr double edge_m = 0.5, range_m = 6;
constexpr double tilt_noise_rad = 5e-5, offset_noise_m = 5e-5;  // of planes fitted at 6 m

enum class DieKind { ordinary, near_parallel, near_coplanar };

/// Outward normals about the corner before the die is turned.
std::array<Eigen::Vector3d, 3> normals_of(DieKind kind, double angle_rad, RandomStream& random) {
  std::array<Eigen::Vector3d, 3> normals{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                         Eigen::Vector3d::UnitZ()};
  for (Eigen::Vector3d& normal : normals)
    normal = (normal + 0.007 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()))
                 .normalized();
  const double signed_angle = random.uniform() < 0.5 ? -angle_rad : angle_rad;
  if (kind == DieKind::near_parallel)
    normals[1] = (normals[0] + std::tan(signed_angle) * normals[1].cross(normals[2])).normalized();
  if (kind == DieKind::near_coplanar) {
    const Eigen::Vector3d out_of_plane = normals[0].cross(normals[1]).normalized();
    normals[2] = (normals[0] + normals[1] + std::tan(signed_angle) * out_of_plane).normalized();
  }
  return normals;
}

Eigen::Matrix3d random_turn(RandomStream& random) {
  const Eigen::Vector3d axis(random.normal(), random.normal(), random.normal());
  return rotation_exp(axis.normalized() * std::numbers::pi * random.uniform());
}

/// The die's planes in the frame of a scan at 6 m, rounded to doubles.
std::array<Plane, 3> facets_in(const RigidTransform& scan_from_die,
                               const std::array<Eigen::Vector3d, 3>& normals) {
  std::array<Plane, 3> planes;
  for (int k = 0; k < 3; ++k) {
    planes[k].normal = (scan_from_die.rotation * normals[k]).normalized();
    // All three pass through the die's own corner, in theory.
    planes[k].offset_m = planes[k].normal.dot(scan_from_die.translation);
  }
  return planes;
}

/// A plane across the corner: the decisions hang on which side the corner is, by `margin_m`.
Plane cap_of(const std::array<Plane, 3>& facets, double margin_m, RandomStream& random) {
  const Eigen::Vector3d mean =
      (facets[0].normal + facets[1].normal + facets[2].normal).normalized();
  Plane cap;
  cap.normal = -(mean + 0.2 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()))
                    .normalized();
  const Eigen::Vector3d corner = decide_by("epeck", {facets, cap}).corner_m;
  cap.offset_m = cap.normal.dot(corner) + margin_m;
  return cap;
}

struct Draw {
  CornerPlanes planes;                 ///< exact but for rounding: what is decided about
  std::array<Plane, 3> master, slave;  ///< noisy, in the frames of two scans: what is estimated
  RigidTransform master_from_slave;
  Eigen::Vector3d corner_in_master_m;
};

std::array<Plane, 3> with_noise(std::array<Plane, 3> planes, const Eigen::Vector3d& about_m,
                                RandomStream& random) {
  for (Plane& plane : planes) {
    const Eigen::Matrix<double, 3, 2> tangent = tangent_basis(plane.normal);
    const Eigen::Vector2d tilt(random.normal(), random.normal());
    const double at_m = plane.normal.dot(about_m) - plane.offset_m;
    plane.normal = (plane.normal + tilt_noise_rad * tangent * tilt).normalized();
    plane.offset_m = plane.normal.dot(about_m) - at_m + offset_noise_m * random.normal();
  }
  return planes;
}

Draw draw(DieKind kind, double angle_rad, std::uint64_t seed, std::uint64_t trial) {
  RandomStream random({seed, experiment_number, trial, 0, Purpose::experiment});
  const auto normals = normals_of(kind, angle_rad, random);
  const RigidTransform master_from_die{random_turn(random), {range_m * 0.8, range_m * 0.6, -1.1}};
  const RigidTransform slave_from_die{random_turn(random), {-range_m * 0.6, range_m * 0.8, -1.1}};
  Draw out;
  out.planes.facets = facets_in(master_from_die, normals);
  const double side = random.uniform() < 0.5 ? -1 : 1;
  const double margin_m = kind == DieKind::ordinary ? edge_m : side * angle_rad * edge_m;
  out.planes.cap = cap_of(out.planes.facets, margin_m, random);
  out.master = with_noise(out.planes.facets, master_from_die.translation, random);
  out.slave = with_noise(facets_in(slave_from_die, normals), slave_from_die.translation, random);
  out.master_from_slave = master_from_die * slave_from_die.inverse();
  out.corner_in_master_m = master_from_die.translation;
  return out;
}

/// The transform of two corners: edge 0-1, then facet 0.
RigidTransform join(const CornerDecisions& master, const CornerDecisions& slave) {
  RigidTransform out;
  out.rotation = master.axes * slave.axes.transpose();
  out.translation = master.corner_m - out.rotation * slave.corner_m;
  return out;
}

class KernelCell : public SweepCell {
 public:
  KernelCell(const SweepSettings& settings, std::vector<std::string> kernels, std::uint64_t seed)
      : kernels_(std::move(kernels)), angle_rad_(number_of(settings, "angle_rad")), seed_(seed) {
    const std::string& die = word_of(settings, "die");
    kind_ = die == "near_parallel"   ? DieKind::near_parallel
            : die == "near_coplanar" ? DieKind::near_coplanar
                                     : DieKind::ordinary;
  }

  std::vector<TrialRow> run(std::uint64_t trial) const override {
    const Draw drawn = draw(kind_, angle_rad_, seed_, trial);
    const CornerDecisions exact = decide_by("epeck", drawn.planes);
    std::vector<TrialRow> rows;
    for (const std::string& kernel : kernels_) {
      TrialRow row{kernel};
      constexpr int repeats = 8;  // one chain is too short for the clock
      const double start = cpu_s();
      CornerDecisions found;
      for (int k = 0; k < repeats; ++k) found = decide_by(kernel, drawn.planes);
      row.duration_s = (cpu_s() - start) / repeats;
      const auto wrong = [](bool a, bool b) { return a != b ? 1.0 : 0.0; };
      row.extra = {wrong(found.orientation, exact.orientation),
                   wrong(found.chirality, exact.chirality),
                   wrong(found.adjacency, exact.adjacency),
                   wrong(found.closure, exact.closure),
                   found.on_planes ? 1.0 : 0.0,
                   (found.corner_m - exact.corner_m).norm()};
      const RigidTransform estimate = join(decide_by(kernel, {drawn.master, drawn.planes.cap}),
                                           decide_by(kernel, {drawn.slave, drawn.planes.cap}));
      const RigidTransform error = estimate * drawn.master_from_slave.inverse();
      row.rotation_error_rad = rotation_angle_rad(error.rotation);
      row.translation_error_m =
          (error * drawn.corner_in_master_m - drawn.corner_in_master_m).norm();
      row.verdict = "registered";
      rows.push_back(row);
    }
    return rows;
  }

 private:
  std::vector<std::string> kernels_;
  double angle_rad_;
  std::uint64_t seed_;
  DieKind kind_ = DieKind::ordinary;
};

std::unique_ptr<SweepCell> make_cell(const SweepSettings& settings,
                                     const std::vector<std::string>& estimators,
                                     std::uint64_t seed) {
  return std::make_unique<KernelCell>(settings, estimators, seed);
}

}  // namespace

SweepExperiment kernel_sweep() {
  SweepExperiment experiment;
  experiment.name = "kernel";
  experiment.what = "decisions and corner of three facets in three kernels of CGAL";
  experiment.parameters = {
      {"die",
       std::string("ordinary"),
       0,
       0,
       {"ordinary", "near_parallel", "near_coplanar"},
       "a die as made; two facets nearly parallel; three normals nearly in one plane"},
      {"angle_rad",
       1e-3,
       1e-16,
       1,
       {},
       "how near (rad); a fourth plane then passes the corner at this share of the edge"},
  };
  experiment.estimators = {"double", "epick", "epeck"};
  experiment.extra_columns = {"wrong_orientation", "wrong_chirality",  "wrong_adjacency",
                              "wrong_closure",     "corner_on_planes", "corner_error_m"};
  experiment.make_cell = make_cell;
  return experiment;
}

}  // namespace alea::experiments::exactness
