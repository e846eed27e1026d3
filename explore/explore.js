// The page: a scene, its shapes by FAM in two workers (one solves as one drags, one times and looks for the snap).

const mostSeconds = 20;  // that a worker may take for an answer
const accurateOverL = 1e-9, modelOverL = 1e-3;
const quietMs = 250;  // after the last change, before the slow questions
const stationsDrawn = 160;
const byId = id => document.getElementById(id);

class Fam {
  constructor(source, wasm) {
    Object.assign(this, {source, wasm, waiting: new Map(), next: 0});
    this.start();
  }

  start() {
    this.worker = new Worker(URL.createObjectURL(new Blob([this.source], {type: "text/javascript"})));
    this.ready = new Promise((resolve, reject) => {
      this.worker.onerror = event => reject(new Error(event.message));
      this.worker.onmessage = ({data}) => {
        if (data.ready) return resolve();
        this.waiting.get(data.id)?.(data.result);
        this.waiting.delete(data.id);
      };
    });
    this.worker.postMessage({wasm: this.wasm});
  }

  // {"error"} where the answer takes longer than anybody waits; the worker then begins again.
  async ask(name, ...args) {
    await this.ready;
    const id = this.next++;
    return new Promise(resolve => {
      const late = setTimeout(() => {
        this.worker.terminate();
        const left = [...this.waiting.values()];
        this.waiting.clear();
        this.start();
        for (const give of left) give({error: `no answer in ${mostSeconds} s`});
      }, 1000 * mostSeconds);
      this.waiting.set(id, result => {
        clearTimeout(late);
        resolve(result);
      });
      this.worker.postMessage({id, name, args});
    });
  }
}

const lengthOf = scene => scene.rod.sections.reduce((sum, section) => sum + section.length_mm, 0);

// The centreline between its stations: cubic, along the sections' normals at the ends (without shear: for the eye).
function positionAt(centreline, s_mm) {
  let i = 0;
  while (i + 2 < centreline.length && centreline[i + 1].s_mm < s_mm) i++;
  const [a, b] = [centreline[i], centreline[i + 1]];
  if (!b) return a.position_mm;
  const h = b.s_mm - a.s_mm, t = Math.min(1, Math.max(0, (s_mm - a.s_mm) / h)), along = R => R.map(row => row[0]);
  const [u, v] = [along(a.rotation), along(b.rotation)];
  return [0, 1, 2].map(k => (1 + 2 * t) * (1 - t) ** 2 * a.position_mm[k] + t * (1 - t) ** 2 * h * u[k] +
                            t * t * (3 - 2 * t) * b.position_mm[k] + t * t * (t - 1) * h * v[k]);
}

// The station nearest to a place.
const stationAt = (centreline, s_mm) =>
  centreline.reduce((best, station) => Math.abs(station.s_mm - s_mm) < Math.abs(best.s_mm - s_mm) ? station : best);

const evenly = (length, count) => Array.from({length: count + 1}, (_, i) => i / count * length);
const mm = (value, digits = 4) => value === null || value === undefined ? "–" : `${Number(value.toPrecision(digits))} mm`;

class Explorer {
  constructor(data, solver, slow) {
    Object.assign(this, {data, solver, slow, selected: 0, accurate: null, compared: null, version: 0, scale: {}});
    this.view = new View(byId("view"));
    this.editor = new LoadEditor(byId("loads"), what => this.editLoad(what));
    this.chart = new WorkChart(data.chart);
    byId("commit").textContent = data.commit;
    this.listScenes();
    this.connectOptions();
    this.connectFile();
    this.connectCanvas();
    new ResizeObserver(() => this.draw()).observe(byId("view"));
    addEventListener("hashchange", () => this.openLink());
    if (!this.openLink()) this.open(data.scenes.findIndex(entry => entry.name === "S1 follower"));
  }

