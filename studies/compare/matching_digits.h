// How many digits of a printed value a computed one matches.
//
// digits = -log10(|value - printed| / scale), the scale being |printed| unless given: a curve that was digitised is as
// good as its axis is long. It is capped at the digits that the source carries, the places of the print down from the
// scale's leading one, and is never below zero. A value that rounds to the print matches all that it carries.
#pragma once

#include "studies/compare/data_file.h"

#include <vector>

namespace studies {

// Norm of the printed vector.
double norm(const std::vector<Printed>& published);

// Digits that the print carries: 0.05643 carries 4, 12.00 carries 4. A printed zero needs a scale.
int carried_digits(const std::vector<Printed>& published, double scale);

// Of a vector, by the norm of the difference. values: as many as are printed. most: where the print claims more digits
// than it is worth (a curve that was read off a figure).
double matching_digits(const std::vector<double>& values, const std::vector<Printed>& published, double scale,
                       int most = 16);

}  // namespace studies
