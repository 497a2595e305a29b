#pragma once

#include <optional>
#include <string>
#include <vector>

namespace alea::experiments {

/// A number as a paper prints it: value +- half a unit of its last digit.
struct PrintedValue {
  std::string text;
  double value = 0;
  double half_digit = 0;
};

/// "1.90" is 1.90 +- 0.005, "76" is 76 +- 0.5. Throws Error(input) where it is no number.
PrintedValue parse_printed(const std::string& text);

/// Median and central 95 % of a sample (linear interpolation between order statistics).
struct Interval {
  double low = 0, median = 0, high = 0;
};

/// `values` not empty.
Interval central_interval(std::vector<double> values);

enum class Verdict {
  agrees,       ///< the printed value +- half its last digit meets our central 95 %
  differs,      ///< it lies outside
  undecidable,  ///< one datum that the paper omits moves our interval across the value
  input,        ///< the printed number is an input of the twin, not a result
  ours          ///< a number of this project beside the paper's, nothing printed to judge by
};

const char* to_string(Verdict verdict);

/// One simulated result with the draws of the data that the paper omits.
struct PriorSample {
  double value = 0;
  std::vector<double> omitted;  ///< one draw for each name, in the order of the names
};

struct Judgement {
  Verdict verdict = Verdict::differs;
  Interval ours;
  std::string datum;  ///< the omitted datum that leaves the cell undecidable, else empty
};

/// The rule. Where the printed value meets the interval over dice and prior the cell agrees, unless
/// one omitted datum alone puts the interval wholly below the value at one end of its range and
/// wholly above at the other. Where it does not meet it the cell differs, unless the interval at an
/// end of one datum's range meets it. The ends are the lowest and highest third of the draws.
Judgement judge(const PrintedValue& printed, const std::vector<PriorSample>& samples,
                const std::vector<std::string>& omitted_names);

}  // namespace alea::experiments
