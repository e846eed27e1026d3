// Work and precision: the median time of each method to an accuracy, and which to take.

const groupNames = {follower: "follower loads", fixed: "fixed loads", robots: "robots"};
const curveColours = {"FAM automatic": "#0b5cad", "FAM sixth order": "#5aa0dc", "FAM fourth order": "#8fb9d8", "FAM published": "#c8501e",
                "RK4 shooting": "#14804a", "exact reference": "#7a2ea0", "finite elements": "#8a6d1f"};
const scientific = value => value.toExponential(0).replace("e-", "e−").replace("e+", "e");
const timeText = us => us === null ? "–" : us >= 1000 ? `${(us / 1000).toPrecision(3)} ms` : `${Number(us.toPrecision(3))} µs`;

class WorkChart {
  constructor(data) {
    this.data = data;
    this.group = document.getElementById("chart-group");
    this.slider = document.getElementById("accuracy");
    this.group.append(...Object.keys(data.groups).map(group => element("option", {value: group}, groupNames[group])));
    Object.assign(this.slider, {min: 0, max: data.targets.length - 1, value: 1});
    for (const input of [this.group, this.slider]) input.addEventListener("input", () => this.show());
    document.getElementById("chart-note").textContent = `Medians over the scenes of results/work_precision, tip error over the length; a
      method that does not get there on most scenes has none. FAM automatic, RK4 with its fewest steps, the exact reference and finite
      elements with their fewest count as called; a bare kernel is told how many arcs suffice. Times of ${data.machine}.`;
    this.show();
  }

  // On how many scenes each of these curves is the fastest at a target.
  wins(curves, target) {
    const count = new Map(curves.map(curve => [curve.name, 0]));
    curves[0].by_scene_us[target].forEach((_, scene) => {
      const first = curves.filter(curve => curve.by_scene_us[target][scene] !== null)
        .sort((a, b) => a.by_scene_us[target][scene] - b.by_scene_us[target][scene])[0];
      if (first) count.set(first.name, count.get(first.name) + 1);
    });
    return [...count].sort((a, b) => b[1] - a[1])[0];
  }

  // {method, wins, scenes, kernel, kernelWins} at the accuracy of the slider.
  advice() {
    const {curves, scenes} = this.data.groups[this.group.value], target = Number(this.slider.value);
    const of = kind => this.wins(curves.filter(curve => curve.kind === kind || curve.kind === "both"), target);
    const [method, wins] = of("called"), [kernel, kernelWins] = of("kernel");
    return {method, wins, scenes, kernel, kernelWins};
  }

  show() {
    const {targets, groups} = this.data, target = Number(this.slider.value), {curves, scenes} = groups[this.group.value];
    const accuracy = scientific(targets[target]);
    document.getElementById("accuracy-text").textContent = `${accuracy} of the length`;
    this.slider.setAttribute("aria-valuetext", `${accuracy} of the length`);
    const {method, wins, kernel, kernelWins} = this.advice();
    const median = name => timeText(curves.find(curve => curve.name === name).median_us[target]);
    document.getElementById("advice").textContent = `Take ${method}: fastest as called on ${wins} of ${scenes} scenes, median ${median(method)}.
      If you know beforehand how many arcs or steps suffice: ${kernel}, on ${kernelWins}, ${median(kernel)}.`;
    document.querySelector("#chart-table tbody").replaceChildren(...curves.map(curve => element("tr",
      {className: curve.name === method ? "best" : ""}, element("th", {scope: "row"}, element("span", {className: "swatch", style: `background: ${curveColours[curve.name]}`}), ` ${curve.name}`),
      element("td", {}, timeText(curve.median_us[target])),
      element("td", {}, `${curve.by_scene_us[target].filter(time => time !== null).length} of ${scenes}`))));
    document.getElementById("chart").innerHTML = this.picture(curves, target);
  }

  picture(curves, target) {
    const [width, height, left, right, top, bottom] = [760, 380, 62, 150, 14, 44];
    const all = curves.flatMap(curve => curve.median_us).filter(time => time !== null);
    const [low, high] = [Math.floor(Math.log10(Math.min(...all))), Math.ceil(Math.log10(Math.max(...all)))];
    const x = i => left + i / (this.data.targets.length - 1) * (width - left - right);
    const y = us => height - bottom - (Math.log10(us) - low) / (high - low) * (height - top - bottom);
    let svg = `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="Median time over accuracy; the table below has the numbers">`;
    for (let power = low; power <= high; power++) {
      const at = y(10 ** power);
      svg += `<line x1="${left}" x2="${width - right}" y1="${at}" y2="${at}" stroke="#e2e6ea"/>
        <text x="${left - 8}" y="${at + 4}" text-anchor="end">${timeText(10 ** power)}</text>`;
    }
    this.data.targets.forEach((value, i) => {
      svg += `<text x="${x(i)}" y="${height - bottom + 18}" text-anchor="middle">${scientific(value)}</text>`;
    });
    svg += `<text x="${(left + width - right) / 2}" y="${height - 6}" text-anchor="middle">tip error over the length</text>
      <line x1="${x(target)}" x2="${x(target)}" y1="${top}" y2="${height - bottom}" stroke="#1c2430" stroke-width="1.5" stroke-dasharray="5 4"/>`;
    const labels = [];
    for (const {name, median_us} of curves) {
      const points = median_us.flatMap((us, i) => us === null ? [] : [[x(i), y(us)]]);
      if (points.length === 0) continue;
      const colour = curveColours[name];
      svg += `<polyline points="${points.map(p => p.join()).join(" ")}" fill="none" stroke="${colour}" stroke-width="2.5"/>`;
      if (median_us[target] !== null) svg += `<circle cx="${x(target)}" cy="${y(median_us[target])}" r="5" fill="${colour}"/>`;
      labels.push({name, colour, at: points.at(-1)});
    }
    labels.sort((a, b) => a.at[1] - b.at[1]);
    labels.forEach((label, i) => {  // beside the curves' ends, one below the other
      label.y = Math.max(label.at[1] + 4, i > 0 ? labels[i - 1].y + 16 : 0);
      svg += `<text x="${width - right + 10}" y="${label.y}" style="fill:${label.colour}">${label.name}</text>`;
      if (label.at[0] < width - right - 1)
        svg += `<line x1="${label.at[0]}" y1="${label.at[1]}" x2="${width - right + 6}" y2="${label.y - 4}" stroke="${label.colour}" stroke-dasharray="1 3"/>`;
    });
    return svg + "</svg>";
  }
}
