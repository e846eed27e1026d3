// FAM in a worker, and the centreline it answers with.

const mostSeconds = 20;  // that a worker may take for an answer

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
        this.waiting.get(data.id)?.(data.results);
        this.waiting.delete(data.id);
      };
    });
    this.worker.postMessage({wasm: this.wasm});
  }

  async ask(name, ...args) {
    return (await this.askAll([[name, ...args]]))[0];
  }

  // The answers to calls, in one message; {"error"} where they take longer than anybody waits: the worker then begins again.
  async askAll(calls) {
    await this.ready;
    const id = this.next++;
    return new Promise(resolve => {
      const late = setTimeout(() => {
        this.worker.terminate();
        const left = [...this.waiting.values()];
        this.waiting.clear();
        this.start();
        for (const give of left) give(null);
      }, 1000 * mostSeconds);
      this.waiting.set(id, results => {
        clearTimeout(late);
        resolve(results ?? calls.map(() => ({error: `no answer in ${mostSeconds} s`})));
      });
      this.worker.postMessage({id, calls});
    });
  }
}

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
