// The page: takes a scenario, has it run by a worker, and hands what the record grows by to the playback beside it.
'use strict';

const $ = (id) => document.getElementById(id);
const parts = JSON.parse($('parts').textContent); // {worker, playback, scenario}: texts
const workerAddress = URL.createObjectURL(new Blob([parts.worker], { type: 'text/javascript' }));
const PERIOD = 500; // between two texts of how far a run is [ms]
let worker = null, begun = null, waiting = [], over = false, links = [], newest = 0;
let toldAt = -PERIOD, tenths = 0; // what was said of the progress

$('scenario').value = parts.scenario;
for (const [name, does] of [['run', run], ['stop', stop]])
    $(name).onclick = ({ target }) => { if (target.ariaDisabled !== 'true') does(); };
window.simulation = { state: 'ready' }; // for whoever looks on: a test, a console

async function run() {
    end();
    const chosen = [...$('files').files], mine = ++newest;
    const files = await Promise.all(chosen.map(async (f) => ({ name: f.name, bytes: await f.arrayBuffer() })));
    if (mine !== newest) return;
    $('error').textContent = $('warnings').textContent = $('results').textContent = '';
    allow(true);
    $('progress').removeAttribute('value');
    announce('loading ...');
    [toldAt, tenths] = [-PERIOD, 0];
    window.simulation = { state: 'loading' };
    begun = null;
    waiting = [];
    over = false;
    openScene();
    worker = new Worker(workerAddress);
    worker.onmessage = ({ data }) => { if (mine === newest) hear(data); };
    worker.onerror = (e) => {
        if (mine === newest) fail({ message: e.message || 'the worker ended', file: '', line: 0, key: '' });
    };
    worker.postMessage({ run: $('scenario').value, files }, files.map((f) => f.bytes));
}

/** A playback without a record waits for one that grows. */
function openScene() {
    const scene = $('scene');
    scene.onload = () => {
        window.simulation.scene = scene.contentWindow;
        for (const bytes of waiting) scene.contentWindow.framAppend(bytes);
        waiting = null;
        if (over) scene.contentWindow.framEnd();
    };
    scene.srcdoc = parts.playback;
}

/** While the world is made the worker hears nothing: then it is ended without results. */
function stop() {
    if (begun) { worker.postMessage({ stop: true }); announce('stopping ...'); return; }
    end();
    announce('stopped before it began');
    window.simulation.state = 'stopped';
}

function end() {
    newest++;
    worker?.terminate();
    worker = null;
    over = true;
    if (!waiting) $('scene').contentWindow.framEnd();
    allow(false);
    if (!$('progress').hasAttribute('value')) $('progress').value = 0;
}

function hear(message) {
    const { simulation } = window;
    if (message.record) show(message.record);
    else if (message.work) tellWork(message);
    else if (message.warning) $('warnings').textContent += `${message.warning}\n`;
    else if (message.error) fail(message.error);
    else if (message.begun) {
        begun = simulation.begun = message.begun;
        simulation.state = 'running';
        announce('running');
    } else if (message.progress) {
        const { time, floes, wall } = message.progress;
        simulation.progress = message.progress;
        $('progress').value = time / begun.duration;
        const pace = (time / wall).toFixed(2);
        sayProgress(`t = ${time.toFixed(1)} of ${begun.duration} s, ${floes} floes, ${pace} times real time`,
            Math.floor(10 * time / begun.duration));
    } else if (message.ended) finish(message.ended, message.files);
}

function tellWork({ work, done, total }) {
    sayProgress(total > 0 ? `${work} ${Math.round(100 * done / total)} %` : `${work} ...`, 0);
}

function show(bytes) {
    if (waiting) waiting.push(bytes);
    else $('scene').contentWindow.framAppend(bytes);
}

function finish(ended, files) {
    end();
    $('progress').value = ended.time / begun.duration;
    announce(`${ended.stopped ? 'stopped' : 'finished'} at t = ${ended.time.toFixed(2)} s after ${ended.steps} steps`);
    for (const address of links) URL.revokeObjectURL(address);
    links = [];
    $('results').textContent = 'save ';
    for (const { name, bytes } of files) {
        const link = document.createElement('a');
        link.href = URL.createObjectURL(new Blob([bytes], { type: 'application/octet-stream' }));
        link.download = link.textContent = name;
        links.push(link.href);
        $('results').append(link, ' ');
    }
    const hash = document.createElement('span');
    hash.id = 'hash';
    hash.textContent = `state hash ${ended.hash}`;
    $('results').append(document.createElement('br'), hash);
    Object.assign(window.simulation, { state: ended.stopped ? 'stopped' : 'finished', ended });
}

/** The place of a mistake first, and the cursor there. */
function fail({ message, file, line, key }) {
    end();
    say('');
    const place = [line > 0 ? `line ${line}` : '', key].filter(Boolean).join(', ');
    $('error').textContent = (place ? `${place}: ` : '') + message;
    Object.assign(window.simulation, { state: 'failed', error: { message, file, line, key } });
    if (line > 0 && file.endsWith('(text)')) select(line);
}

function select(line) {
    const box = $('scenario'), lines = box.value.split('\n');
    const from = lines.slice(0, line - 1).reduce((sum, text) => sum + text.length + 1, 0);
    box.focus();
    box.setSelectionRange(from, from + (lines[line - 1] ?? '').length);
}

function say(text) { $('state').textContent = text; }

/** Read aloud too. */
function announce(text) {
    say(text);
    $('heard').textContent = text;
}

/** Often enough to be read; aloud at each tenth of the run. */
function sayProgress(text, tenth) {
    const now = performance.now();
    if (tenth > tenths) {
        tenths = tenth;
        announce(text);
    } else if (now - toldAt >= PERIOD) {
        say(text);
    } else {
        return;
    }
    toldAt = now;
}

/** Buttons that cannot be used keep the focus: who pressed one by a key stays there. */
function allow(running) {
    $('run').ariaDisabled = `${running}`;
    $('stop').ariaDisabled = `${!running}`;
}
