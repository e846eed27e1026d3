#include "studies/report/table.h"
#include "studies/segmentation/ablation.h"
#include "studies/segmentation/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

std::string yes(bool value) {
  return value ? "yes" : "no";
}

const AblationPoint& point(const AblationRow& row, int arcs) {
  return *std::find_if(row.points.begin(), row.points.end(), [&](const AblationPoint& p) { return p.arcs == arcs; });
}

std::string ablation_csv(const AblationData& data) {
  Table table({"group", "variant", "arcs", "error_mm", "error_fe_mm", "bias_rad", "scatter_rad", "largest_relative",
               "sums_mm", "moment_drift"});
  for (const AblationRow& row : data.rows) {
    std::string name = row.name;
    std::replace(name.begin(), name.end(), ',', ';');
    for (const AblationPoint& p : row.points) {
      table.add({row.group, name, std::to_string(p.arcs), one_digit(p.error_mm), one_digit(p.fe_mm),
                 one_digit(p.bias_rad), one_digit(p.scatter_rad), one_digit(p.largest_relative), one_digit(p.sums_mm),
                 one_digit(p.drift)});
    }
  }
  return table.csv({"P4 (our loads). One digit each, absolute values; 1e-12 stands for that and less.",
                    "error: against the exact Kirchhoff rod; error_fe: against finite elements with shear and stretch; "
                    "the other columns: ablation.md."});
}

std::string trends_csv(const AblationData& data) {
  Table table({"variant", "against", "minimum_arcs", "minimum_mm", "at_12_mm", "at_500_mm", "at_5000_mm",
               "largest_12_to_500_mm", "minimum_near_12", "under_3_mm", "rises_beyond_500"});
  for (const AblationRow& row : data.rows) {
    std::string name = row.name;
    std::replace(name.begin(), name.end(), ',', ';');
    for (const bool fe : {false, true}) {
      const Trend t = trend(row, fe ? &AblationPoint::fe_mm : &AblationPoint::error_mm);
      table.add({name, fe ? "fe" : "exact", std::to_string(t.minimum_arcs), one_digit(t.minimum_mm),
                 one_digit(t.at_12_mm), one_digit(t.at_500_mm), one_digit(t.at_5000_mm),
                 one_digit(t.largest_12_to_500_mm), yes(t.minimum_near_12()), yes(t.under_3_mm()), yes(t.rises())});
    }
  }
  return table.csv({"P4 (our loads). near 12: 8 to 30; rises: the error of 5000 arcs is more than twice that of 500."});
}

std::string cancellation_csv(const AblationData& data) {
  Table table({"arcs", "angle_rad", "single", "double"});
  for (const Cancellation& c : data.cancellations) {
    table.add(
        {std::to_string(c.arcs), one_digit(c.angle_rad), one_digit(c.single_precision), one_digit(c.double_precision)});
  }
  return table.csv({"Relative error of (1 - cos t)/t^2 as written, at t = 2.3 rad / arcs. One digit."});
}

void census_cells(const Census& c, Table& table) {
  const bool any = c.all_three > 0;
  table.add({c.search, c.against, std::to_string(c.curves), std::to_string(c.rise), std::to_string(c.under_3_mm),
             std::to_string(c.minimum_near_12), std::to_string(c.all_three), any ? one_digit(c.smallest_all) : "–",
             any ? one_digit(c.largest_all) : "–"});
}

std::string census_csv(const AblationData& data) {
  Table table({"search", "against", "curves", "rise", "under_3_mm", "minimum_near_12", "all_three",
               "smallest_tolerance_of_those", "largest_tolerance_of_those"});
  for (const Census& c : data.censuses) census_cells(c, table);
  return table.csv({"P4 (our loads). 41 absolute tolerances from 1e-4 to 1e-2 rad, evenly in their logarithm."});
}

std::string census_table(const AblationData& data) {
  Table table({"search", "against", "tolerances", "rise beyond 500", "under 3 mm", "minimum near 12", "all three",
               "from, rad", "to, rad"});
  for (const Census& c : data.censuses) census_cells(c, table);
  return table.markdown();
}

