#include "experiments/engine/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "alea/io/atomic_file.hpp"
#include "experiments/engine/csv_table.hpp"

namespace alea::experiments {
namespace {

// Four significant digits, and never more than six decimals.
std::string number(double value) {
  if (value == 0 || !std::isfinite(value)) return fmt::format("{}", value);
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  return fmt::format("{:.{}f}", value, std::clamp(3 - magnitude, 0, 6));
}

std::string ours_text(const Cell& cell) {
  if (!cell.ours) return "";
  if (cell.ours->low == cell.ours->high) return number(cell.ours->median);
  return fmt::format("{} [{}, {}]", number(cell.ours->median), number(cell.ours->low),
                     number(cell.ours->high));
}

std::array<std::string, 6> fields_of(const Cell& cell) {
  return {cell.row,
          cell.unit.empty() ? cell.column : cell.column + " (" + cell.unit + ")",
          cell.printed,
          ours_text(cell),
          to_string(cell.verdict),
          cell.note};
}

std::string latex_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("#$%&_{}").find(c) != std::string_view::npos) escaped += '\\';
    if (c == '<' || c == '>')
      escaped += fmt::format("${}$", c);
    else
      escaped += c;
  }
  return escaped;
}

const std::array<std::string, 6> headings{"row",     "quantity", "printed", "ours [central 95 %]",
                                          "verdict", "note"};

}  // namespace

Cell judged_cell(const std::string& row, const std::string& column, const std::string& unit,
                 const std::string& printed, const std::vector<PriorSample>& samples,
                 const std::vector<std::string>& omitted_names) {
  const Judgement judgement = judge(parse_printed(printed), samples, omitted_names);
  const std::string note = judgement.datum.empty() ? "" : "depends on the " + judgement.datum;
  return {row, column, unit, printed, judgement.ours, judgement.verdict, note};
}

Cell own_cell(const std::string& row, const std::string& column, const std::string& unit,
              std::vector<double> values) {
  return {row, column, unit, "", central_interval(std::move(values)), Verdict::ours, ""};
}

std::string as_text(const ResultTable& table) {
  std::array<std::size_t, 6> widths{};
  for (std::size_t i = 0; i < headings.size(); ++i) widths[i] = headings[i].size();
  for (const Cell& cell : table.cells)
    for (std::size_t i = 0; i < headings.size(); ++i)
      widths[i] = std::max(widths[i], fields_of(cell)[i].size());
  const auto line = [&](const std::array<std::string, 6>& fields) {
    std::string text;
    for (std::size_t i = 0; i < fields.size(); ++i)
      text += fmt::format("{:<{}}  ", fields[i], widths[i]);
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  };
  std::string text = table.title + "\n" + (table.note.empty() ? "" : table.note + "\n") + "\n";
  text += line(headings);
  for (const Cell& cell : table.cells) text += line(fields_of(cell));
  return text;
}

std::string summary_line(const ResultTable& table) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(table.cells.begin(), table.cells.end(),
                         [&](const Cell& cell) { return cell.verdict == verdict; });
  };
  return fmt::format("{:<17} {:3} agree, {:3} differ, {:3} undecidable   {}\n", table.id,
                     count(Verdict::agrees), count(Verdict::differs), count(Verdict::undecidable),
                     table.title);
}

std::string as_csv(const ResultTable& table) {
  std::string text = "row,column,unit,printed,ours_median,ours_low,ours_high,verdict,note\n";
  for (const Cell& cell : table.cells) {
    const std::string ours = cell.ours ? fmt::format("{:.9g},{:.9g},{:.9g}", cell.ours->median,
                                                     cell.ours->low, cell.ours->high)
                                       : ",,";
    text += fmt::format("{},{},{},{},{},{},{}\n", csv_field(cell.row), csv_field(cell.column),
                        csv_field(cell.unit), csv_field(cell.printed), ours,
                        to_string(cell.verdict), csv_field(cell.note));
  }
  return text;
}

std::string as_latex(const ResultTable& table) {
  std::string text = fmt::format("% {}\n\\begin{{tabular}}{{llllll}}\n\\hline\n", table.title);
  const auto line = [](const std::array<std::string, 6>& fields) {
    std::string row;
    for (std::size_t i = 0; i < fields.size(); ++i)
      row += (i > 0 ? " & " : "") + latex_text(fields[i]);
    return row + " \\\\\n";
  };
  text += line(headings) + "\\hline\n";
  for (const Cell& cell : table.cells) text += line(fields_of(cell));
  return text + "\\hline\n\\end{tabular}\n";
}

void write_table(const std::string& folder, const ResultTable& table) {
  const std::filesystem::path stem = std::filesystem::path(folder) / table.id;
  write_file_atomically(stem.string() + ".txt", as_text(table));
  write_file_atomically(stem.string() + ".csv", as_csv(table));
  write_file_atomically(stem.string() + ".tex", as_latex(table));
}

}  // namespace alea::experiments
