// Runs one scenario away from the page, so that the page stays awake.  Messages to it:
//   {run: YAML text, files: [{name, bytes}]}     begin; files that the scenario names lie beside it
//   {stop: true}                                 end after the step; results are kept
// Messages from it:
//   {work, done, total}                          how far the making of the world is
//   {begun: {duration, floes}}                   the world is made
//   {record: ArrayBuffer}                        what the record has grown by
//   {progress: {time, steps, wall, floes}}
//   {warning: text}
//   {ended: {hash, steps, time, stopped}, files: [{name, bytes}]}
//   {error: {message, file, line, key}}
/* global FramSimulator */
'use strict';

const SLICE = 60; // milliseconds between two looks at messages
const TOP = '/fram', HOME = '/fram/scenario', RESULTS = '/fram/results';
const run = { stopping: false, sent: 0 };

function call(name, type, ...values) {
    const types = values.map((v) => (typeof v === 'string' ? 'string' : 'number'));
    return run.module.ccall(`simulator_${name}`, type, types, values);
}
const number = (name) => call(name, 'number', run.handle);
const text = (name) => call(name, 'string', run.handle);

onmessage = ({ data }) => {
    if (data.stop) run.stopping = true;
    else begin(data).catch((e) => complain(String(e?.message ?? e)));
};

async function begin({ run: yaml, files }) {
    run.module = await FramSimulator({
        print: () => {},
        printErr: (line) => postMessage({ warning: line }),
        onWork: (work, done, total) => postMessage({ work, done, total }),
    });
    run.module.FS.mkdir(TOP);
    run.module.FS.mkdir(HOME);
    for (const { name, bytes } of files) run.module.FS.writeFile(`${HOME}/${name}`, new Uint8Array(bytes));
    run.handle = call('create', 'number');
    if (call('begin', 'number', run.handle, yaml, HOME, RESULTS)) { fail(); return; }
    run.began = performance.now();
    const version = call('version', 'string');
    postMessage({ begun: { duration: number('duration'), floes: number('floes'), version } });
    grown();
    slice();
}

function slice() {
    if (call('step', 'number', run.handle, SLICE)) { fail(); return; }
    grown();
    postMessage({ progress: { time: number('time'), steps: number('steps'), floes: number('floes'),
                              wall: (performance.now() - run.began) / 1000 } });
    if (run.stopping || number('is_over')) end();
    else setTimeout(slice, 0);
}

/** Sends what the record has got since the last call. */
function grown() {
    const { FS } = run.module, path = `${RESULTS}/record.fram`;
    const size = FS.analyzePath(path).exists ? FS.stat(path).size : 0;
    if (size <= run.sent) return;
    const bytes = new Uint8Array(size - run.sent), stream = FS.open(path, 'r');
    FS.read(stream, bytes, 0, bytes.length, run.sent);
    FS.close(stream);
    run.sent = size;
    postMessage({ record: bytes.buffer }, [bytes.buffer]);
}

function end() {
    const hash = text('hash'), stopped = !number('is_over'), time = number('time'), steps = number('steps');
    if (call('end', 'number', run.handle)) { fail(); return; }
    grown();
    const { FS } = run.module, files = [];
    for (const name of FS.readdir(RESULTS)) {
        const path = `${RESULTS}/${name}`;
        if (name.startsWith('.') || !FS.isFile(FS.stat(path).mode)) continue;
        const bytes = FS.readFile(path);
        files.push({ name, bytes: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) });
    }
    postMessage({ ended: { hash, steps, time, stopped }, files }, files.map((f) => f.bytes));
}

function fail() { complain(text('message'), text('file'), number('line'), text('key')); }

function complain(message, file = '', line = 0, key = '') { postMessage({ error: { message, file, line, key } }); }
