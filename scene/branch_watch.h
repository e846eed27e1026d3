// Tells by determinants along a growing load whether a step has left the branch of equilibria, and how far the next one
// may go. A rule without mechanics: each method brings the determinant of its own equations' derivatives.
#pragma once

namespace scene {

struct Determinant {
  double log_size = 0;
  bool negative = false;
  double log_growth = 0;  // of that, what a taut rod makes of its tension, which has no zero: a bound is enough
};
// How far the logarithm of the size has fallen, for another reason than that the rod has become less taut.
double log_fall(const Determinant& from, const Determinant& to);
// Whether it has fallen, from the start of a way on, so far that a critical point may be near.
bool has_fallen(const Determinant& start, const Determinant& now);

class BranchWatch {
 public:
  // Whether the determinant has changed its sign since the last load.
  bool has_left(const Determinant& now) const;

  // From a load near the last: share_of_zero of the way to where the line through the last two determinants, by their
  // log_fall, meets zero, infinite if ahead it does not. Beyond it the sign may be the old one again, where two
  // branches part or two roots lie together.
  double longest_step(double from_load_factor) const;
  // The same of the parabola through the last three, where it falls the faster the farther it goes: where loads pass
  // through none the line through two determinants of about the same size sees no zero, and a step may pass two.
  double longest_bent_step(double from_load_factor) const;

  // The branch goes on here.
  void keep(double load_factor, const Determinant& now);

  const Determinant& last() const { return last_.determinant; }

 private:
  struct Point {
    double load_factor = 0;
    Determinant determinant;
  };
  Point last_, before_, earlier_;
  int points_ = 0;
};

}  // namespace scene
