#include <fmt/format.h>

#include <Eigen/Geometry>
#include <memory>
#include <numbers>

#include "alea/io/atomic_file.hpp"
#include "alea/io/formats.hpp"
#include "experiments/command/command.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

struct TransformArguments {
  std::string registration, out;
  std::string convention = "matrix";
  bool inverse = false;
};

std::string matrix_text(const Eigen::Matrix4d& m) {
  std::string out;
  for (int i = 0; i < 4; ++i)
    out += fmt::format("{} {} {} {}\n", m(i, 0), m(i, 1), m(i, 2), m(i, 3));
  return out;
}

std::string quaternion_text(const RigidTransform& transform) {
  Eigen::Quaterniond q(transform.rotation);
  if (q.w() < 0) q.coeffs() *= -1;
  const Eigen::Vector3d& t = transform.translation;
  return fmt::format("{} {} {} {} {} {} {}\n", q.w(), q.x(), q.y(), q.z(), t.x(), t.y(), t.z());
}

std::string omega_phi_kappa_text(const RigidTransform& transform) {
  const Eigen::Vector3d angles = omega_phi_kappa_rad(transform.rotation) * (180 / std::numbers::pi);
  const Eigen::Vector3d& t = transform.translation;
  return fmt::format("{} {} {} {} {} {}\n", angles.x(), angles.y(), angles.z(), t.x(), t.y(),
                     t.z());
}

std::string text_of(const RigidTransform& transform, const std::string& convention) {
  if (convention == "quaternion") return quaternion_text(transform);
  if (convention == "omega_phi_kappa") return omega_phi_kappa_text(transform);
  if (convention == "ptx") return ptx_pose_lines(transform.matrix());
  if (convention == "e57") return e57_pose_xml(transform.matrix());
  return matrix_text(transform.matrix());
}

int run(const TransformArguments& arguments) {
  RigidTransform transform = read_transform(arguments.registration);
  if (arguments.inverse) transform = transform.inverse();
  const std::string text = text_of(transform, arguments.convention);
  if (arguments.out.empty() || arguments.out == "-")
    fmt::print("{}", text);
  else
    write_file_atomically(arguments.out, text);
  return exit_done;
}

}  // namespace

void add_transform(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<TransformArguments>();
  CLI::App* command = app.add_subcommand(
      "transform", "Prints the transform of a registration as other programs read it (metres)");
  command
      ->add_option("REGISTRATION", arguments->registration,
                   "JSON of `alea register`, or 16 numbers row by row (master_from_slave, metres)")
      ->required();
  command
      ->add_option("--as", arguments->convention,
                   "matrix: 4 lines of 4 for column vectors (CloudCompare, Open3D, PCL); "
                   "quaternion: w x y z, then x y z; omega_phi_kappa: degrees, R = Rz(kappa) "
                   "Ry(phi) Rx(omega), then x y z; ptx: position, axes and matrix of a PTX header; "
                   "e57: the pose element of an E57 file")
      ->check(CLI::IsMember({"matrix", "quaternion", "omega_phi_kappa", "ptx", "e57"}))
      ->capture_default_str();
  command->add_flag("--inverse", arguments->inverse, "slave_from_master instead");
  command->add_option("--out", arguments->out, "File to write (default: standard output)");
  command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace alea::command
