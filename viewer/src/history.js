// The panel of the picked floe: what it is, where it came from, and its speed and contact force over time: of the
// frames that are in the page, and on a click of those in files beside it too.

import { FORCE_COLOURS, forceText } from './legend.js';

const MOST = 400; // frames that are looked at

/** A tenth, or the digits that tell what is smaller. */
function short(value) { return value < 10 ? `${Number(value.toPrecision(3))}` : value.toFixed(1); }

export class History {
    /** resized: told whenever the panel may have another height. */
    constructor(panel, record, store, resized) {
        this.panel = panel;
        this.resized = resized;
        this.record = record;
        this.store = store;
    }

    show(body) {
        this.body = body;
        this.panel.hidden = !body;
        if (!body) return;
        const canvas = '<canvas role="img" aria-label="speed and contact force over time"></canvas>';
        this.panel.innerHTML = `<div></div>${canvas}<button id="whole" hidden></button>`;
        this.rows = new Map(); // by frame
        this.told = '';
        this.loading = null;
        this.panel.querySelector('button').onclick = () => this.load();
        this.grow();
    }

    /** What the record tells of it by now. */
    grow() {
        const { body } = this, name = body.level ? 'Level ice, tile' : 'Floe';
        const told = `<b>${name} ${body.number}</b> ${this.origin()}<br>${short(body.area)} m², ${
            short(body.thickness)} m thick, ${short(body.area * body.thickness * body.density / 1000)} t<br>${
            this.fate()}${body.moves ? '' : '<br>fixed'}`;
        if (told !== this.told) this.panel.firstChild.innerHTML = this.told = told; // what is new is read aloud
        this.more();
    }

    crack(number) { return this.record.fractures.find((f) => f.floe === number); }

    /** Of tiles of level ice that break together one is told, and all that comes of them has its number; of what a hull
     *  cuts from held ice nothing is told. */
    origin() {
        const { body, record } = this, { parent } = body, born = record.frames[body.birth].time.toFixed(1);
        if (parent < 0) return 'original';
        if (body.moves && !body.level) return `broke from floe ${parent} at ${born} s`;
        const from = `${body.level ? 'tile' : 'floe'} ${parent}`;
        return this.crack(parent) ? `what the break of ${from} left at ${born} s`
            : `what is left of ${from} since ${born} s`;
    }

    fate() {
        const { body } = this, { bodies, frames } = this.record, crack = this.crack(body.number);
        if (crack?.kind === 'loose') return `came loose at ${crack.time.toFixed(1)} s`;
        if (crack) return `broke at ${crack.time.toFixed(1)} s (${crack.kind}, ${forceText(crack.load / 1000)})`;
        if (body.death >= frames.length) return 'there to the end';
        const until = frames[body.death].time.toFixed(1), how = 'broke with a neighbour, or was cut by a hull';
        if (bodies.some((b) => b.parent === body.number)) return `cut by a hull by ${until} s`;
        if (!body.level) return `left at ${until} s`;
        return body.moves ? `gone by ${until} s: left, ${how}` : `changed by ${until} s: ${how}`;
    }

    /** Frames of the body's life that are not in the curves because their files were not fetched, but can be. */
    missing() {
        const { body } = this, { frames } = this.record, { lost } = this.store.chunks, out = [];
        for (let f = body.birth, last = Math.min(body.death, frames.length); f < last && body.moves; f++)
            if (!frames[f].view && !this.rows.has(f) && !lost.has(frames[f].chunk)) out.push(f);
        return out;
    }

    /** Fetches file after file; what each tells is taken when it arrives, for few are kept. */
    async load() {
        const { body, record, store } = this;
        const files = [...new Set(this.missing().map((f) => record.frames[f].chunk))];
        for (let k = 0; k < files.length && this.body === body; k++) {
            this.loading = `file ${k + 1} of ${files.length} ...`;
            this.offer();
            if (await store.chunks.load(files[k]) && this.body === body) this.more();
        }
        if (this.body !== body) return;
        this.loading = null;
        this.offer();
    }

    /** The button that fetches the rest, or how far that is. */
    offer() {
        const button = this.panel.querySelector('button'), missing = this.missing().length;
        button.hidden = missing === 0;
        button.disabled = this.loading !== null;
        button.textContent = this.loading ?? `load the other ${missing} frames of its history`;
        this.resized();
    }

    /** What the frames that are in the page now tell beyond what is known. */
    more() {
        const { body, record, store } = this, { frames } = record;
        const last = Math.min(body.death, frames.length), every = Math.max(1, Math.ceil((last - body.birth) / MOST));
        for (let f = body.birth; f < last && body.moves; f++) {
            const beside = !frames[f].view;
            if (this.rows.has(f) || (f - body.birth) % every && !beside) continue;
            if (beside && !store.chunks.kept.has(frames[f].chunk)) continue; // not fetched for this
            const place = frames[f].order.indexOf(body.index), at = store.get(f);
            if (place < 0 || !at) continue;
            const [x, y] = at.poses.subarray(7 * place, 7 * place + 2);
            this.rows.set(f, { time: frames[f].time, x, y, force: at.contact[place] });
        }
        this.sorted = [...this.rows.values()].sort((a, b) => a.time - b.time);
        this.sorted.forEach((r, i) => {
            const p = this.sorted[i - 1] ?? r;
            r.speed = r === p ? 0 : Math.hypot(r.x - p.x, r.y - p.y) / (r.time - p.time);
        });
        if (this.sorted.length > 1) this.sorted[0].speed = this.sorted[1].speed;
        this.back = null;
        this.offer();
    }

    curve(g, w, top, h, name, tell, colour, value) {
        const rows = this.sorted, most = rows.reduce((m, r) => Math.max(m, value(r)), 0), t0 = rows[0].time;
        const span = rows.at(-1).time - t0 || 1;
        this.x = (t) => (t - t0) / span * w;
        g.strokeStyle = colour;
        g.lineWidth = 1.4;
        g.beginPath();
        rows.forEach((r) => g.lineTo(this.x(r.time), top + h - value(r) / (most || 1) * (h - 13)));
        g.stroke();
        g.fillStyle = '#15222e';
        g.fillText(most > 0 ? `${name}, largest ${tell(most)}` : `no ${name}`, 0, top + 9);
    }

    draw(time) {
        const canvas = this.panel.querySelector('canvas');
        if (!this.body || !canvas || this.sorted.length < 2) return;
        const ratio = window.devicePixelRatio, w = canvas.clientWidth, h = canvas.clientHeight;
        const [wide, high] = [w, h].map((size) => Math.max(1, Math.round(size * ratio)));
        if (!this.back || canvas.width !== wide || canvas.height !== high) {
            this.back = document.createElement('canvas');
            this.back.width = canvas.width = wide; this.back.height = canvas.height = high;
            const g = this.back.getContext('2d');
            g.scale(ratio, ratio);
            g.font = '10.5px system-ui, "DejaVu Sans", sans-serif';
            this.curve(g, w, 0, h / 2 - 3, 'speed', (v) => `${v.toPrecision(3)} m/s`, '#00457f', (r) => r.speed);
            this.curve(g, w, h / 2, h / 2 - 1, 'contact force', forceText, FORCE_COLOURS.ice, (r) => r.force);
        }
        const g = canvas.getContext('2d');
        g.clearRect(0, 0, canvas.width, canvas.height);
        g.drawImage(this.back, 0, 0);
        g.fillStyle = '#b03020';
        g.fillRect(this.x(time) * ratio, 0, 1.5 * ratio, canvas.height);
    }
}
