#include "experiments/engine/verdict.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "alea/core/error.hpp"

namespace alea::experiments {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}

// -1: the interval lies wholly below the printed value, +1: above, 0: they meet.
int side(const Interval& interval, const PrintedValue& printed) {
  if (interval.high < printed.value - printed.half_digit) return -1;
  if (interval.low > printed.value + printed.half_digit) return 1;
  return 0;
}

// The interval over the third of the samples at one end of a datum's draws.
Interval interval_at_end(std::vector<PriorSample> samples, std::size_t datum, bool upper) {
  std::stable_sort(samples.begin(), samples.end(), [&](const PriorSample& a, const PriorSample& b) {
    return upper ? a.omitted[datum] > b.omitted[datum] : a.omitted[datum] < b.omitted[datum];
  });
  std::vector<double> values;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, samples.size() / 3); ++i)
    values.push_back(samples[i].value);
  return central_interval(std::move(values));
}

}  // namespace

PrintedValue parse_printed(const std::string& text) {
  PrintedValue printed{text, 0, 0};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), printed.value,
                                            std::chars_format::fixed);
  if (error != std::errc{} || end != text.data() + text.size())
    throw input_error("'" + text + "' is no printed number");
  const auto point = text.find('.');
  const auto decimals =
      point == std::string::npos ? 0 : static_cast<double>(text.size() - point - 1);
  printed.half_digit = 0.5 * std::pow(10.0, -decimals);
  return printed;
}

Interval central_interval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantile(values, 0.025), quantile(values, 0.5), quantile(values, 0.975)};
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::agrees:
      return "agrees";
    case Verdict::differs:
      return "differs";
    case Verdict::undecidable:
      return "undecidable";
    case Verdict::input:
      return "input";
    case Verdict::ours:
      return "-";
  }
  return "";
}

Judgement judge(const PrintedValue& printed, const std::vector<PriorSample>& samples,
                const std::vector<std::string>& omitted_names) {
  std::vector<double> values;
  for (const PriorSample& sample : samples) values.push_back(sample.value);
  Judgement judgement{Verdict::differs, central_interval(std::move(values)), ""};
  const bool meets = side(judgement.ours, printed) == 0;
  if (meets) judgement.verdict = Verdict::agrees;
  for (std::size_t datum = 0; datum < omitted_names.size(); ++datum) {
    const int lower = side(interval_at_end(samples, datum, false), printed);
    const int upper = side(interval_at_end(samples, datum, true), printed);
    const bool moves = meets ? lower * upper < 0 : lower == 0 || upper == 0;
    if (!moves) continue;
    judgement.verdict = Verdict::undecidable;
    judgement.datum = omitted_names[datum];
    break;
  }
  return judgement;
}

}  // namespace alea::experiments
