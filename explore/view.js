// The rod in 3D on a canvas, orthographic: rods as shaded tubes, loads as arrows with a handle.

const add = (a, b) => a.map((v, i) => v + b[i]);
const times = (a, s) => a.map(v => v * s);
const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
const norm = a => Math.sqrt(dot(a, a));
const turned = (R, a) => R.map(row => dot(row, a));  // R a
const turnedBack = (R, a) => [0, 1, 2].map(i => R[0][i] * a[0] + R[1][i] * a[1] + R[2][i] * a[2]);  // R^T a

const handleRadius = 9;  // px
const longestArrow = 0.35;  // of the rod, of the largest load of its kind

class View {
  constructor(canvas) {
    this.canvas = canvas;
    this.yaw = -0.45;
    this.pitch = -0.35;  // from above
    this.zoom = 1;
    this.length = 1;
    this.centre = [0, 0, 0];
  }

  // What of the base frame points right, up and towards the eye.
  axes() {
    const [sy, cy, sp, cp] = [Math.sin(this.yaw), Math.cos(this.yaw), Math.sin(this.pitch), Math.cos(this.pitch)];
    return {right: [cy, sy, 0], up: [sy * sp, -cy * sp, cp], near: [sy * cp, -cy * cp, -sp]};
  }

  turn(right, up) {
    this.yaw -= right;
    this.pitch = Math.max(-1.55, Math.min(1.55, this.pitch + up));
  }

  // Shows a rod of this length whole, whichever way it bends.
  frame(length) {
    this.length = length;
    this.centre = [0.45 * length, 0, 0];
    this.zoom = 1;
  }

  pixelsPerMm() {
    return this.zoom * Math.min(this.canvas.clientWidth / 1.6, this.canvas.clientHeight / 1.3) / this.length;
  }

  // The function that puts a place on the canvas, for as long as the view does not turn.
  projector() {
    const {right, up, near} = this.axes(), scale = this.pixelsPerMm(), [x, y, z] = this.centre;
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const along = (axis, p) => axis[0] * (p[0] - x) + axis[1] * (p[1] - y) + axis[2] * (p[2] - z);
    return p => ({x: width / 2 + scale * along(right, p), y: height / 2 - scale * along(up, p), depth: along(near, p) / this.length});
  }

  project(p) {
    return this.projector()(p);
  }

  // A way on the canvas, px, as one in space, mm.
  inSpace(dx, dy, dnear = 0) {
    const {right, up, near} = this.axes(), scale = this.pixelsPerMm();
    return add(add(times(right, dx / scale), times(up, -dy / scale)), times(near, dnear / scale));
  }

  draw({rods, arrows}) {
    const {canvas} = this, ratio = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, canvas.clientWidth, canvas.clientHeight);
    context.lineCap = context.lineJoin = "round";
    this.place = this.projector();
    this.drawGround(context);
    for (const rod of rods) this.drawRod(context, rod);
    for (const arrow of arrows) this.drawArrow(context, arrow);
  }

  drawGround(context) {
    const line = (from, to, colour, width) => {
      const [a, b] = [this.place(from), this.place(to)];
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(a.x, a.y);
      context.lineTo(b.x, b.y);
      context.stroke();
      return b;
    };
    const s = this.length / 8;
    for (let i = -4; i <= 4; i++) line([-s, i * s, 0], [8 * s, i * s, 0], "#e7ebef", 1);
    for (let i = -1; i <= 8; i++) line([i * s, -4 * s, 0], [i * s, 4 * s, 0], "#e7ebef", 1);
    context.fillStyle = "#55606d";
    context.font = "13px system-ui, sans-serif";
    [[s, 0, 0], [0, s, 0], [0, 0, s]].forEach((axis, i) => {
      const end = line([0, 0, 0], axis, "#55606d", 1.5);
      context.fillText("xyz"[i], end.x + 4, end.y - 4);
    });
    const w = s / 4;  // the clamp
    for (const [a, b] of [[[-w, -w], [w, -w]], [[w, -w], [w, w]], [[w, w], [-w, w]], [[-w, w], [-w, -w]]])
      line([0, ...a], [0, ...b], "#1c2430", 2.5);
  }

  // points: positions clamp to tip; radius_mm along them; share: of the width as drawn.
  drawRod(context, {points, radius_mm, colour, share, dashed}) {
    const placed = points.map(this.place);
    context.setLineDash(dashed ? [6, 5] : []);
    if (dashed) {
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
      context.beginPath();
      placed.forEach((p, i) => i ? context.lineTo(p.x, p.y) : context.moveTo(p.x, p.y));
      context.stroke();
      context.setLineDash([]);
      return;
    }
    const scale = this.pixelsPerMm();
    const pieces = placed.slice(1).map((end, i) => ({begin: placed[i], end, width: Math.max(3, share * Math.min(26, 2 * scale * radius_mm[i + 1]))}));
    pieces.sort((a, b) => a.begin.depth + a.end.depth - b.begin.depth - b.end.depth);
    // Pieces of one width and style that follow each other are one path: strokes are what drawing costs.
    const stroke = (width, style, shift) => pieces.forEach((piece, i) => {
      const before = pieces[i - 1], [w, s] = [width(piece), style(piece)];
      if (!before || width(before) !== w || style(before) !== s) {
        if (before) context.stroke();
        context.beginPath();
        context.strokeStyle = s;
        context.lineWidth = w;
      }
      context.moveTo(piece.begin.x, piece.begin.y - shift * piece.width);
      context.lineTo(piece.end.x, piece.end.y - shift * piece.width);
      if (i + 1 === pieces.length) context.stroke();
    });
    const light = piece => Math.round(Math.max(-12, Math.min(12, 14 * (piece.begin.depth + piece.end.depth))));
    stroke(piece => piece.width, piece => `hsl(${colour[0]} ${colour[1]}% ${colour[2] + light(piece)}%)`, 0);
    stroke(piece => 0.25 * piece.width, () => "rgb(255 255 255 / 0.35)", 0.2);
  }

  // from, to: base frame; a moment has a second head.
  drawArrow(context, {from, to, moment, selected}) {
    const [a, b] = [this.place(from), this.place(to)];
    const colour = moment ? "#7a2ea0" : "#14804a", length = Math.hypot(b.x - a.x, b.y - a.y);
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = selected ? 3.5 : 2.5;
    context.beginPath();
    context.moveTo(a.x, a.y);
    context.lineTo(b.x, b.y);
    context.stroke();
    if (length > 1) {
      const [ux, uy] = [(b.x - a.x) / length, (b.y - a.y) / length];
      for (const back of moment ? [handleRadius, handleRadius + 9] : [handleRadius]) {
        const [x, y] = [b.x - back * ux, b.y - back * uy];
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(x - 10 * ux + 5 * uy, y - 10 * uy - 5 * ux);
        context.lineTo(x - 10 * ux - 5 * uy, y - 10 * uy + 5 * ux);
        context.fill();
      }
    }
    context.beginPath();
    context.arc(b.x, b.y, handleRadius, 0, 2 * Math.PI);
    context.fillStyle = selected ? colour : "#fff";
    context.fill();
    context.lineWidth = 2;
    context.stroke();
  }
}
