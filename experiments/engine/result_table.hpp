#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/engine/verdict.hpp"

namespace alea::experiments {

/// One number: what the paper prints, what we find, and how they compare.
struct Cell {
  std::string row;
  std::string column;
  std::string unit;
  std::string printed;  ///< as printed, empty where the paper has no number
  std::optional<Interval> ours;
  Verdict verdict = Verdict::ours;
  std::string note;
};

struct ResultTable {
  std::string id;     ///< the stem of its files, e.g. "table2"
  std::string title;  ///< what it shows
  std::string note;   ///< how ours was made, and from how many trials
  std::vector<Cell> cells;
};

/// A cell whose printed value is judged by the rule.
Cell judged_cell(const std::string& row, const std::string& column, const std::string& unit,
                 const std::string& printed, const std::vector<PriorSample>& samples,
                 const std::vector<std::string>& omitted_names);

/// A cell of our own, with nothing printed to judge by.
Cell own_cell(const std::string& row, const std::string& column, const std::string& unit,
              std::vector<double> values);

std::string as_text(const ResultTable& table);
/// One line: how many cells agree, differ and cannot be decided.
std::string summary_line(const ResultTable& table);
std::string as_csv(const ResultTable& table);
/// A LaTeX tabular of its own, needing no package.
std::string as_latex(const ResultTable& table);

/// Writes DIR/ID.txt, .csv and .tex, each whole or not at all. Throws Error(input).
void write_table(const std::string& folder, const ResultTable& table);

}  // namespace alea::experiments
