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

  // Whether the last determinants fell as the root of the way that is left to one load, as before a fold. Before loads
  // where branches part they fall as the way itself, and where these part by a little only they do so until they rise
  // again. Only of a load that surely lies before this one.
  bool nears_fold_before(double load_factor) const;

  // The branch goes on here.
  void keep(double load_factor, const Determinant& now);

  const Determinant& last() const { return last_.determinant; }

 private:
  struct Point {
    double load_factor = 0;
    Determinant determinant;
  };
  void look_for_fold();

  Point last_, before_, earlier_;
  int points_ = 0;
  // The load where the line through the squares of two determinants meets zero, how far it was ahead then, and how many
  // times in a row it was foretold so, each from at most half as far.
  struct {
    double load_factor = 0, ahead = 0;
    int times_held = 0;
  } fold_;
};

}  // namespace scene
