// The timeline: the averaged ice load over time, with a cursor that can be dragged.

export class Timeline {
    constructor(canvas, frames, seek) {
        this.canvas = canvas;
        this.frames = frames;
        this.end = frames.at(-1).time - frames[0].time || 1;
        this.load = frames.map((f) => Math.hypot(...f.force) / 1000);
        this.most = Math.max(1e-9, ...this.load);
        const drag = (e) => { if (e.buttons & 1) seek(this.timeAt(e.offsetX)); };
        canvas.addEventListener('pointerdown', (e) => { canvas.setPointerCapture(e.pointerId); drag(e); });
        canvas.addEventListener('pointermove', drag);
    }

    timeAt(x) { return this.frames[0].time + Math.min(1, Math.max(0, x / this.canvas.clientWidth)) * this.end; }
    x(time) { return (time - this.frames[0].time) / this.end * this.canvas.clientWidth; }

    draw(time) {
        const c = this.canvas, ratio = window.devicePixelRatio, w = c.clientWidth, h = c.clientHeight;
        if (c.width !== Math.round(w * ratio)) { c.width = Math.round(w * ratio); c.height = Math.round(h * ratio); }
        const g = c.getContext('2d');
        g.setTransform(ratio, 0, 0, ratio, 0, 0);
        g.clearRect(0, 0, w, h);
        g.fillStyle = '#c9d6e2';
        g.beginPath();
        g.moveTo(0, h);
        this.frames.forEach((f, i) => g.lineTo(this.x(f.time), h - 2 - this.load[i] / this.most * (h - 18)));
        g.lineTo(w, h);
        g.fill();
        g.fillStyle = '#15222e';
        g.font = '11px system-ui, "DejaVu Sans", sans-serif';
        g.fillText(`ice load on the vessel, averaged; largest ${this.most.toPrecision(3)} kN`, 4, 11);
        g.fillStyle = '#b03020';
        g.fillRect(this.x(time) - 1, 0, 2, h);
    }
}
