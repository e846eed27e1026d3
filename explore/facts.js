// What the page says of the two shapes.

const mm = (value, digits = 4) => value === null || value === undefined ? "–" : `${Number(value.toPrecision(digits))} mm`;

function snapText(page) {
  const {limit} = page;
  if (!limit || page.limitOf !== page.text) return "…";
  if (limit.error) return limit.error;
  if (limit.kind === "fold") return `snaps at ${Number(limit.load_factor.toPrecision(4))} × this load`;
  if (limit.kind) return `buckles (branch point) at ${Number(limit.load_factor.toPrecision(4))} × this load`;
  const end = limit.status === "reached" ? "" : `, where its path ends: ${limit.status.replaceAll("_", " ")}`;
  return `no snap up to ${Number(limit.looked_up_to.toPrecision(3))} × this load${end}`;
}

function timeOf(page, answer, i) {
  if (answer.error) return "–";
  return page.timesOf !== page.asked() ? "…" : page.times_us[i] > 0 ? timeText(page.times_us[i]) : "–";
}

function modelText({model}) {
  const parts = [model.law?.replace("_", " "), model.arcs && `${model.arcs} ${model.arcs === 1 ? "arc" : "arcs"}`,
                 model.planar ? "in a plane" : "in space", model.shear ? "with shear" : "without shear"];
  return parts.filter(Boolean).join(", ");
}

function comparedName({law, arcs, tolerance_mm}) {
  return `compared: ${law === "auto" ? "automatic" : law.replace("_", " ")}, ` + (arcs ? `${arcs} arcs` : `within ${tolerance_mm} mm`);
}

function tell(page) {
  const {accurate, compared, model} = page, good = answer => answer && !answer.error && answer.status === "converged";
  byId("scene-error").textContent = accurate?.error ?? "";
  byId("compared-name").textContent = comparedName(page.options());
  const outcome = answer => answer.error ? "no answer" : answer.status === "converged" ? "converged"
    : `${answer.status.replaceAll("_", " ")}: ${answer.message}`;
  byId("outcome").textContent = accurate.error ? `No rod: ${accurate.error}`
    : good(accurate) && good(compared)
    ? `The compared shape is ${mm(page.distance(), 3)} away at most, ${(100 * page.distance() / page.length()).toPrecision(2)} % of the length.`
    : `accurate: ${outcome(accurate)}; compared: ${outcome(compared)}. What did not converge is not drawn.`;
  const stable = {true: "yes", false: "no"};
  const rows = [
    ["status", ...[accurate, compared].map(outcome)],
    ["tip x, y, z, mm", ...[accurate, compared].map(a => good(a) ? a.tip.position_mm.map(x => x.toFixed(4)).join(", ") : "–")],
    ["estimated error", ...[accurate, compared].map(a => good(a) ? mm(a.error_estimate_mm, 2) : "–")],
    ["model", ...[accurate, compared].map(a => good(a) ? modelText(a) : "–")],
    ["stable", ...[accurate, compared].map(a => good(a) ? stable[a.stable] ?? "not decided: it is for fixed forces, gravity and tendons" : "–")],
    ["time of a solve", ...[accurate, compared].map((a, i) => timeOf(page, a, i))],
    ["as the load grows", accurate.error ? "–" : snapText(page), ""],
  ];
  byId("facts").tBodies[0].replaceChildren(...rows.map(([name, ...cells]) =>
    element("tr", {}, element("th", {scope: "row"}, name), ...cells.map(cell => element("td", {}, cell)))));
  byId("reason").textContent = good(model) ? `for 1e−3 of the length ${modelText(model)} suffice: ${model.model.reason ?? "as asked"}.` : "–";
}
