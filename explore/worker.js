// Runs in a worker of its own, so that the page moves while a rod is solved: {id, calls} in, each call its name and
// arguments, {id, results} out: one message each way, however much a frame asks for.

const functions = {
  solve: ["explore_solve", "string", ["string", "string"]],
  limit: ["explore_limit", "string", ["string"]],
  time_us: ["explore_time_us", "number", ["string", "string"]],
};

let calls;
onmessage = async ({data}) => {
  if (data.wasm) {
    const fam = await createFam({wasmBinary: data.wasm});
    calls = Object.fromEntries(Object.entries(functions).map(([name, how]) => [name, fam.cwrap(...how)]));
    postMessage({ready: true});
    return;
  }
  postMessage({id: data.id, results: data.calls.map(([name, ...args]) => {
    const result = calls[name](...args);
    return typeof result === "string" ? JSON.parse(result) : result;
  })});
};
