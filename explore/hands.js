// Mouse, fingers and keys on the picture: they pull the loads and turn the view.

class Hands {
  constructor(page) {
    this.page = page;
    const canvas = page.view.canvas, down = new Map();
    let held = null;
    const place = event => ({x: event.offsetX, y: event.offsetY});
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      down.set(event.pointerId, place(event));
      const near = this.page.arrows().map(arrow => ({arrow, at: this.page.view.project(arrow.to)}))
        .map(({arrow, at}) => ({arrow, away: Math.hypot(at.x - event.offsetX, at.y - event.offsetY)}))
        .filter(({away}) => away < 2 * handleRadius).sort((a, b) => a.away - b.away)[0];
      held = down.size === 1 && near ? near.arrow.index : null;
      if (held !== null) this.page.editLoad({select: held});
    });
    canvas.addEventListener("pointermove", event => {
      const before = down.get(event.pointerId), now = place(event);
      if (!before) return;
      const [dx, dy] = [now.x - before.x, now.y - before.y], others = [...down].filter(([id]) => id !== event.pointerId);
      if (others.length > 0) {
        const other = others[0][1], away = p => Math.hypot(p.x - other.x, p.y - other.y) || 1;
        this.zoom(away(now) / away(before));
      } else if (held !== null) {
        this.page.pull(held, this.page.view.inSpace(dx, dy));
      } else {
        this.page.view.turn(0.008 * dx, 0.008 * -dy);
        this.page.draw();
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
    this.page.view.zoom = Math.min(20, Math.max(0.2, this.page.view.zoom * factor));
    this.page.draw();
  }

  // Whether the key means something here.
  key({key, shiftKey}) {
    const way = {ArrowRight: [1, 0, 0], ArrowLeft: [-1, 0, 0], ArrowUp: [0, -1, 0], ArrowDown: [0, 1, 0],
                 PageUp: [0, 0, 1], PageDown: [0, 0, -1]}[key];
    if (key === "+" || key === "=") this.zoom(1.15);
    else if (key === "-") this.zoom(1 / 1.15);
    else if (key === "n" || key === "N") this.selectNext();
    else if (way && shiftKey) {
      this.page.view.turn(0.1 * way[0], -0.1 * way[1]);
      this.page.draw();
    } else if (way) this.page.pull(this.page.selected, this.page.view.inSpace(...times(way, 6)));
    else return false;
    return true;
  }

  selectNext() {
    const arrows = this.page.arrows();
    if (arrows.length === 0) return;
    const at = arrows.findIndex(arrow => arrow.index === this.page.selected);
    this.page.editLoad({select: arrows[(at + 1) % arrows.length].index});
  }
}
