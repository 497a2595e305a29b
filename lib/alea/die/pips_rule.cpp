#include "alea/die/pips_rule.hpp"

#include <algorithm>
#include <string>

namespace alea {
namespace {

std::string listed(const PipTriple& counts) {
  std::string text;
  for (const int count : counts)
    text += (text.empty() ? "" : ", ") + (count == 0 ? std::string("none") : std::to_string(count));
  return text;
}

Refusal wrong_hand(const PipTriple& counts) {
  return {RefusalCode::chirality,
          "the pips " + listed(counts) + " belong to a die of the other hand: check --chirality"};
}

}  // namespace

std::optional<Chirality> hand_of(const PipTriple& pips) {
  // Facet p of a cube is the axis min(p, 7 - p), taken in the negative direction for p > 3. The
  // hand is the sign of the permutation of axes times the signs of the directions.
  int sign = 1;
  std::array<int, 3> axis{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (pips[k] < 1 || pips[k] > 6) return std::nullopt;
    axis[k] = std::min(pips[k], 7 - pips[k]);
    if (pips[k] > 3) sign = -sign;
  }
  if (axis[0] == axis[1] || axis[1] == axis[2] || axis[0] == axis[2]) return std::nullopt;
  const bool even = (axis[0] % 3) + 1 == axis[1];
  return (sign > 0) == even ? Chirality::counterclockwise : Chirality::clockwise;
}

std::vector<PipTriple> orientations_of(Chirality chirality) {
  std::vector<PipTriple> triples;
  for (int a = 1; a <= 6; ++a)
    for (int b = 1; b <= 6; ++b)
      for (int c = 1; c <= 6; ++c)
        if (hand_of({a, b, c}) == chirality) triples.push_back({a, b, c});
  return triples;
}

std::vector<PipTriple> orientations_agreeing(const PipTriple& counts, int agreeing,
                                             Chirality chirality) {
  std::vector<PipTriple> triples = orientations_of(chirality);
  std::erase_if(triples, [&](const PipTriple& triple) {
    int same = 0;
    for (std::size_t k = 0; k < 3; ++k) same += triple[k] == counts[k] ? 1 : 0;
    return same < agreeing;
  });
  return triples;
}

Result<PipTriple> resolve_any_two(const PipTriple& counts, Chirality chirality) {
  const auto read = [](int count) { return count >= 1 && count <= 6; };
  if (std::count_if(counts.begin(), counts.end(), read) < 2)
    return Refusal{RefusalCode::pips_unreadable,
                   "pips read: " + listed(counts) + "; two facets are needed"};
  if (const auto hand = hand_of(counts)) {
    if (*hand == chirality) return counts;
    return wrong_hand(counts);
  }
  const std::vector<PipTriple> candidates = orientations_agreeing(counts, 2, chirality);
  if (candidates.size() == 1) return candidates.front();
  return Refusal{RefusalCode::pips_ambiguous, "the pips " + listed(counts) + " fit " +
                                                  std::to_string(candidates.size()) +
                                                  " orientations of the die in two facets"};
}

Result<PipTriple> resolve_all_three(const PipTriple& counts, std::optional<Chirality> chirality) {
  const auto read = [](int count) { return count >= 1 && count <= 6; };
  if (!std::all_of(counts.begin(), counts.end(), read))
    return Refusal{RefusalCode::pips_unreadable,
                   "pips read: " + listed(counts) + "; all three facets are needed"};
  const auto hand = hand_of(counts);
  if (!hand)
    return Refusal{RefusalCode::pips_ambiguous,
                   "the pips " + listed(counts) + " do not meet in a corner of a die"};
  if (chirality && *hand != *chirality) return wrong_hand(counts);
  return counts;
}

}  // namespace alea
