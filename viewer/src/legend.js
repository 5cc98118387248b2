// What the colours, arrows and marks mean, how long a metre is, where Y points and what time it is: drawn with one hand
// for the page, for pictures and for videos.

import { shortened, wrapped } from './text.js';

const INK = '#15222e', PAPER = '#ffffffd8', FONT = '"DejaVu Sans", system-ui, sans-serif';
const WIDTH = 204, EDGE = 12, LINE = 18;
const SWATCH = 14, GAP = 12; // from a swatch to its name, and from a name to the next swatch [px]
/** Told apart without red or green too, and on water by their white edge: tests/views/test_colours.py. */
export const FORCE_COLOURS = { ice: '#cc4f97', line: '#009058', thruster: '#4a10b4', hull: '#5a3a00' };
/** What a kind is called where that is not its name. */
const FORCE_WORDS = { hull: 'hull or wall' };
/** Where ice broke, and what is drawn round it. */
export const MARK = '#e69f00', MARK_EDGE = INK;
/** Round arrows, lines and propellers. */
export const HALO = '#ffffff';
/** Of the chains of a peak, and of floes that stand in one without touching the vessel. */
export const CHAIN = '#111111', BEHIND = '#7a7f3a';
/** Of ice in a peak that is lit: the colours stand in the page beside the mechanisms' names. */
const OF_PEAK = ['#00000000', 'ice, by mechanism'];
/** Of a line that parted, which is dashed, and of a thruster that failed. */
export const GONE = '#000000';

/** The unit in which a force is told, and how many of it a kilonewton has: the rule of src/base/load_unit.c, which
 *  texts and pictures of the library follow; no second one stands in these files.  What is rounded up to the next unit
 *  has that, and nothing is in kN. */
export function forceUnit(force) {
    const kilonewton = Number(Math.abs(force).toPrecision(3));
    if (!(kilonewton > 0)) return ['kN', 1];
    return kilonewton < 10 ? ['N', 1000] : kilonewton < 1e4 ? ['kN', 1] : ['MN', 0.001];
}

/** A number with its unit, to three digits and whole from 1000 on. */
export function forceText(kilonewton) {
    const [name, per] = forceUnit(kilonewton), value = kilonewton * per;
    if (value === 0) return `0 ${name}`;
    return `${Math.abs(value) < 999.5 ? value.toPrecision(3) : value.toFixed(0)} ${name}`;
}

/** One of several forces [kN] that are told by turns: in the unit of the largest of them, with as many digits as that
 *  asks for to have three, so that they can be compared; of those that would have but one digit left so, in its own.
 *  Never "-0". */
export function forceTextBeside(kilonewton, most) {
    const [name, per] = forceUnit(most), size = Math.abs(kilonewton * per);
    const places = most > 0 ? 2 - Math.floor(Math.log10(Number((most * per).toPrecision(3)))) : 0;
    const digits = Math.min(20, Math.max(0, places));
    if (size > 0 && size < 10 ** (1 - digits) && forceUnit(kilonewton)[0] !== name) return forceText(kilonewton);
    return `${(Number((kilonewton * per).toFixed(digits)) || 0).toFixed(digits)} ${name}`;
}

/** As many digits as it needs, two after the point at most. */
export function secondsText(seconds) { return `${Number(seconds.toFixed(2))}`; }

export class Legend {
    constructor() {
        this.measure = document.createElement('canvas').getContext('2d');
        this.measure.font = `12px ${FONT}`;
    }

    /** content: {ramp: [colour, ...] and unit, ends: [low, high] or none; keys: [[colour, name], ...] of the bodies;
     *  forces: kinds that are shown; lit: whether those of ice are a peak's; station: rows of such keys, of lines and
     *  thrusters; hull: {unit, ends} of the pressure on it or null; peak: whether one is shown; vessels: how many;
     *  marked: seconds that a mark stays, or 0}. */
    set(content) {
        const { keys, forces, lit, station } = content, rows = (list) => rowsOf(this.measure, list);
        const kinds = forces.map((kind) => (lit && kind === 'ice' ? OF_PEAK
            : [FORCE_COLOURS[kind], FORCE_WORDS[kind] ?? kind]));
        this.content = content;
        this.rows = { keys: rows(keys), forces: rows(kinds), station: station.flatMap(rows) };
        this.drawn = '';
    }