std::string trend_table(const AblationData& data, bool tolerances) {
  Table table({"variant", "minimum at N", "N = 12", "500", "5000", "minimum near 12", "under 3 mm", "rises beyond 500",
               "against FE: 12", "500", "5000"});
  for (const AblationRow& row : data.rows) {
    if ((row.group == "tolerance") != tolerances) continue;
    const Trend t = trend(row, &AblationPoint::error_mm), fe = trend(row, &AblationPoint::fe_mm);
    table.add({row.name, std::to_string(t.minimum_arcs), one_digit(t.at_12_mm), one_digit(t.at_500_mm),
               one_digit(t.at_5000_mm), yes(t.minimum_near_12()), yes(t.under_3_mm()), yes(t.rises()),
               one_digit(fe.at_12_mm), one_digit(fe.at_500_mm), one_digit(fe.at_5000_mm)});
  }
  return table.markdown();
}

std::string mechanism_table(const AblationData& data) {
  Table table({"variant", "N", "tip error, mm", "bias, rad", "bias × L/2, mm", "scatter, rad", "largest relative error",
               "lost in sums, mm", "drift of the moment"});
  for (const char* name : {"sound: double, root of dPi/dtheta", "single precision", "single, unsafe", "golden section",
                           "GSL Brent", "single, golden", "single, golden, expanded Pi", "golden section 1e-03",
                           "golden section 3e-03", "bisection 1e-03", "Brent 1e-03", "secant root 1e-03",
                           "radius, golden 1e-03", "force not turned in the arc", "force not turned to the next arc"}) {
    for (const int arcs : {12, 500, 5000}) {
      const AblationPoint& p = point(data.row(name), arcs);
      table.add({name, std::to_string(arcs), one_digit(p.error_mm), one_digit(p.bias_rad), one_digit(20 * p.bias_rad),
                 one_digit(p.scatter_rad), one_digit(p.largest_relative), one_digit(p.sums_mm), one_digit(p.drift)});
    }
  }
  return table.markdown();
}

std::string cancellation_table(const AblationData& data) {
  Table table({"N", "angle of an arc, rad", "single", "double"});
  for (const Cancellation& c : data.cancellations) {
    table.add(
        {std::to_string(c.arcs), one_digit(c.angle_rad), one_digit(c.single_precision), one_digit(c.double_precision)});
  }
  return table.markdown();
}

// Variants whose curve against the exact rod has all of what is printed, and those that rise beyond 500.
std::string names_of(const AblationData& data, bool (*wanted)(const Trend&)) {
  std::string list;
  for (const AblationRow& row : data.rows) {
    if (wanted(trend(row, &AblationPoint::error_mm))) list += (list.empty() ? "*" : "; *") + row.name + "*";
  }
  return list.empty() ? "none" : list;
}

