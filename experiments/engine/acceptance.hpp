#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace alea::acceptance {

/// A 95 % interval; for a value without a sampling error both ends are the value.
struct Interval {
  double low = 0;
  double high = 0;
};

/// What a value is held against: it passes inside [low, high].
struct Limit {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

Limit at_most(double high);
Limit at_least(double low);
Limit within(double centre, double half_width);

/// How a cell is judged.
enum class Judgement {
  interval,  ///< the whole 95 % interval lies inside the limit
  point,     ///< the value alone does: a line that states its own smaller n, or has no sampling
  shown      ///< not judged: a number that stands beside others
};

/// One number of an acceptance line.
struct Cell {
  std::string name;
  double value = 0;
  Interval interval;
  Limit limit;
  std::uint64_t n = 0;  ///< trials, dice, runs
  std::string unit;
  Judgement judgement = Judgement::point;

  bool passes() const;
};

/// "name: value unit [low, high] (limit ...) PASS n=...", one line.
std::string to_line(const Cell& cell);

struct Options {
  std::uint64_t trials = 0;  ///< 0: the topic's own number
  std::uint64_t seed = 1;
  /// The topic's own number of trials where none was asked for.
  std::uint64_t trials_or(std::uint64_t own) const { return trials > 0 ? trials : own; }
  /// By interval at the topic's own number or more; a smaller run states its n and is judged by its
  /// point estimates.
  Judgement judgement(std::uint64_t own) const {
    return trials_or(own) >= own ? Judgement::interval : Judgement::point;
  }
};

/// Receives the cells of a topic one by one, as they are known.
using Report = std::function<void(const Cell&)>;

/// Part of an issue's acceptance that runs by itself.
struct Topic {
  std::string issue;  ///< die, markerless, ...
  std::string name;   ///< e.g. "leak"
  std::string what;   ///< one line
  void (*run)(const Options&, const Report&);
};

/// Every topic of every issue, in the order in which they run.
std::vector<Topic> all_topics();

/// The topics that `word` names: one topic, all of an issue, or "all". Throws Error(usage) where
/// there is none.
std::vector<Topic> topics_named(const std::string& word);

}  // namespace alea::acceptance
