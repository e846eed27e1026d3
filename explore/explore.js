// The page: a scene, its shapes by FAM in two workers (one solves as one drags, one times and looks for the snap). What is
// drawn and told in each frame is the two shapes; all else waits until it is quiet.

const accurateOverL = 1e-9, modelOverL = 1e-3;
const quietMs = 250;  // after the last change, before the slow questions
const stationsDrawn = 160;
const byId = id => document.getElementById(id);

const lengthOf = scene => scene.rod.sections.reduce((sum, section) => sum + section.length_mm, 0);

const evenly = (length, count) => Array.from({length: count + 1}, (_, i) => i / count * length);
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
    this.hands = new Hands(this);
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
    const tolerance_mm = Math.max(amount, accurateOverL * this.length());  // 0 would be FAM's own choice
    return {law: byId("law").value, arcs: arcs ? Math.max(1, Math.round(amount)) : 0, tolerance_mm: arcs ? 0 : tolerance_mm,
            after_snap: byId("after-snap").checked};
  }

  connectFile() {
    byId("scene-text").addEventListener("input", () => {
      byId("scene-list").value = "own";
      this.read(byId("scene-text").value);
    });
    byId("download").addEventListener("click", () => {
      const url = URL.createObjectURL(new Blob([this.text], {type: "application/json"}));
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
      byId("link-note").textContent = `The link holds no scene: ${error.message}`;
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
      scene.loads ??= [];
      if (!areLoads(scene.loads)) throw new Error("no loads");
      this.scene = scene;
      this.select();
    } catch {
      this.scene = null;
    }
    this.changed();
  }

  // A load that the keys can change, where there is one.
  select() {
    const {loads} = this.scene;
    if (!loads[this.selected] || !isArrow(loads[this.selected])) this.selected = Math.max(0, loads.findIndex(isArrow));
    this.editor.show(loads, this.selected);
  }

  // The field with the scene file follows when it is quiet: laying out its text took half of a frame's layout.
  write() {
    this.text = JSON.stringify(this.scene, null, 1);
    byId("scene-list").value = "own";
    this.select();
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
      const asked = [{tolerance_mm: accurateOverL * length, after_snap}, this.options()];
      const [accurate, compared] = await this.solver.askAll(asked.map(options => ["solve", text, JSON.stringify(options)]));
      Object.assign(this, {accurate, compared});
      this.draw();
      tell(this);
    }
    this.settled = null;
  }

  async askSlowly() {
    if (byId("scene-text").value !== this.text) byId("scene-text").value = this.text;
    const version = this.version, text = this.text, length = this.length(), asked = this.asked();
    if (!this.scene || this.accurate?.error) return;
    const options = [{tolerance_mm: accurateOverL * length}, this.options()];
    const suffices = {tolerance_mm: modelOverL * length, after_snap: this.options().after_snap};
    const model = await this.solver.ask("solve", text, JSON.stringify(suffices));
    if (version !== this.version) return;
    Object.assign(this, {model, modelOf: asked});
    tell(this);
    const times_us = [];
    for (const each of options) times_us.push(await this.slow.ask("time_us", text, JSON.stringify(each)));
    if (version !== this.version) return;
    Object.assign(this, {times_us, timesOf: asked});
    tell(this);
    const limit = await this.slow.ask("limit", text);
    if (version !== this.version) return;
    Object.assign(this, {limit, limitOf: text});
    tell(this);
  }

  // What the slow answers belong to.
  asked() {
    return this.text + JSON.stringify(this.options());
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
    // The compared one thinner and in front: a small distance shows, too.
    for (const [answer, colour, share] of [[this.accurate, [209, 88, 36], 1], [this.compared, [18, 75, 50], 0.4]]) {
      if (!answer || answer.error || answer.status !== "converged") continue;
      drawn.push({points: places.map(s => positionAt(answer.centreline, s)), radius_mm: places.map(s => this.radius(s)), colour, share});
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
