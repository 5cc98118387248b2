// The panel of the picked floe: what it is, where it came from, and its speed and contact force over time: of the
// frames that are in the page, and on a click of those in files beside it too.

import { forceText } from './legend.js';

const MOST = 400; // frames that are looked at

/** A tenth, or the digits that tell what is smaller. */
function short(value) { return value < 10 ? `${Number(value.toPrecision(3))}` : value.toFixed(1); }

export class History {
    constructor(panel, record, store) {
        this.panel = panel;
        this.record = record;
        this.store = store;
    }

    show(body) {
        this.body = body;
        this.panel.hidden = !body;
        if (!body) return;
        const { frames, fractures } = this.record, born = frames[body.birth].time;
        const death = body.death < frames.length ? frames[body.death].time : null;
        const origin = body.parent >= 0 ? `broke from floe ${body.parent} at ${born.toFixed(1)} s` : 'original';
        const crack = fractures.find((f) => f.floe === body.number);
        const fate = crack?.kind === 'loose' ? `came loose at ${crack.time.toFixed(1)} s`
            : crack ? `broke at ${crack.time.toFixed(1)} s (${crack.kind}, ${forceText(crack.load / 1000)})`
            : death !== null ? `left at ${death.toFixed(1)} s` : 'there to the end';
        const name = body.level ? 'Level ice, tile' : 'Floe';
        const canvas = '<canvas role="img" aria-label="speed and contact force over time"></canvas>';
        this.panel.innerHTML = `<b>${name} ${body.number}</b> ${origin}<br>${short(body.area)} m², ${
            short(body.thickness)} m thick, ${short(body.area * body.thickness * body.density / 1000)} t<br>${
            fate}${body.moves ? '' : '<br>fixed'}${canvas}<button id="whole" hidden></button>`;
        this.rows = new Map(); // by frame
        this.loading = null;
        this.panel.querySelector('button').onclick = () => this.load();
        this.more();
    }

    /** Frames of the body's life that are not in the curves because their files were not fetched. */
    missing() {
        const { body, record } = this, last = Math.min(body.death, record.frames.length), out = [];
        for (let f = body.birth; f < last && body.moves; f++)
            if (!record.frames[f].view && !this.rows.has(f)) out.push(f);
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
        if (!this.back) {
            this.back = document.createElement('canvas');
            this.back.width = canvas.width = w * ratio; this.back.height = canvas.height = h * ratio;
            const g = this.back.getContext('2d');
            g.scale(ratio, ratio);
            g.font = '10.5px system-ui, "DejaVu Sans", sans-serif';
            this.curve(g, w, 0, h / 2 - 3, 'speed', (v) => `${v.toPrecision(3)} m/s`, '#00457f', (r) => r.speed);
            this.curve(g, w, h / 2, h / 2 - 1, 'contact force', forceText, '#c2185b', (r) => r.force);
        }
        const g = canvas.getContext('2d');
        g.clearRect(0, 0, canvas.width, canvas.height);
        g.drawImage(this.back, 0, 0);
        g.fillStyle = '#b03020';
        g.fillRect(this.x(time) * ratio, 0, 1.5 * ratio, canvas.height);
    }
}