    get width() { return WIDTH; }
    get height() {
        const { unit, marked, hull, peak } = this.content, { keys, forces, station } = this.rows;
        const lines = (unit ? 0 : keys.length) + (peak ? 1 : 0) + (forces.length ? 1 + forces.length : 0) +
            station.length + (marked ? 1 : 0);
        return 2 * EDGE + (unit ? 44 : 0) + (hull ? 44 : 0) + lines * LINE + 48;
    }

    /** view: {length: of the bar [m], pixels: of the bar, force: that an arrow of this length stands for, angle: of Y
     *  on the screen, clockwise from up}. */
    show(canvas, view) {
        const ratio = window.devicePixelRatio, state = JSON.stringify([view, ratio]);
        if (state === this.drawn) return;
        this.drawn = state;
        const w = Math.round(this.width * ratio), h = Math.round(this.height * ratio);
        if (canvas.width !== w || canvas.height !== h) {
            canvas.width = w; canvas.height = h;
            canvas.style.width = `${this.width}px`; canvas.style.height = `${this.height}px`;
        }
        const g = canvas.getContext('2d');
        g.setTransform(ratio, 0, 0, ratio, 0, 0);
        g.clearRect(0, 0, this.width, this.height);
        this.draw(g, view);
        canvas.ariaLabel = this.words(view);
    }

    get ofForces() { return `forces on the ${this.content.vessels > 1 ? 'vessels' : 'vessel'}`; }

    /** What is drawn, to be read aloud. */
    words(view) {
        const { unit, ends, marked, hull, peak, keys, station } = this.content, forces = this.rows.forces.flat();
        const range = (name, between) => `${name} from ${between.map((v) => Number(v.toPrecision(2))).join(' to ')}`;
        const said = [unit ? range(unit, ends) : keys.map(([, name]) => name).join(', ')];
        if (hull) said.push(range(hull.unit, hull.ends));
        if (peak) said.push('chains of the peak and floes behind');
        if (forces.length) said.push(`${this.ofForces}: ${forces.map(([, name]) => name).join(', ')}`,
            `${view.length} m: ${forceText(view.force)}`);
        said.push(...station.flat().map(([, name]) => name));
        if (marked) said.push(`orange: broke in the last ${marked} s`);
        return `legend: ${said.filter(Boolean).join('; ')}`;
    }

    draw(g, view) {
        const { unit, ends, ramp, marked, hull, peak } = this.content, { keys, forces, station } = this.rows;
        paper(g, this.width, this.height);
        g.font = `12px ${FONT}`;
        let y = EDGE + 11;
        const each = (rows) => {
            for (const row of rows) {
                swatches(g, y, row);
                y += LINE;
            }
        };
        if (unit) {
            g.fillText(unit, EDGE, y);
            this.bar(g, y + 6, ramp, ends);
            y += 44;
        } else {
            each(keys);
        }
        if (hull) {
            g.fillText(hull.unit, EDGE, y);
            this.bar(g, y + 6, ramp, hull.ends);
            y += 44;
        }
        if (peak) {
            swatches(g, y, [[CHAIN, 'chain'], [BEHIND, 'floe behind']]);
            y += LINE;
        }
        if (forces.length) {
            g.fillText(this.ofForces, EDGE, y);
            y += LINE;
            each(forces);
        }
        each(station);
        if (marked) {
            swatches(g, y, [[MARK, `broke in the last ${marked} s`]]);
            y += LINE;
        }
        this.scale(g, y, view, forces.length > 0);
        north(g, this.width - EDGE - 20, y + 20, view.angle);
    }