  listScenes() {
    const list = byId("scene-list"), groups = [...new Set(this.data.scenes.map(entry => entry.group))];
    list.append(element("option", {value: "own", hidden: true}, "your own"));
    for (const group of groups) {
      list.append(element("optgroup", {label: group}, ...this.data.scenes.flatMap((entry, i) =>
        entry.group === group ? [element("option", {value: String(i)}, entry.name)] : [])));
    }
    list.addEventListener("change", () => this.open(Number(list.value)));
  }

  connectOptions() {
    const laws = {published: "published", midpoint: "midpoint", fourth_order: "fourth order", sixth_order: "sixth order", auto: "automatic"};
    byId("law").append(...Object.entries(laws).map(([value, name]) => element("option", {value}, name)));
    byId("amount").value = 10;
    byId("resolution").addEventListener("change", event => {
      const arcs = event.target.value === "arcs";
      byId("amount-name").textContent = arcs ? "Arcs" : "Tolerance, mm";
      byId("amount").value = arcs ? 10 : roughly(modelOverL * this.length());
      this.changed();
    });
    for (const id of ["law", "amount", "after-snap"]) byId(id).addEventListener("input", () => this.changed());
  }

  options() {
    const arcs = byId("resolution").value === "arcs", amount = byId("amount").valueAsNumber || 0;
    return {law: byId("law").value, arcs: arcs ? Math.max(1, Math.round(amount)) : 0, tolerance_mm: arcs ? 0 : amount,
            after_snap: byId("after-snap").checked};
  }

  connectFile() {
    byId("scene-text").addEventListener("input", () => {
      byId("scene-list").value = "own";
      this.read(byId("scene-text").value);
    });
    byId("download").addEventListener("click", () => {
      const url = URL.createObjectURL(new Blob([byId("scene-text").value], {type: "application/json"}));
      element("a", {href: url, download: "scene.json"}).click();
      setTimeout(() => URL.revokeObjectURL(url), 1000);
    });
    byId("upload").addEventListener("change", async event => {
      if (event.target.files.length > 0) this.show(await event.target.files[0].text());
      event.target.value = "";
    });
    byId("link").addEventListener("click", () => {
      if (!this.scene) return;
      history.replaceState(null, "", "#scene=" + encodeURIComponent(JSON.stringify(this.scene)));
      byId("link-note").textContent = "The address of this page now holds the scene: copy it from the address bar.";
    });
    byId("add-force").addEventListener("click", () => this.addLoad("force", "value_N"));
    byId("add-moment").addEventListener("click", () => this.addLoad("moment", "value_Nmm"));
  }

