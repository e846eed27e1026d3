// What the reader of the benchmarks page needs to know of each case. Numbers in these texts are facts about the
// published data; what the methods reach stands in the tables.
#include "studies/benchmarks/page.h"

namespace studies {

std::string benchmark_text(const std::string& key) {
  static const std::map<std::string, std::string> texts = {
      {"page",
       R"(# Benchmarks: published cases, by the exact reference, finite elements and FAM

Ten clamped rods for which others printed numbers. Each is solved three times: by the *exact* reference (rod equations
to round-off), by *FE* (geometrically exact quadratic elements) and by *FAM* (fourth-order arcs), all three with the
shear and stretch that the scene has. Where a method has no answer its row stays and says so; `unsupported`: it does not
take this kind of load.

**Matching digits** = −log₁₀(|value − published| / |published|), of a vector by norms, of digitised curves over the
rod's length. Never more than the source carries (its printed digits, fewer where it was read off a figure, ten at
most: beyond lies round-off); a value that rounds to the print matches all that it carries.

**What a source is worth**: *published*: printed by its authors, mostly results of other programs, as quoted in public
repositories; *digitised*: read off a printed curve; *measured*: on a real structure; *computed*: by an independent
solver for this comparison; *closed form*: formulas. Few digits against *published* tell of the source: of its mesh,
its model, its rounding. Accuracy of a method shows against *closed form* and *computed*. Where each number comes from
is in `tests/data/README.md` and the heads of the files there. Times, apart: [timing.md](timing.md).

Cells: the median of the matching digits over the points (the lowest in parentheses).
)"},
      {"rollup",
       R"(A cantilever under an end moment bends to a circle: one turn (L = 12, EI = 100, after Sze et al.), two turns (L = 1,
EI = 2, M = 8π, after Simo & Vu-Quoc). FAM is exact here: an arc of constant curvature is what it is made of.
)"},
      {"elastica",
       R"(A force at the tip that keeps its direction; inextensible rod. Sze's numbers are of shell elements and stay 4e-4 to
1.3e-3 below the elastica; Mattiasson's five digits are all right.
)"},
      {"follower",
       R"(A force that stays normal to the tip, L = 100 cm, EI = 3.5e7 N cm². The published curves were read off the figures, so
errors are over L and two digits are the most they are worth. Argyris' quoted section would give EI = 3.15e7, which his
curves do not fit; 3.5e7 does. Of the twelve digitised points labelled 94.5 kN, the first six are those of the curve of
80 kN once more: a slip of the digitised file, kept as rows.
)"},
      {"thick",
       R"(2 m × 0.1 m × 0.5 m, E = 207 GPa, ν = 0.3, so short that shear matters; shear coefficient 10(1+ν)/(12+11ν). The
published numbers are of 1024 (large load) and 256 elements and carry 6.4 and 5.4 of their printed digits.
)"},
      {"heavy",
       R"(A uniform force along the rod: as weight (fixed) and turning with the rod (follower). The table that PyElastica ships
names no paper; its fixed loads are within 2.5e-3 L of the exact tips, its follower loads within 6e-3 L but for q L³/EI = 13
and 15, which are off by 0.028 and 0.013: these two rows tell of the table. The computed points go on to q L³/EI = 1000,
outside the picture.
)"},
      {"bend45",
       R"(An arc of 45°, R = 100, unit square section, E = 1e7, G = 5e6, force out of its plane that keeps its direction (Bathe &
Bolourchi 1979). The sources do not agree, and not only by their meshes: **the torsion constant** is the polar moment
J = 1/6 for some and St Venant's J = 0.141 (the right one of a square) for others, which moves the tip at F = 600 by
0.31. Each published tip is compared with both. With 8 elements most scatter by 0.1 around either; Ibrahimbegović 1995
(3-node) and EXUDYN (32 elements) give J = 0.141 to all their digits, GXBeam (16 elements) J = 1/6 to 3.3. Left out: one
published tip whose axis is not the arc.
)"},
      {"helix",
       R"(A straight rod, L = 10, EI = GJ = 100, EA = GA = 1e4, under a fixed force 50 λ and a moment 200 π λ of fixed axis, both
along z: at λ = 1 it is wound into ten turns. Ibrahimbegović (1997) prints a curve, no digits; the dots are a Taylor
series of order 30. The exact line is drawn to λ = 0.2, the points go to λ = 1. FE takes 100 elements, ten a turn.
)"},
      {"princeton",
       R"(Aluminium strip 508 × 12.3777 × 3.2024 mm, E = 71.7 GPa, ν = 0.31, force at the tip at an angle to its stiff direction
(Dowell & Traybar 1975; the measured deflections were not found in digits). The published tips are of other programs:
ANSYS beams agree to three digits; ANSYS solids are stiffer by up to 4 %, which no beam model here shows
and we cannot explain.
)"},
      {"pazy",
       R"(A wing of 0.55 m with masses hung at its tip, deflected to half its span: the one measurement here. The rod is the
published stiffness table (bending and torsion of 15 sections, couplings left out) with the weights of its nodes. The
table itself is off the wing by up to 8 % (mostly stiffer), and UM/NAST and Nastran are off as much: **this tests the model's form,
not arithmetic**. With the skin, measured points jump by 5 % between 0.8 and 1.0 kg. Deflections are beyond those under
the wing's own weight.
)"},
      {"critical",
       R"(The load at which the straight rod stops being stable. The exact reference decides `stable` by the second variation; the
value is where it flips, found by halving. Methods that make no statement on stability stay as rows. Lateral: a
narrow cantilever (stiff to weak bending 1e10) loaded in its stiff plane. Beck's column is loaded by a follower force: it
flutters at 20.05 and has no static limit, so `stable` is rightly left undecided. Not here: torques on rods clamped at
both ends or with moments of a potential (Greenhill, semitangential), which are no scenes of ours.
)"},
      {"files", R"(## Files

`points.csv` (every point), `overview.csv`, `lines.csv` (the exact lines of the pictures); `timing.csv` and
[timing.md](timing.md) apart from them; `provenance.json`. Rerun with `build/release/bin/fam-studies benchmarks`, one
case with `build/release/bin/fam-studies solve studies/cases/benchmarks/bend45_polar.json --method exact`.
)"}};
  return texts.at(key);
}

}  // namespace studies
