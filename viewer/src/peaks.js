// The panel of a peak that was clicked: its sentence, parts and chain, and which floes are lit.
import { chainText, floesOf, linesOf } from './loads.js';
import { forceText } from './legend.js';

const SHARED = 0.02; // parts of the load from here on stand in the panel

export class PeakPanel {
    /** go(time): leads there; change(): the scene must be drawn again. */
    constructor(panel, record, loads, go, change) {
        Object.assign(this, { panel, record, loads, go, change, peak: null, list: [] });
        this.byNumber = new Map(record.bodies.filter((b) => b.number >= 0).map((b) => [b.number, b]));
    }

    setVessel(vessel) {
        this.vessel = vessel;
        this.close();
    }

    /** How far from the peak its floes stay lit: until the next frame, or over the averaging window. */
    get reach() {
        const { frames } = this.record, interval = frames.length > 1 ? frames[1].time - frames[0].time : 0;
        return Math.max(2 * this.vessel.window, interval);
    }

    isNear(time) { return this.peak !== null && Math.abs(time - this.peak.time) <= this.reach; }

    open(peak) {
        this.peak = peak;
        this.lit = floesOf(this.loads, peak);
        this.bodies = [...this.lit].map(([number, f]) => [this.byNumber.get(number), f]).filter(([b]) => b);
        this.tell();
        this.go(peak.time);
        this.change();
    }

    focus() { this.panel.querySelector('button')?.focus(); }

    close() {
        if (this.focused) document.getElementById('timeline').focus();
        this.peak = null;
        this.panel.hidden = true;
        this.change();
    }

    /** Arrows of the peak: forces as long as `scale` metres a newton, and its chains. */
    lines(scale, width) {
        return linesOf(this.loads, this.peak, scale, this.record.origin).map((line) => ({ ...line, width }));
    }

    step(by) {
        const { peaks } = this.vessel, at = peaks.indexOf(this.peak);
        this.open(peaks[(at + by + peaks.length) % peaks.length]);
    }

    /** The button of the panel that has the focus: it is made anew with the panel, and those without a mouse go on. */
    get focused() { return this.panel.contains(document.activeElement) ? document.activeElement.id : ''; }

    tell() {
        const { peak, loads, panel, focused } = this, { detail } = peak;
        const order = loads.names.map((name, m) => [name, m, detail.mechanisms[name] / peak.load])
            .filter(([, , part]) => Math.abs(part) >= SHARED).sort((a, b) => b[2] - a[2]);
        panel.replaceChildren();
        const add = (tag, text, parent = panel) => {
            const made = document.createElement(tag);
            made.textContent = text;
            parent.append(made);
            return made;
        };
        const head = add('p', '');
        add('b', `Peak ${peak.rank} of ${this.vessel.peaks.length}`, head);
        head.append(` at ${peak.time.toFixed(2)} s, averaged over ${Number(this.vessel.window.toPrecision(3))} s`);
        const buttons = add('div', '');
        const button = (id, text, does) => { const b = add('button', text, buttons); b.id = id; b.onclick = does; };
        button('larger', 'larger', () => this.step(-1));
        button('smaller', 'smaller', () => this.step(1));
        button('gotopeak', 'go there', () => this.go(peak.time));
        button('letgo', 'close', () => this.close());
        add('p', peak.sentence);
        const parts = add('ul', '');
        for (const [name, m, part] of order) {
            const row = add('li', `${Math.round(100 * part)} % ${loads.texts[m]}`, parts);
            row.style.setProperty('--swatch', loads.colour(name));
        }
        const chain = chainText(loads, peak, forceText), absent = this.absent();
        if (chain) add('p', chain);
        if (absent) add('p', absent);
        panel.hidden = false;
        if (focused) document.getElementById(focused).focus();
    }

    /** Floes that are not in the frame before the peak: born of a break after it. */
    absent() {
        const frames = this.record.frames, at = frames.findLastIndex((f) => f.time <= this.peak.time);
        const missing = [...this.lit.keys()].filter((n) => {
            const b = this.byNumber.get(n);
            return !b || b.birth > at || b.death <= at;
        });
        return missing.length === 0 ? '' : `Not in the frame before it, so not lit: floe${
            missing.length > 1 ? 's' : ''} ${missing.join(', ')}.`;
    }
}
