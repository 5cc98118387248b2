// The timeline: the averaged ice load over time, stacked by mechanism where the page knows them, its largest peaks,
// marks where floes broke, and a cursor that can be dragged.

import { forceText, MARK, MARK_EDGE, secondsText } from './legend.js';
import { hullsOf } from './record.js';
import { shortened, wrapped } from './text.js';

const FONT = 'system-ui, "DejaVu Sans", sans-serif', INK = '#15222e', LINE = 13;
const NUMBER = 16; // from a peak's point to above its number [px]
const GRASP = 6; // a click so near to a peak's time is meant for it [px]

export class Timeline {
    /** of: whose load the frames tell, " on NAME"; seek(time); open(peak) when a peak is clicked. */
    constructor(canvas, record, of, seek, open) {
        this.canvas = canvas;
        this.record = record;
        this.of = of;
        this.frames = record.frames;
        this.loads = null;
        this.open = open;
        this.grow();
        const drag = (e) => { if (e.buttons & 1) seek(this.timeAt(e.offsetX)); };
        canvas.addEventListener('pointerdown', (e) => {
            const peak = e.button === 0 ? this.peakAt(e.offsetX) : null;
            if (peak) { open(peak); return; }
            canvas.setPointerCapture(e.pointerId);
            drag(e);
        });
        canvas.addEventListener('pointermove', (e) => {
            if (e.buttons & 1) {
                if (canvas.hasPointerCapture(e.pointerId)) drag(e);
                return;
            }
            const peak = this.peakAt(e.offsetX);
            canvas.style.cursor = peak ? 'help' : 'pointer';
            canvas.title = peak ? `Peak ${peak.rank}: ${peak.sentence}` : '';
        });
    }

    /** What follows from all frames that there are now. */
    grow() {
        this.begin = this.frames[0].time;
        // The loads may go on after the last frame.
        this.span = Math.max(this.frames.at(-1).time, this.vessel?.time.at(-1) ?? 0) - this.begin || 1;
        this.load = this.frames.map((f) => Math.hypot(f.force[0], f.force[1]) / 1000);
        this.most = this.load.reduce((a, b) => Math.max(a, b), 0);
        this.events = this.record.fractures.map((f) => f.time);
        this.back = null;
    }

    /** Bands of a vessel instead of the first vessel's load at the frames. */
    show(loads, vessel) {
        this.loads = loads;
        this.vessel = vessel;
        this.kinds = loads.shown(vessel);
        this.stack();
        this.grow();
    }

    /** What pushes with the load goes up from zero, what pushes against it down: two bands a mechanism, of which one
     *  has no width at a time, so that a part that changes its side leaves no gap. */
    stack() {
        const { vessel, loads } = this, n = vessel.time.length;
        this.up = new Float64Array(n);
        this.down = new Float64Array(n);
        this.bands = loads.names.flatMap((_, m) => [[this.up, Math.max], [this.down, Math.min]]
            .map(([from, side]) => {
                const low = from.slice();
                for (let k = 0; k < n; k++) from[k] += side(0, vessel.parts[m][k]);
                return { colour: loads.colours[m], low, high: from.slice() };
            }));
        this.largest = Math.max(largest(vessel.load), largest(vessel.peaks.map((p) => p.load)));
        this.top = Math.max(this.largest, largest(this.up), 1e-6);
        this.bottom = this.down.reduce((a, b) => Math.min(a, b), 0);
    }

    timeAt(x) { return this.begin + Math.min(1, Math.max(0, x / this.canvas.clientWidth)) * this.span; }
    x(time) { return (time - this.begin) / this.span * this.canvas.clientWidth; }

    peakAt(x) {
        if (!this.loads) return null;
        let best = null, nearest = GRASP;
        for (const p of this.vessel.peaks) {
            const far = Math.abs(this.x(p.time) - x);
            if (far < nearest) { best = p; nearest = far; }
        }
        return best;
    }

    /** Of whoever has no mouse: the peak that is nearest to a time. */
    openNearest(time) {
        const far = (p) => Math.abs(p.time - time);
        const [best] = [...this.vessel?.peaks ?? []].sort((a, b) => far(a) - far(b));
        if (best) this.open(best);
    }

    /** The time, to what reads the page aloud. */
    tell(time) {
        const { canvas } = this, now = time.toFixed(1);
        if (canvas.ariaValueNow === now) return;
        canvas.ariaValueMin = `${this.begin}`;
        canvas.ariaValueMax = `${this.begin + this.span}`;
        canvas.ariaValueNow = now;
        canvas.ariaValueText = `${now} s`;
    }

    /** Text from the top left corner in as many lines as it takes, at most those that leave so much of the height, the
     *  end of the time in the corner right of the first; returns the height of the last line's foot. */
    drawCaption(g, w, text, left) {
        const end = `${secondsText(this.begin + this.span)} s`, wide = g.measureText(end).width;
        this.canvas.ariaDescription = text;
        const room = (line) => w - 8 - (line === 0 ? wide + 10 : 0), most = Math.max(1, Math.floor(left / LINE));
        const lines = wrapped(g, text, room);
        const over = lines.splice(most - 1);
        if (over.length) lines.push(shortened(g, over.join(' '), room(most - 1)));
        g.fillStyle = INK;
        lines.forEach((line, i) => this.write(g, line, 4, 11 + LINE * i));
        this.write(g, end, w - wide - 4, 11);
        return 11 + LINE * (lines.length - 1);
    }

    /** Keeps where it wrote: [text, left, top, right, bottom]. */
    write(g, text, x, y) {
        g.fillText(text, x, y);
        this.written.push([text, x, y - 9, x + g.measureText(text).width, y + 3]);
    }