  openLink() {
    const match = location.hash.match(/^#scene=(.*)$/);
    if (!match) return false;
    try {
      this.show(JSON.stringify(JSON.parse(decodeURIComponent(match[1])), null, 1));
    } catch (error) {
      byId("scene-error").textContent = `link: ${error.message}`;
      return false;
    }
    return true;
  }

  open(index) {
    byId("scene-list").value = String(index);
    this.show(JSON.stringify(this.data.scenes[index].scene, null, 1), String(index));
  }

  show(text, listed = "own") {
    byId("scene-list").value = listed;
    byId("scene-text").value = text;
    this.scale = {};
    this.selected = 0;
    this.read(text);
    if (this.scene) this.view.frame(this.length());
  }

  length() {
    return this.scene ? lengthOf(this.scene) : 1;
  }

  // What cannot be a scene leaves no rod behind; FAM says why.
  read(text) {
    this.text = text;
    try {
      const scene = JSON.parse(text);
      if (!(lengthOf(scene) > 0)) throw new Error("no length");
      this.scene = scene;
      this.scene.loads ??= [];
    } catch {
      this.scene = null;
    }
    if (this.scene && this.scene.loads.every(load => loadKinds[load.kind])) this.editor.show(this.scene.loads, this.selected);
    this.changed();
  }

  write() {
    this.text = JSON.stringify(this.scene, null, 1);
    byId("scene-text").value = this.text;
    byId("scene-list").value = "own";
    this.editor.show(this.scene.loads, this.selected);
    this.changed();
  }

  editLoad({select, remove, load, key, component, value}) {
    if (!this.scene) return;
    if (select !== undefined) {
      this.selected = select;
      this.editor.show(this.scene.loads, this.selected);
      return this.draw();
    }
    if (remove !== undefined) this.scene.loads.splice(remove, 1);
    else if (component === null || component === undefined) this.scene.loads[load][key] = value;
    else this.scene.loads[load][key][component] = value;
    this.scale = {};
    this.write();
  }

  // Of a size that is seen: EI/L² or EI/L of the first section, where the file gives it.
  addLoad(kind, key) {
    if (!this.scene) return;
    const bending = [this.scene.rod.sections[0].stiffness?.bending_Nmm2 ?? this.length() ** 2].flat()[0];
    const size = kind === "force" ? 0.5 * bending / this.length() ** 2 : 0.5 * bending / this.length();
    this.scene.loads.push({kind, at: "tip", frame: "fixed", [key]: kind === "force" ? [0, roughly(size), 0] : [0, 0, roughly(size)]});
    this.selected = this.scene.loads.length - 1;
    this.scale = {};
    this.write();
  }

  // Solves the newest scene; one solve at a time, and the last one always comes.
  changed() {
    this.version++;
    clearTimeout(this.quiet);
    this.quiet = setTimeout(() => this.askSlowly(), quietMs);
    this.settled = this.settled ?? this.solveNewest();
    return this.settled;
  }

  async solveNewest() {
    for (let solved = -1; solved !== this.version;) {
      solved = this.version;
      const text = this.text, length = this.length(), after_snap = this.options().after_snap;
      const asked = [{tolerance_mm: accurateOverL * length, after_snap}, this.options(), {tolerance_mm: modelOverL * length, after_snap}];
      const [accurate, compared, model] =
        await Promise.all(asked.map(options => this.solver.ask("solve", text, JSON.stringify(options))));
      Object.assign(this, {accurate, compared, model});
      this.draw();
      this.tell();
    }
    this.settled = null;
  }

  async askSlowly() {
    const version = this.version, text = this.text, length = this.length();
    if (!this.scene || this.accurate?.error) return;
    const options = [{tolerance_mm: accurateOverL * length}, this.options()];
    const times_us = [];
    for (const each of options) times_us.push(await this.slow.ask("time_us", text, JSON.stringify(each)));
    if (version !== this.version) return;
    this.times_us = times_us;
    this.tell();
    const limit = await this.slow.ask("limit", text);
    if (version !== this.version) return;
    Object.assign(this, {limit, limitOf: text});
    this.tell();
  }

  snapText() {
    const {limit} = this;
    if (!limit || this.limitOf !== this.text) return "…";
    if (limit.error) return limit.error;
    if (limit.kind === "fold") return `snaps at ${Number(limit.load_factor.toPrecision(4))} × this load`;
    if (limit.kind) return `buckles (branch point) at ${Number(limit.load_factor.toPrecision(4))} × this load`;
    return `no snap up to ${Number(limit.looked_up_to.toPrecision(3))} × this load`;
  }

  tell() {
    const {accurate, compared, model} = this, good = answer => answer && !answer.error && answer.status === "converged";
    byId("scene-error").textContent = accurate?.error ?? "";
    byId("compared-name").textContent = this.comparedName();
    const outcome = answer => answer.error ? "no answer" : answer.status === "converged" ? "converged"
      : `${answer.status.replaceAll("_", " ")}: ${answer.message}`;
    byId("outcome").textContent = accurate.error ? "No rod: the scene file has an error, below."
      : good(accurate) && good(compared)
      ? `The compared shape is ${mm(this.distance(), 3)} away at most, ${(100 * this.distance() / this.length()).toPrecision(2)} % of the length.`
      : `accurate: ${outcome(accurate)}; compared: ${outcome(compared)}. What did not converge is not drawn.`;
    const stable = {true: "yes", false: "no"};
    const rows = [
      ["status", ...[accurate, compared].map(outcome)],
      ["tip x, y, z, mm", ...[accurate, compared].map(a => good(a) ? a.tip.position_mm.map(x => x.toFixed(4)).join(", ") : "–")],
      ["estimated error", ...[accurate, compared].map(a => good(a) ? mm(a.error_estimate_mm, 2) : "–")],
      ["model", ...[accurate, compared].map(a => good(a) ? this.modelText(a) : "–")],
      ["stable", ...[accurate, compared].map(a => good(a) ? stable[a.stable] ?? "not told" : "–")],
      ["time of a solve", ...[0, 1].map(i => this.times_us?.[i] > 0 ? timeText(this.times_us[i]) : "–")],
      ["as the load grows", accurate.error ? "–" : this.snapText(), ""],
    ];
    byId("facts").tBodies[0].replaceChildren(...rows.map(([name, ...cells]) =>
      element("tr", {}, element("th", {scope: "row"}, name), ...cells.map(cell => element("td", {}, cell)))));
    byId("reason").textContent = good(model) ? `for 1e−3 of the length ${this.modelText(model)} suffice: ${model.model.reason ?? "as asked"}.` : "–";
  }

  modelText({model}) {
    const parts = [model.law?.replace("_", " "), model.arcs && `${model.arcs} ${model.arcs === 1 ? "arc" : "arcs"}`,
                   model.planar ? "in a plane" : "in space", model.shear ? "with shear" : "without shear"];
    return parts.filter(Boolean).join(", ");
  }

  comparedName() {
    const {law, arcs, tolerance_mm} = this.options();
    return `compared: ${law === "auto" ? "automatic" : law.replace("_", " ")}, ` + (arcs ? `${arcs} arcs` : `within ${tolerance_mm} mm`);
  }

  // The largest along the rod, mm.
  distance() {
    return Math.max(...evenly(this.length(), stationsDrawn).map(s =>
      norm(add(positionAt(this.accurate.centreline, s), times(positionAt(this.compared.centreline, s), -1)))));
  }

  rods() {
    const drawn = [], length = this.length(), places = evenly(length, stationsDrawn);
    if (!this.scene) return drawn;
    drawn.push({points: [[0, 0, 0], [length, 0, 0]], dashed: true, colour: "#8a8a8a"});
    for (const [answer, colour] of [[this.compared, [18, 65, 45]], [this.accurate, [209, 88, 36]]]) {
      if (!answer || answer.error || answer.status !== "converged") continue;
      drawn.push({points: places.map(s => positionAt(answer.centreline, s)), radius_mm: places.map(s => this.radius(s)), colour});
    }
    return drawn;
  }

  radius(s_mm) {
    let end = 0;
    const section = this.scene.rod.sections.find(each => (end += each.length_mm) >= s_mm) ?? this.scene.rod.sections.at(-1);
    return (section.geometry?.outer_diameter_mm ?? this.length() / 40) / 2;
  }

  // Each force and moment: where it acts, its value in the base frame, mm a unit, the section's frame if it follows that.
  arrows() {
    if (!this.scene || !this.accurate || this.accurate.error || this.accurate.status !== "converged") return [];
    return this.scene.loads.flatMap((load, index) => {
      if (!isArrow(load)) return [];
      const value = load[loadKinds[load.kind].key];
      const station = stationAt(this.accurate.centreline, load.at === "tip" ? this.length() : load.at);
      const frame = load.frame === "follower" ? station.rotation : null, offset = load.offset_mm ?? [0, 0];
      const from = add(station.position_mm, turned(station.rotation, [0, ...offset]));
      const value_B = frame ? turned(frame, value) : value, unit = this.unit(load.kind);
      return [{index, from, value_B, unit, frame, to: add(from, times(value_B, unit)), moment: load.kind === "moment",
               selected: index === this.selected}];
    });
  }

  // Millimetres for 1 N or N mm: stays while one drags.
  unit(kind) {
    const sizes = this.scene.loads.filter(load => load.kind === kind).map(load => norm(load[loadKinds[kind].key]));
    return this.scale[kind] ??= longestArrow * this.length() / (Math.max(...sizes) || 1);
  }

  draw() {
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.view.draw({rods: this.rods(), arrows: this.arrows()}));
  }

