#pragma once

#include <string>
#include <utility>
#include <vector>

#include "alea/io/toml_table.hpp"
#include "alea/simulate/scene.hpp"

namespace alea {

/// A pose from `centre_key` (m, required) and omega_phi_kappa_deg (missing: no rotation).
RigidTransform read_pose(const TomlTable& table, const std::string& centre_key);

/// Three positive lengths.
Eigen::Vector3d read_size(const TomlTable& table, const std::string& key,
                          const Eigen::Vector3d& missing);

/// One [[die]]; `number` counts from one and names it where it has no id.
Die read_die(const TomlTable& table, std::size_t number);

/// [scanner] or [station.scanner]: what is missing stays as in `base`.
Scanner read_scanner(const TomlTable& table, const Scanner& base);

/// One [[station]]; `targets` are the objects that aim_at can name.
Station read_station(const TomlTable& table, std::size_t number, const Scanner& scanner,
                     const std::vector<std::pair<std::string, BoundingBall>>& targets);

}  // namespace alea
