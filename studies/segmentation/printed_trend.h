// What the paper prints of its error over N, drawn beside ours and labelled as printed.
#pragma once

#include "studies/report/chart.h"

namespace studies {

// The printed statement: minimum at N = 12, below 3 mm up to 500, rising beyond (no values are given).
inline void draw_printed_trend(Svg& svg, const Panel& panel) {
  const Stroke stroke{colour::black, 1.6, "5 3"};
  const Point left = panel.at({12, 3}), right = panel.at({500, 3});
  svg.line(left, right, stroke);
  svg.line(left, {left.x, left.y + 12}, stroke);
  svg.line(right, {right.x + 30, right.y - 16}, stroke);
  svg.text({left.x - 4, left.y - 6}, "printed: under 3 mm", Anchor::start, 11);
  svg.text({left.x - 4, left.y + 26}, "12: printed minimum", Anchor::start, 11);
  svg.text({right.x - 18, right.y - 22}, "rises beyond 500 (printed)", Anchor::end, 11);
}

}  // namespace studies
