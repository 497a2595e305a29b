#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>

#include "alea/core/refusal.hpp"

namespace alea::command {

// The pieces that the results of several commands are made of.

/// A list of numbers.
template <typename Derived>
nlohmann::json vector_json(const Eigen::MatrixBase<Derived>& values) {
  nlohmann::json out = nlohmann::json::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) out.push_back(values(i));
  return out;
}

/// A list of rows.
template <typename Derived>
nlohmann::json matrix_json(const Eigen::MatrixBase<Derived>& values) {
  nlohmann::json out = nlohmann::json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) out.push_back(vector_json(values.row(i)));
  return out;
}

/// null where there is none.
template <typename T>
nlohmann::json optional_json(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

inline nlohmann::json refusal_json(const Refusal& refusal) {
  return {{"code", to_string(refusal.code)}, {"message", refusal.message}};
}

/// null where nothing was refused.
inline nlohmann::json refusal_json(const std::optional<Refusal>& refusal) {
  return refusal ? refusal_json(*refusal) : nlohmann::json(nullptr);
}

}  // namespace alea::command
