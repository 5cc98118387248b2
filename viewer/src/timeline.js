// The timeline: the averaged ice load over time, marks where floes broke, and a cursor that can be dragged.

import { forceText } from './legend.js';

export class Timeline {
    constructor(canvas, record, seek) {
        this.canvas = canvas;
        this.record = record;
        this.frames = record.frames;
        this.grow();
        const drag = (e) => { if (e.buttons & 1) seek(this.timeAt(e.offsetX)); };
        canvas.addEventListener('pointerdown', (e) => { canvas.setPointerCapture(e.pointerId); drag(e); });
        canvas.addEventListener('pointermove', drag);
    }

    /** What follows from all frames that there are now. */
    grow() {
        this.begin = this.frames[0].time;
        this.span = this.frames.at(-1).time - this.begin || 1;
        this.load = this.frames.map((f) => Math.hypot(f.force[0], f.force[1]) / 1000);
        this.most = this.load.reduce((a, b) => Math.max(a, b), 1e-9);
        this.events = this.record.fractures.map((f) => f.time);
        this.back = null;
    }

    timeAt(x) { return this.begin + Math.min(1, Math.max(0, x / this.canvas.clientWidth)) * this.span; }
    x(time) { return (time - this.begin) / this.span * this.canvas.clientWidth; }

    /** The curve is drawn once for a size; each frame adds the cursor. */
    drawCurve(w, h, ratio) {
        const back = document.createElement('canvas');
        back.width = Math.round(w * ratio); back.height = Math.round(h * ratio);
        const g = back.getContext('2d');
        g.scale(ratio, ratio);
        g.fillStyle = '#c9d6e2';
        g.beginPath();
        g.moveTo(0, h);
        this.frames.forEach((f, i) => g.lineTo(this.x(f.time), h - 2 - this.load[i] / this.most * (h - 20)));
        g.lineTo(w, h);
        g.fill();
        g.fillStyle = '#d9730d';
        for (const t of this.events) g.fillRect(this.x(t) - 0.5, h - 7, 1.5, 7);
        g.fillStyle = '#15222e';
        g.font = '11px system-ui, "DejaVu Sans", sans-serif';
        const events = this.events.length ? `; orange: ${this.events.length} floes that broke` : '';
        const most = `largest of them ${forceText(this.most)}`;
        g.fillText(`ice load on the vessel, averaged, at the frames; ${most}${events}`, 4, 11);
        const end = `${(this.begin + this.span).toFixed(0)} s`;
        g.fillText(end, w - g.measureText(end).width - 4, 11);
        this.back = back;
    }

    draw(time) {
        const c = this.canvas, ratio = window.devicePixelRatio, w = c.clientWidth, h = c.clientHeight;
        if (!this.back || c.width !== Math.round(w * ratio)) {
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
