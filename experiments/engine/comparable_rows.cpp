#include "experiments/engine/comparable_rows.hpp"

#include <fmt/format.h>

#include "experiments/engine/database.hpp"
#include "experiments/engine/trial_store.hpp"

namespace alea::experiments {
namespace {

std::string rows_as_text(const std::filesystem::path& folder, bool with_duration) {
  Database database(folder / TrialStore::file_name, Database::Mode::read);
  Statement rows(database, "SELECT * FROM trials ORDER BY cell, trial, estimator");
  std::string text;
  while (rows.next()) {
    for (int column = 0; column < rows.columns(); ++column) {
      const std::string name = rows.name(column);
      if (!with_duration && (name == "duration_s" || name == "crc32c")) continue;
      text += rows.type(column) == Statement::Type::real
                  ? fmt::format("{:a}|", rows.real(column))
                  : fmt::format("{}{}|", static_cast<int>(rows.type(column)), rows.text(column));
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string comparable_rows(const std::filesystem::path& folder) {
  return rows_as_text(folder, false);
}

std::string all_rows(const std::filesystem::path& folder) {
  return rows_as_text(folder, true);
}

}  // namespace alea::experiments
