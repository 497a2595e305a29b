#pragma once

#include <cstddef>

#include "alea/report/picture.hpp"

namespace alea::colours {

inline constexpr Rgb white{255, 255, 255}, black{0, 0, 0}, ink{40, 44, 52}, light{222, 225, 230},
    middle{150, 156, 166}, master{27, 108, 168}, slave{209, 73, 91}, axis_x{209, 73, 91},
    axis_y{58, 125, 68}, axis_z{27, 108, 168}, used{58, 125, 68}, masked{237, 150, 40};

/// Twenty colours that can be told apart, in a fixed order, over and over.
Rgb categorical(std::size_t number);

/// Black at 0 to white at 1; values outside are held at the ends.
Rgb grey(double value);

/// Blue at -1, near white at 0, red at +1; values outside are held at the ends.
Rgb diverging(double value);

/// (1 - share) * a + share * b.
Rgb mixed(Rgb a, Rgb b, double share);

}  // namespace alea::colours
