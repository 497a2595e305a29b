#pragma once

#include <filesystem>

#include "alea/pipeline/measure_checkerboard.hpp"
#include "alea/report/page.hpp"

namespace alea {

/// A page about one checkerboard: the measurement, then every stage of the published pipeline from
/// the front and from the side - the crop, without outliers, binarised, the template at the start,
/// after point-to-plane and after coloured ICP.
Page board_page(const Cloud& cloud, const Eigen::Vector3d& near_m,
                const MeasureCheckerboardOptions& options);

}  // namespace alea