    bar(g, y, ramp, ends) {
        const wide = this.width - 2 * EDGE, fill = g.createLinearGradient(EDGE, 0, EDGE + wide, 0);
        ramp.forEach((colour, i) => fill.addColorStop(i / (ramp.length - 1), colour));
        g.fillStyle = fill;
        g.fillRect(EDGE, y, wide, 10);
        g.fillStyle = INK;
        const [low, high] = ends.map((v) => Number(v.toPrecision(2)).toString());
        g.fillText(low, EDGE, y + 23);
        g.fillText(high, EDGE + wide - g.measureText(high).width, y + 23);
    }

    scale(g, y, view, arrows) {
        g.strokeStyle = INK;
        g.lineWidth = 1.5;
        g.beginPath();
        g.moveTo(EDGE, y); g.lineTo(EDGE, y + 6); g.lineTo(EDGE + view.pixels, y + 6); g.lineTo(EDGE + view.pixels, y);
        g.stroke();
        g.fillText(`${view.length} m`, EDGE, y + 21);
        if (arrows) g.fillText(`as an arrow ${forceText(view.force)}`, EDGE, y + 36);
    }
}

/** Title, time and load, as a box of its own that is no wider than `room`: the title is cut, the others take more
 *  lines. */
export function drawHeader(g, title, lines, room) {
    const inside = room - 2 * EDGE, heading = `bold 16px ${FONT}`, plain = `13px ${FONT}`;
    g.font = heading;
    const name = shortened(g, title, inside), wide = [g.measureText(name).width];
    g.font = plain;
    const rows = lines.flatMap((line) => wrapped(g, line, () => inside)).map((row) => shortened(g, row, inside));
    wide.push(...rows.map((row) => g.measureText(row).width));
    paper(g, Math.max(...wide) + 2 * EDGE, 34 + LINE * rows.length);
    g.font = heading;
    g.fillText(name, EDGE, 23);
    g.font = plain;
    rows.forEach((row, i) => g.fillText(row, EDGE, 43 + LINE * i));
}

function paper(g, width, height) {
    g.fillStyle = PAPER;
    g.beginPath();
    g.roundRect(0, 0, width, height, 6);
    g.fill();
    g.fillStyle = INK;
}

/** Swatches with their names in as many rows as the width asks for. */
function rowsOf(g, list) {
    const rows = [];
    let x = 0;
    for (const key of list) {
        const wide = SWATCH + g.measureText(key[1]).width;
        if (!rows.length || x + wide > WIDTH - 2 * EDGE) { rows.push([]); x = 0; }
        rows.at(-1).push(key);
        x += wide + GAP;
    }
    return rows;
}

/** list: [colour, name, whether it is dashed], ... */
function swatches(g, y, list) {
    let x = EDGE;
    for (const [colour, name, dashed] of list) {
        g.fillStyle = colour;
        g.fillRect(x, y - 9, 10, 10);
        if (dashed) {
            g.fillStyle = HALO;
            g.fillRect(x + 4, y - 9, 2, 10);
        }
        g.strokeStyle = '#5b7388';
        g.lineWidth = 0.7;
        g.strokeRect(x, y - 9, 10, 10);
        g.fillStyle = INK;
        g.fillText(name, x + SWATCH, y);
        x += SWATCH + g.measureText(name).width + GAP;
    }
}

/** The letter stays upright and goes round with the point of the arrow.  Scenarios know no north; Fram's pages draw Y
 *  up, so north is along Y. */
function north(g, x, y, angle) {
    g.save();
    g.translate(x, y);
    g.rotate(angle);
    g.strokeStyle = INK;
    g.lineWidth = 1.8;
    g.beginPath();
    g.moveTo(0, 13); g.lineTo(0, -11);
    g.moveTo(-5, -4); g.lineTo(0, -11); g.lineTo(5, -4);
    g.stroke();
    g.restore();
    g.font = `bold 11px ${FONT}`;
    g.textAlign = 'center';
    g.fillText('Y', x + 19 * Math.sin(angle), y - 19 * Math.cos(angle) + 4);
    g.textAlign = 'left';
}
