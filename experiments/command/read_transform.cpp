#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "alea/core/error.hpp"
#include "experiments/command/registration_json.hpp"

namespace alea::command {
namespace {

using nlohmann::json;

std::string read_whole(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw input_error(fmt::format("{}: a folder; expected a file with a transform", path));
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.good() && !file.eof())
    throw input_error(
        fmt::format("{}: cannot read the transform; is it a file that you may read?", path));
  return text;
}

bool is_separator(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == ';';
}

Eigen::Matrix4d matrix_from_numbers(const std::string& path, const std::string& text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && is_separator(*at)) ++at;
    if (at == end) break;
    double value = 0;
    const auto [next, error] = std::from_chars(*at == '+' ? at + 1 : at, end, value);
    if (error != std::errc{} || (next != end && !is_separator(*next)))
      throw input_error(fmt::format(
          "{}: number {} of the transform is not a number; 16 numbers, row by row, are needed",
          path, values.size() + 1));
    values.push_back(value);
    at = next;
  }
  if (values.size() != 16)
    throw input_error(fmt::format(
        "{}: {} numbers; a transform has 16, row by row (master_from_slave)", path, values.size()));
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
}

Eigen::Matrix4d matrix_from_json(const std::string& path, const std::string& text) {
  try {
    const json document = json::parse(text);
    if (document.value("status", "") == "refused")
      throw input_error(fmt::format(
          "{}: this registration was refused, so it has no transform; see its refusal", path));
    const json& rows = document.at("master_from_slave").at("matrix");
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) matrix(i, j) = rows.at(i).at(j).get<double>();
    return matrix;
  } catch (const json::exception& error) {
    throw input_error(fmt::format(
        "{}: not a JSON of `alea register` ({}); master_from_slave.matrix (4x4) is needed", path,
        error.what()));
  }
}

RigidTransform checked(const std::string& path, const Eigen::Matrix4d& matrix) {
  const RigidTransform transform = RigidTransform::from_matrix(matrix);
  const Eigen::Matrix3d& r = transform.rotation;
  const bool orthogonal =
      (r.transpose() * r - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-3;
  const bool last_row =
      (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < 1e-9;
  if (!matrix.allFinite() || !orthogonal || r.determinant() < 0 || !last_row)
    throw input_error(fmt::format(
        "{}: the matrix is not a rigid transform (rotation, translation, last row 0 0 0 1); "
        "scale or transposition?",
        path));
  // Printed digits leave a matrix slightly off; the nearest rotation is meant.
  return {Eigen::Quaterniond(r).normalized().toRotationMatrix(), transform.translation};
}

}  // namespace

RigidTransform read_transform(const std::string& path) {
  const std::string text = read_whole(path);
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos)
    throw input_error(fmt::format("{}: empty; a transform of 16 numbers is needed", path));
  const bool is_json = text[first] == '{';
  return checked(path, is_json ? matrix_from_json(path, text) : matrix_from_numbers(path, text));
}

}  // namespace alea::command
