#include "experiments/command/read_registration.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "alea/core/error.hpp"
#include "experiments/command/die_file.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

Eigen::Vector3d vector3(const json& values) {
  return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

CheckPlane check_plane(const json& entry) {
  CheckPlane plane;
  plane.id = entry.at("id").get<int>();
  plane.centroid_m = vector3(entry.at("centroid_m"));
  plane.normal = vector3(entry.at("normal"));
  plane.points_master = entry.at("points_master").get<std::size_t>();
  plane.points_slave = entry.at("points_slave").get<std::size_t>();
  plane.alone_master_m = entry.at("alone_master_m").get<double>();
  plane.alone_slave_m = entry.at("alone_slave_m").get<double>();
  plane.offset_m = entry.at("offset_m").get<double>();
  plane.role = entry.at("role").get<std::string>() == "check" ? CheckPlaneRole::check
                                                              : CheckPlaneRole::calibration;
  return plane;
}

MeasuredRegistration registration(const json& entry) {
  MeasuredRegistration out;
  const json& transform = entry.at("master_from_slave");
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) matrix(i, j) = transform.at("matrix").at(i).at(j).get<double>();
  out.master_from_slave = RigidTransform::from_matrix(matrix);
  if (!transform.at("covariance").is_null()) {
    out.covariance.emplace();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        out.covariance->covariance(i, j) = transform.at("covariance").at(i).at(j).get<double>();
    out.covariance->about_m = vector3(transform.at("covariance_about_m"));
  }
  for (const json& plane : entry.at("check_planes")) out.check_planes.push_back(check_plane(plane));
  return out;
}

}  // namespace

std::vector<MeasuredRegistration> read_registrations(const std::string& path) {
  const json document = read_json_file(path, "a JSON of `alea register`");
  std::vector<MeasuredRegistration> out;
  try {
    const json entries =
        document.contains("registrations") ? document["registrations"] : json::array({document});
    for (const json& entry : entries) {
      if (entry.at("status") == "refused")
        throw input_error(fmt::format(
            "{}: a registration in it was refused, so there is nothing to compare", path));
      out.push_back(registration(entry));
    }
  } catch (const json::exception& error) {
    throw input_error(fmt::format("{}: not a JSON of `alea register` ({})", path, error.what()));
  }
  return out;
}

}  // namespace alea::command
