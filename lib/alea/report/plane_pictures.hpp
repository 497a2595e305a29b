#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "alea/core/cloud.hpp"
#include "alea/core/rigid_transform.hpp"
#include "alea/evaluate/check_planes.hpp"
#include "alea/plane/plane_detector.hpp"
#include "alea/report/picture.hpp"

namespace alea {

/// A scan as its scanner saw it, each plane in a colour of its own over the intensity, the largest
/// numbered by their rank. What belongs to no plane stays grey. `middle_m` (scan's
/// frame) comes to the middle of a picture all round.
Picture planes_picture(const Cloud& cloud, const std::vector<PlaneRegion>& planes,
                       const std::string& scan_name,
                       const std::optional<Eigen::Vector3d>& middle_m = std::nullopt);

/// Both scans at the planes that both see: mean distance from the master's plane in small squares,
/// the master's points above, the transformed slave's below; the largest six planes.
Picture check_plane_maps(const Cloud& master, const Cloud& slave,
                         std::span<const CommonPlane> planes, std::span<const CheckPlane> checks,
                         const RigidTransform& master_from_slave);

/// Stand-alone and union RMSE and the offset of every plane, side by side (mm).
Picture check_plane_chart(std::span<const CheckPlane> checks);

}  // namespace alea
