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

// Writes a text where it is another: a table that stays as it is is not laid out again.
function put(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

function reasonText(page, good) {
  const {model} = page;
  if (page.accurate?.error) return "–";
  if (page.modelOf !== page.asked()) return "…";
  return good(model) ? `for 1e−3 of the length ${modelText(model)} suffice: ${model.model.reason ?? "as asked"}.` : "–";
}

function tell(page) {
  const {accurate, compared} = page, good = answer => answer && !answer.error && answer.status === "converged";
  put(byId("scene-error"), accurate?.error ?? "");
  put(byId("compared-name"), comparedName(page.options()));
  const outcome = answer => answer.error ? "no answer" : answer.status === "converged" ? "converged"
    : `${answer.status.replaceAll("_", " ")}: ${answer.message}`;
  const away_mm = good(accurate) && good(compared) ? page.distance() : null;
  put(byId("outcome"), accurate.error ? `No rod: ${accurate.error}` : away_mm !== null
    ? `The compared shape is ${mm(away_mm, 3)} away at most, ${(100 * away_mm / page.length()).toPrecision(2)} % of the length.`
    : `accurate: ${outcome(accurate)}; compared: ${outcome(compared)}. What did not converge is not drawn.`);
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
  const table = byId("facts").tBodies[0];
  if (table.rows.length === 0) {
    table.append(...rows.map(([name]) =>
      element("tr", {}, element("th", {scope: "row"}, name), element("td"), element("td"))));
  }
  rows.forEach(([, ...cells], i) => cells.forEach((text, k) => put(table.rows[i].cells[k + 1], text)));
  put(byId("reason"), reasonText(page, good));
}
