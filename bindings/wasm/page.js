// The page: takes a scenario, has it run by a worker, and hands what the record grows by to the playback beside it.
'use strict';

const $ = (id) => document.getElementById(id);
const parts = JSON.parse($('parts').textContent); // {worker, playback, scenario}: texts
const workerAddress = URL.createObjectURL(new Blob([parts.worker], { type: 'text/javascript' }));
let worker = null, begun = null, waiting = [], over = false, links = [], newest = 0;

$('scenario').value = parts.scenario;
$('run').onclick = run;
$('stop').onclick = stop;
window.simulation = { state: 'ready' }; // for whoever looks on: a test, a console

async function run() {
    end();
    const chosen = [...$('files').files], mine = ++newest;
    const files = await Promise.all(chosen.map(async (f) => ({ name: f.name, bytes: await f.arrayBuffer() })));
    if (mine !== newest) return;
    $('error').textContent = $('warnings').textContent = $('results').textContent = '';
    $('run').disabled = true;
    $('stop').disabled = false;
    $('progress').removeAttribute('value');
    say('loading ...');
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
    if (begun) { worker.postMessage({ stop: true }); say('stopping ...'); return; }
    end();
    say('stopped before it began');
    window.simulation.state = 'stopped';
}

function end() {
    newest++;
    worker?.terminate();
    worker = null;
    over = true;
    if (!waiting) $('scene').contentWindow.framEnd();
    $('run').disabled = false;
    $('stop').disabled = true;
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
    } else if (message.progress) {
        const { time, floes, wall } = message.progress;
        simulation.progress = message.progress;
        $('progress').value = time / begun.duration;
        const pace = (time / wall).toFixed(2);
        say(`t = ${time.toFixed(1)} of ${begun.duration} s, ${floes} floes, ${pace} times real time`);
    } else if (message.ended) finish(message.ended, message.files);
}

function tellWork({ work, done, total }) {
    say(total > 0 ? `${work} ${Math.round(100 * done / total)} %` : `${work} ...`);
}

function show(bytes) {
    if (waiting) waiting.push(bytes);
    else $('scene').contentWindow.framAppend(bytes);
}

function finish(ended, files) {
    end();
    $('progress').value = ended.time / begun.duration;
    say(`${ended.stopped ? 'stopped' : 'finished'} at t = ${ended.time.toFixed(2)} s after ${ended.steps} steps`);
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
