#include "experiments/engine/acceptance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "alea/core/error.hpp"
#include "experiments/checkerboard/acceptance.hpp"
#include "experiments/die/acceptance.hpp"
#include "experiments/engine/sweep_acceptance.hpp"
#include "experiments/markerless/acceptance.hpp"

namespace alea::acceptance {
namespace {

bool inside(double value, const Limit& limit) {
  return value >= limit.low && value <= limit.high;  // false for NaN
}

std::string limit_text(const Limit& limit) {
  const bool low = std::isfinite(limit.low), high = std::isfinite(limit.high);
  if (low && high) return fmt::format("in [{:.6g}, {:.6g}]", limit.low, limit.high);
  if (low) return fmt::format(">= {:.6g}", limit.low);
  return high ? fmt::format("<= {:.6g}", limit.high) : "none";
}

}  // namespace

Limit at_most(double high) {
  return {-std::numeric_limits<double>::infinity(), high};
}
Limit at_least(double low) {
  return {low, std::numeric_limits<double>::infinity()};
}
Limit within(double centre, double half_width) {
  return {centre - half_width, centre + half_width};
}

bool Cell::passes() const {
  if (judgement == Judgement::shown) return true;
  if (judgement == Judgement::interval)
    return inside(interval.low, limit) && inside(interval.high, limit);
  return inside(value, limit);
}

std::string to_line(const Cell& cell) {
  const std::string verdict = cell.judgement == Judgement::shown ? "shown"
                              : cell.passes()                    ? "PASS"
                                                                 : "FAIL";
  return fmt::format("{:<58} {:>11.5g} {:<4} [{:.5g}, {:.5g}]  limit {:<18} {:<5} n={}", cell.name,
                     cell.value, cell.unit, cell.interval.low, cell.interval.high,
                     limit_text(cell.limit), verdict, cell.n);
}

std::vector<Topic> all_topics() {
  std::vector<Topic> topics;
  for (const auto& of_issue :
       {die_topics(), checkerboard_topics(), markerless_topics(), sweep_topics()})
    topics.insert(topics.end(), of_issue.begin(), of_issue.end());
  return topics;
}

std::vector<Topic> topics_named(const std::string& word) {
  std::vector<Topic> named;
  std::string known;
  for (const Topic& topic : all_topics()) {
    known += fmt::format(" {}.{}", topic.issue, topic.name);
    if (word == "all" || word == topic.issue || word == topic.name ||
        word == topic.issue + "." + topic.name)
      named.push_back(topic);
  }
  if (named.empty())
    throw usage_error(fmt::format("acceptance: no topic '{}'; there are all{}", word, known));
  return named;
}

}  // namespace alea::acceptance