std::string page(const AblationData& data, double fixed_frame_mm) {
  const auto error = [&](const char* name, int arcs) { return one_digit(point(data.row(name), arcs).error_mm); };
  const auto fe = [&](const char* name, int arcs) { return one_digit(point(data.row(name), arcs).fe_mm); };
  return fmt::format(
      R"(# The ablation: what makes the error rise again?

Printed in the paper for its planar load case 4: minimum at N = 12, under 3 mm from 12 to 500, rising beyond 500. The
[sweep](README.md) shows none of it in sound arithmetic. Here the same law is spoiled on purpose, one weakness at a time
and together, on our case P4, and each curve is asked three questions: does it bottom out near 12 (taken as 8 to 30), does
it stay under 3 mm from 12 to 500, does it rise beyond 500 (5000 arcs more than twice as bad as 500)?

![Ablation](ablation.svg)

**Findings** (our loads; the paper's program is not known, so this shows what *can* make such a curve, not what did):

- All three at once: {all}.
  What they share is a search **between fixed bounds, stopped at an absolute tolerance** on the angle; of 41 tolerances from
  1e-4 to 1e-2 rad, {c1} (golden section) and {c2} (bisection) show all three against the exact rod, {c3} and {c4} against
  finite elements with shear. An arc's angle shrinks as 1/N, the tolerance does not.
- Rising beyond 500 at all: {rising}.
- Single precision, with a search as tight as it allows, does rise, but only to {s5000} mm at 5000 arcs: no plateau of
  millimetres.
- Not rising: unsafe forms in double precision, a minimiser in place of a root, GSL's Brent with any tolerance, a secant
  root with any tolerance, a radius as the unknown. A method that converges fast overshoots its tolerance by far; only one
  that halves a bracket stops where the tolerance says.
- Against finite elements the shear that the rod model leaves out puts {fe12} mm under every curve from 12 arcs on; "under
  3 mm from 12 to 500" is then a plateau. With a bisection stopped at 1e-03 rad the error against finite elements is
  {g12} mm at 12 arcs, {g500} mm at 500 and {g5000} mm at 5000; with a golden section at 3e-03 rad {h12}, {h500} and
  {h5000} mm. Where exactly the minimum lies is then chance: it depends on where the search happens to stop.
- Millimetres between 12 and 500 without any numerical fault: a force that is not turned when it is handed from arc to arc
  ({n12} mm at 12 arcs, {n500} mm at 500), or a finite element model whose loads keep their direction in space while the arcs'
  follow ({frame} mm on P4). Neither rises beyond 500.

So the stated reason (short arcs are nearly straight and the minimisation cannot find their curvature) describes a
symptom that an absolute stopping tolerance would produce; arcs being nearly straight is not in itself a difficulty.

## Each alone, and combined

Tip error in mm against the exact Kirchhoff rod, and against finite elements with shear and stretch. "–": GSL refuses to
start or the arithmetic breaks down. **One digit each**: single precision and stopped searches are chaotic, and more digits
would change with compiler and processor.

{alone}
- *single precision*: all numbers are floats; *unsafe forms*: (1 − cos θ)/θ², sin θ/θ, (θ − sin θ)/θ³, tan(θ/4)/(θ/4) as written;
- *golden section*, *GSL Brent*: minimum of Π between −3 and 3 rad in place of the root of dΠ/dθ, as tight as the arithmetic
  allows; *expanded Π*: multiplied out into powers of θ, as computer algebra would give it;
- *radius unknown*: ρ = h/θ between L/7 and 1000 L; *force not turned in the arc*: the moment in Π of a force that keeps the
  direction it has on the straight arc; *to the next arc*: its components handed on unturned.

## Absolute tolerances

The search stops when its bracket (for the root: its step) is no longer than the tolerance, in rad; for the radius, in
lengths L.

{tolerances}
How often, then? 41 tolerances from 1e-4 to 1e-2 rad for each of the two searches that stop where they are told, and how
many of the curves have what is printed:

{census}
## The mechanism, measured

For each arc, its angle minus the sound law's angle for the same wrench. *Bias*: their sum, the rotation by which the whole
rod is wrong; on a lever of L/2 = 20 mm it moves the tip by the next column. *Scatter*: the root of the sum of squares
about the mean. *Largest relative error* of an arc's angle. *Lost in sums*: tip minus the tip summed up soundly from the
same angles. *Drift of the moment*: the moment at the clamp over the one that sound arithmetic carries there through the
same angles, minus 1.

{mechanism}
- **Absolute tolerance with a bracket**: the angle of an arc at N = 5000 is 5e-04 rad; stopped at 1e-03 the search returns
  one of a few grid values, wrong by up to {r5000} of the angle itself, the same for many neighbouring arcs. The errors
  therefore add up as a bias, at 5000 far above what their scatter would leave by chance: {b500} rad at 500, {b5000} rad at
  5000.
- **Single precision**: the search finds each angle to the digits of the format, and its bias explains little of the error.
  What grows is rounding where N small terms are added: the wrench carried from arc to arc (its moment drifts by {d12} at 12
  arcs, {d500} at 500 and {d5000} at 5000) and the sum of positions. A moment wrong by that share bends the rod's 2.3 rad
  wrong by as much, on a lever of L/2: {m5000} mm at 5000 arcs, beside the error of {s5000} mm.
- **A minimiser** resolves an angle only to about the square root of the precision, because Π is flat at its minimum; the
  largest relative error is the same at every N, so the sum over the arcs stays where it is and makes no rise. Multiplied
  out, Π cancels and loses more: in single precision a floor ({e500} mm at 500 arcs), still no rise.
- **Unsafe forms** cancel. Relative error of (1 − cos θ)/θ² as written:

{cancellation}
  In double precision this never matters here; in single precision it reaches {c5000} at 5000 arcs, but it enters the
  sideways offset of an arc, which is itself of second order in the angle: {u5000} mm are lost in sums with unsafe forms,
  {w5000} mm without.
- **Force not turned in the arc** leaves the law of second order with a larger error: {i12} mm at 12 arcs, {i500} at 500 and
  {i5000} at 5000. **Not turned to the next arc** solves another problem: the error settles and no N helps.

Files: `ablation.csv`, `trends.csv`, `census.csv`, `cancellation.csv`.
)",
      fmt::arg("all",
               names_of(data, [](const Trend& t) { return t.minimum_near_12() && t.under_3_mm() && t.rises(); })),
      fmt::arg("c1", data.censuses[0].all_three), fmt::arg("c2", data.censuses[2].all_three),
      fmt::arg("c3", data.censuses[1].all_three), fmt::arg("c4", data.censuses[3].all_three),
      fmt::arg("rising", names_of(data, [](const Trend& t) { return t.rises(); })),
      fmt::arg("s5000", error("single precision", 5000)), fmt::arg("fe12", fe("sound: double, root of dPi/dtheta", 12)),
      fmt::arg("h12", fe("golden section 3e-03", 12)), fmt::arg("h500", fe("golden section 3e-03", 500)),
      fmt::arg("h5000", fe("golden section 3e-03", 5000)), fmt::arg("g12", fe("bisection 1e-03", 12)),
      fmt::arg("g500", fe("bisection 1e-03", 500)), fmt::arg("g5000", fe("bisection 1e-03", 5000)),
      fmt::arg("census", census_table(data)), fmt::arg("n12", error("force not turned to the next arc", 12)),
      fmt::arg("n500", error("force not turned to the next arc", 500)), fmt::arg("frame", fixed(fixed_frame_mm, 1)),
      fmt::arg("alone", trend_table(data, false)), fmt::arg("tolerances", trend_table(data, true)),
      fmt::arg("mechanism", mechanism_table(data)),
      fmt::arg("r5000", one_digit(point(data.row("golden section 1e-03"), 5000).largest_relative)),
      fmt::arg("b500", one_digit(point(data.row("golden section 1e-03"), 500).bias_rad)),
      fmt::arg("b5000", one_digit(point(data.row("golden section 1e-03"), 5000).bias_rad)),
      fmt::arg("m5000", one_digit(2.3 * 20 * point(data.row("single precision"), 5000).drift)),
      fmt::arg("d12", one_digit(point(data.row("single precision"), 12).drift)),
      fmt::arg("d500", one_digit(point(data.row("single precision"), 500).drift)),
      fmt::arg("d5000", one_digit(point(data.row("single precision"), 5000).drift)),
      fmt::arg("i12", error("force not turned in the arc", 12)),
      fmt::arg("i500", error("force not turned in the arc", 500)),
      fmt::arg("i5000", error("force not turned in the arc", 5000)),
      fmt::arg("e500", error("single, golden, expanded Pi", 500)), fmt::arg("cancellation", cancellation_table(data)),
      fmt::arg("u5000", one_digit(point(data.row("single, unsafe"), 5000).sums_mm)),
      fmt::arg("w5000", one_digit(point(data.row("single precision"), 5000).sums_mm)),
      fmt::arg("c5000", one_digit(data.cancellations.back().single_precision)));
}

}  // namespace

// Weak arithmetic is chaotic, and more digits would not come out again under other compilers.
std::string one_digit(double value) {
  constexpr double round_off = 1e-12;
  return std::isfinite(value) ? scientific(std::max(std::abs(value), round_off), 0) : "–";
}

std::map<std::string, std::string> ablation_files(const AblationData& data, double fixed_frame_mm) {
  return {{"ablation.md", page(data, fixed_frame_mm)},
          {"ablation.csv", ablation_csv(data)},
          {"trends.csv", trends_csv(data)},
          {"cancellation.csv", cancellation_csv(data)},
          {"census.csv", census_csv(data)},
          {"ablation.svg", ablation_picture(data)}};
}

}  // namespace studies
