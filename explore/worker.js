// Runs in a worker of its own, so that the page moves while a rod is solved: {id, name, args} in, {id, result} out.

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
  const result = calls[data.name](...data.args);
  postMessage({id: data.id, result: typeof result === "string" ? JSON.parse(result) : result});
};
