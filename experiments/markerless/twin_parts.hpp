#pragma once

#include "alea/core/seed.hpp"
#include "experiments/markerless/twin_scene.hpp"

namespace alea::experiments::markerless {

// What both twins are made of. Lengths in metres, scene frame, z up.

/// A box on its base, turned about the vertical.
Box upright_box(const std::string& id, const Eigen::Vector3d& base_centre_m,
                const Eigen::Vector3d& size_m, double heading_rad, double intensity);

/// The place at a distance and direction from the axis.
Eigen::Vector3d polar(double distance_m, double direction_rad, double z_m);

/// A trunk and a crown of three balls.
void add_tree(Scene& scene, const std::string& id, const Eigen::Vector3d& foot_m, double height_m,
              RandomStream& stream);

/// Is this place clear of every box, cylinder and sphere by a margin, seen from above?
bool is_clear(const Scene& scene, const Eigen::Vector3d& place_m, double margin_m);

/// A levelled scanner with the instrument of the study: 3 mm range noise. `max_range_m` is where
/// the scans were cropped: set so that the mean overlap at the truth is the printed one.
Station levelled_station(const std::string& name, const Eigen::Vector3d& position_m,
                         double heading_rad, double step_rad, double max_range_m);

double between(RandomStream& stream, double low, double high);

}  // namespace alea::experiments::markerless