    /** The curve is drawn once for a size; each frame adds the cursor. */
    drawCurve(w, h, ratio) {
        const back = document.createElement('canvas');
        back.width = Math.round(w * ratio); back.height = Math.round(h * ratio);
        const g = back.getContext('2d');
        g.scale(ratio, ratio);
        g.font = `11px ${FONT}`;
        this.written = [];
        const head = this.loads ? this.drawHeads(g, w, h) : 18;
        if (this.loads) this.drawBands(g, h, head);
        else this.drawPlain(g, w, h);
        for (const [colour, edge] of [[MARK_EDGE, 1], [MARK, 0]]) {
            g.fillStyle = colour;
            for (const t of this.events) g.fillRect(this.x(t) - 0.5 - edge, h - 7 - edge, 1.5 + 2 * edge, 7 + edge);
        }
        if (this.loads) this.drawPeaks(g, w, h, head);
        this.back = back;
    }

    drawPlain(g, w, h) {
        const most = this.load.some((load) => load > 0) ? `largest of them ${forceText(this.most)}` : 'none';
        const what = hullsOf(this.record).length
            ? `ice load${this.of}, averaged, at the frames; ${most}` : 'no vessel';
        const head = this.drawCaption(g, w, `${what}${this.eventText()}`, h - 38) + 7;
        g.fillStyle = '#c9d6e2';
        g.beginPath();
        g.moveTo(0, h);
        const tall = (h - 2 - head) / (this.most || 1);
        this.frames.forEach((f, i) => g.lineTo(this.x(f.time), h - 2 - this.load[i] * tall));
        g.lineTo(w, h);
        g.fill();
    }

    eventText() {
        const n = this.events.length;
        return n ? `; orange: ${n} ${n === 1 ? 'break' : 'breaks'} of ice` : '';
    }

    /** Title and the mechanisms' colours, in as many lines as the width asks for; returns their height. */
    drawHeads(g, w, h) {
        const { vessel, loads } = this, of = vessel.name ? ` on ${vessel.name}` : ' on the vessel';
        const what = this.largest > 0 ? `largest ${forceText(this.largest / 1000)}` : 'none in this run';
        const foot = this.drawCaption(g, w, `ice load${of}, averaged over ${
            Number(vessel.window.toPrecision(3))} s: ${what}${
            vessel.peaks.length ? '; numbers: peaks, click one or press Enter here' : ''}${this.eventText()}`, h - 74);
        let x = 4, y = foot + LINE;
        for (const m of this.kinds) {
            const wide = 14 + g.measureText(loads.names[m]).width + 12;
            if (x + wide > w - 4 && x > 4) { x = 4; y += LINE; }
            g.fillStyle = loads.colours[m];
            g.fillRect(x, y - 9, 10, 10);
            g.fillStyle = INK;
            this.write(g, loads.names[m], x + 14, y);
            x += wide;
        }
        return (this.kinds.length ? y : foot) + 3 + NUMBER;
    }

    /** Height of a load on the canvas. */
    y(load, h, head) { return h - 9 - (load - this.bottom) / (this.top - this.bottom) * (h - 9 - head); }

    drawBands(g, h, head) {
        const { time, load } = this.vessel, n = time.length;
        this.bands.forEach(({ colour, low, high }) => {
            g.fillStyle = colour;
            g.beginPath();
            for (let k = 0; k < n; k++) g.lineTo(this.x(time[k]), this.y(high[k], h, head));
            for (let k = n - 1; k >= 0; k--) g.lineTo(this.x(time[k]), this.y(low[k], h, head));
            g.fill();
        });
        g.strokeStyle = INK;
        g.lineWidth = 0.8;
        g.beginPath();
        for (let k = 0; k < n; k++) g.lineTo(this.x(time[k]), this.y(load[k], h, head));
        g.stroke();
    }

    drawPeaks(g, w, h, head) {
        g.font = `bold 11px ${FONT}`;
        g.textAlign = 'center';
        this.numbers = [];
        for (const p of this.vessel.peaks) {
            const x = this.x(p.time), y = this.y(p.load, h, head);
            g.fillStyle = '#b03020';
            g.beginPath();
            g.arc(x, y, 3, 0, 7);
            g.fill();
            g.strokeStyle = '#ffffff';
            g.lineWidth = 3;
            const middle = Math.min(w - 8, Math.max(8, x)), half = g.measureText(p.rank).width / 2;
            g.strokeText(p.rank, middle, y - 5);
            g.fillText(p.rank, middle, y - 5);
            this.numbers.push([p.rank, middle - half, y - 5 - 9, middle + half, y - 5]);
        }
        g.textAlign = 'left';
    }

    draw(time) {
        const c = this.canvas, ratio = window.devicePixelRatio, w = c.clientWidth, h = c.clientHeight;
        if (!this.back || c.width !== Math.round(w * ratio) || c.height !== Math.round(h * ratio)) {
            c.width = Math.round(w * ratio); c.height = Math.round(h * ratio);
            this.drawCurve(w, h, ratio);
        }
        const g = c.getContext('2d');
        g.setTransform(1, 0, 0, 1, 0, 0);
        g.clearRect(0, 0, c.width, c.height);
        g.drawImage(this.back, 0, 0);
        g.fillStyle = '#b03020';
        g.fillRect((this.x(time) - 1) * ratio, 0, 2 * ratio, h * ratio);
    }
}

const largest = (list) => list.reduce((a, b) => Math.max(a, b), 0);