  // Moves the head of an arrow by a way in the base frame, mm.
  pull(index, way_B_mm) {
    const arrow = this.arrows().find(each => each.index === index);
    if (!arrow) return;
    const load = this.scene.loads[index], change = times(way_B_mm, 1 / arrow.unit);
    load[loadKinds[load.kind].key] = add(load[loadKinds[load.kind].key], arrow.frame ? turnedBack(arrow.frame, change) : change).map(roughly);
    this.write();
  }

  connectCanvas() {
    const canvas = byId("view"), down = new Map();
    let held = null;
    const place = event => ({x: event.offsetX, y: event.offsetY});
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      down.set(event.pointerId, place(event));
      const near = this.arrows().map(arrow => ({arrow, at: this.view.project(arrow.to)}))
        .map(({arrow, at}) => ({arrow, away: Math.hypot(at.x - event.offsetX, at.y - event.offsetY)}))
        .filter(({away}) => away < 2 * handleRadius).sort((a, b) => a.away - b.away)[0];
      held = down.size === 1 && near ? near.arrow.index : null;
      if (held !== null) this.editLoad({select: held});
    });
    canvas.addEventListener("pointermove", event => {
      const before = down.get(event.pointerId), now = place(event);
      if (!before) return;
      const [dx, dy] = [now.x - before.x, now.y - before.y], others = [...down].filter(([id]) => id !== event.pointerId);
      if (others.length > 0) {
        const other = others[0][1], away = p => Math.hypot(p.x - other.x, p.y - other.y) || 1;
        this.zoom(away(now) / away(before));
      } else if (held !== null) {
        this.pull(held, this.view.inSpace(dx, dy));
      } else {
        this.view.turn(0.008 * dx, 0.008 * -dy);
        this.draw();
      }
      down.set(event.pointerId, now);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => down.delete(event.pointerId));
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      this.zoom(Math.exp(-0.0015 * event.deltaY));
    }, {passive: false});
    canvas.addEventListener("keydown", event => {
      if (this.key(event)) event.preventDefault();
    });
  }

  zoom(factor) {
    this.view.zoom = Math.min(20, Math.max(0.2, this.view.zoom * factor));
    this.draw();
  }

  // Whether the key means something here.
  key({key, shiftKey}) {
    const way = {ArrowRight: [1, 0, 0], ArrowLeft: [-1, 0, 0], ArrowUp: [0, -1, 0], ArrowDown: [0, 1, 0],
                 PageUp: [0, 0, 1], PageDown: [0, 0, -1]}[key];
    if (key === "+" || key === "=") this.zoom(1.15);
    else if (key === "-") this.zoom(1 / 1.15);
    else if (key === "n" || key === "N") this.selectNext();
    else if (way && shiftKey) {
      this.view.turn(0.1 * way[0], -0.1 * way[1]);
      this.draw();
    } else if (way) this.pull(this.selected, this.view.inSpace(...times(way, 6)));
    else return false;
    return true;
  }

  selectNext() {
    const arrows = this.arrows();
    if (arrows.length === 0) return;
    const at = arrows.findIndex(arrow => arrow.index === this.selected);
    this.editLoad({select: arrows[(at + 1) % arrows.length].index});
  }
}

async function start() {
  const packed = Uint8Array.from(atob(byId("wasm").textContent.trim()), c => c.charCodeAt(0));
  const wasm = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
  const source = byId("loader").textContent + byId("worker").textContent;
  const [solver, slow] = [new Fam(source, wasm), new Fam(source, wasm)];
  await Promise.all([solver.ready, slow.ready]);
  return new Explorer(JSON.parse(byId("data").textContent), solver, slow);
}

const explorer = start();
explorer.catch(error => byId("outcome").textContent = `The page cannot start here: ${error.message}`);
