// The loads of a scene as fields: one fieldset a load, its numbers, its frame.

const loadKinds = {
  force: {key: "value_N", unit: "N", axes: ["x", "y", "z"], framed: true},
  moment: {key: "value_Nmm", unit: "N mm", axes: ["x", "y", "z"], framed: true},
  distributed_force: {key: "value_N_per_mm", unit: "N/mm", axes: ["x", "y", "z"], framed: true},
  gravity: {key: "acceleration_m_per_s2", unit: "m/s²", axes: ["x", "y", "z"]},
  tendon: {key: "tension_N", unit: "N", axes: ["tension"]},
};

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

const placeOf = load => load.kind === "gravity" ? "the whole rod" : load.kind === "distributed_force"
  ? `from ${load.from_mm ?? 0} to ${load.to_mm ?? "the tip"}` : load.kind === "tendon"
  ? `to ${load.to_mm ?? "the tip"}` : load.at === "tip" ? "at the tip" : `at ${load.at} mm`;

// Whether the fields can show these loads: while one types they are anything, and FAM says what is wrong.
const areLoads = loads => Array.isArray(loads) && loads.every(load => {
  const known = loadKinds[load?.kind], values = known && [load[known.key]].flat();
  return known && values.length === known.axes.length && values.every(Number.isFinite);
});

const roughly = value => Number(value.toPrecision(6));
const isArrow = load => load.kind === "force" || load.kind === "moment";

class LoadEditor {
  // changed(what): a load was selected, or its numbers or frame changed, or it was removed.
  constructor(parent, changed) {
    this.parent = parent;
    this.changed = changed;
  }

  // Builds the fields again where the loads are others, else renews the numbers that nobody is typing in.
  show(loads, selected) {
    const shape = JSON.stringify(loads.map(load => [load.kind, placeOf(load)]));
    if (shape !== this.shape) this.build(loads);
    this.shape = shape;
    loads.forEach((load, i) => {
      const {set, radio, frame, numbers} = this.rows[i];
      set.classList.toggle("selected", i === selected);
      if (radio) radio.checked = i === selected;
      if (frame) frame.value = load.frame;
      const values = [load[loadKinds[load.kind].key]].flat();
      numbers.forEach((input, k) => {
        if (input !== document.activeElement) input.value = roughly(values[k]);
      });
    });
  }

  build(loads) {
    this.rows = loads.map((load, i) => this.row(load, i));
    this.parent.replaceChildren(...this.rows.map(row => row.set));
    if (loads.length === 0) this.parent.append("none");
  }

  row(load, i) {
    const {key, unit, axes, framed} = loadKinds[load.kind];
    const title = `${load.kind.replace("_", " ")} ${placeOf(load)}`;
    const numbers = axes.map((axis, k) => element("input", {
      type: "number", step: "any", "aria-label": `${title}, ${axis}, ${unit}`,
      oninput: event => this.number(i, key, axes.length > 1 ? k : null, event.target.valueAsNumber),
    }));
    const frame = framed && element("select", {"aria-label": `${title}, frame`, onchange: event => {
      this.changed({load: i, key: "frame", value: event.target.value});
    }}, element("option", {value: "follower"}, "follower"), element("option", {value: "fixed"}, "fixed"));
    const radio = isArrow(load) && element("input", {type: "radio", name: "selected-load", "aria-label": `select the ${title}`,
      onchange: () => this.changed({select: i})});
    const remove = element("button", {type: "button", "aria-label": `remove the ${title}`, onclick: () => this.changed({remove: i})}, "remove");
    const set = element("fieldset", {}, element("legend", {}, radio ? element("label", {}, radio, title) : title),
      element("div", {className: "row"}, ...numbers.map((input, k) => element("label", {}, axes[k], input)), unit,
              ...(frame ? [frame] : []), remove));
    return {set, radio, frame, numbers};
  }

  number(i, key, component, value) {
    if (Number.isFinite(value)) this.changed({load: i, key, component, value});
  }
}
