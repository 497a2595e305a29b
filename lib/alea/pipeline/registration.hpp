#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "alea/core/refusal.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/die/adjustment_quality.hpp"
#include "alea/evaluate/check_planes.hpp"

namespace alea {

/// One facet as a scan saw it, in that scan's own frame.
struct FacetReport {
  bool in_master = true;
  int pips = 0;
  std::size_t points = 0;
  Plane plane;        ///< normal outward
  double rmse_m = 0;  ///< along the normal
  double pip_probability = 0;
  double variance_factor = 1;  ///< of the assumed noise
};

/// What was learnt of the die. Edge "i-j", i < j, is where the facets with i and j pips meet.
struct DieReport {
  std::optional<std::string> shared_edge;
  std::optional<double> edge_m;           ///< length of the shared edge from corner to corner
  std::map<std::string, double> edges_m;  ///< seen or calibrated edges only
  bool calibrated = false;
  std::vector<FacetReport> facets;
  std::map<std::string, double>
      angles_master_rad;  ///< dihedral inside the die between the facets named
  std::map<std::string, double> angles_slave_rad;
  Eigen::Vector3d corner_master_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d corner_slave_m = Eigen::Vector3d::Zero();
};

/// One way in which the slave can lie to the master.
struct OrientationReport {
  RigidTransform master_from_slave;    ///< roughly, as a perfect cube would say
  double log_likelihood_margin = 0;    ///< of the likeliest over this one, by the pips
  std::optional<double> scene_points;  ///< on planes that both scans see, where the scene was asked
};

struct AmbiguityReport {
  int alternatives = 0;              ///< other orientations that the data support about as well
  double log_likelihood_margin = 0;  ///< of the answer over the runner-up
  bool resolved_by_scene = false;    ///< the target left several orientations, the scene one
  std::vector<OrientationReport> orientations;  ///< of a die, the likeliest first
};

/// What a fine registration on calibration planes changed.
struct RefinementReport {
  std::string method;      ///< "planes" or "icp"
  std::size_t planes = 0;  ///< that it used; never check planes
  std::size_t pairs = 0;   ///< of points for icp, of planes for planes
  int iterations = 0;
  double rotation_rad = 0;                                  ///< angle of the change
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();  ///< change of the place `about_m`
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();        ///< the die's centre, master frame
};

/// What the adjustment says about itself. With several slaves it is one adjustment of all scans.
struct AdjustmentReport {
  std::size_t scans = 2;  ///< that took part
  double chi_square = 0;
  int freedom = 0;
  double p_value = 1;
  double covariance_factor = 1;   ///< the covariance is already multiplied by it
  int defect = 0;                 ///< directions that the scans leave open
  std::vector<std::string> open;  ///< the same in words
  std::vector<VarianceComponent> components;
  std::vector<FacetTest> tests;  ///< of the facets
  int iterations = 0;
};

/// A point whose coordinates in the site's system are given.
struct ControlResidual {
  std::string name;
  Eigen::Vector3d site_m = Eigen::Vector3d::Zero();      ///< as given
  Eigen::Vector3d master_m = Eigen::Vector3d::Zero();    ///< as measured, master frame
  Eigen::Vector3d residual_m = Eigen::Vector3d::Zero();  ///< transformed minus given, site system
};

/// The master frame in the site's system.
struct SiteTie {
  RigidTransform site_from_master;
  TransformCovariance covariance;  ///< left perturbation in the site's system
  std::vector<ControlResidual> points;
  double rmse_m = 0;  ///< of the residuals' lengths
};

/// The result of any registration of two scans.
struct Registration {
  std::string method;
  std::optional<Refusal> refusal;     ///< then there is no transform
  std::vector<std::string> warnings;  ///< "code: text"
  std::optional<RigidTransform> master_from_slave;
  std::optional<TransformCovariance> covariance;  ///< left perturbation in the master frame
  std::optional<DieReport> die;
  std::optional<AmbiguityReport> ambiguity;
  std::optional<RefinementReport> refinement;  ///< where it was asked for and possible
  std::optional<AdjustmentReport> adjustment;
  std::optional<SiteTie> site;
  std::vector<CheckPlane> check_planes;
  std::vector<std::pair<std::string, double>> timing_s;  ///< stages in order, "total" last
};

}  // namespace alea
