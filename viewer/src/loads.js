// What the page tells of loads beside the record (src/results/playback_explained.c): curves by mechanism and explained
// peaks of each vessel.  Knows no drawing.

import { BEHIND, CHAIN } from './legend.js';

/** Of one vessel: {name, window, transient, time, load, parts: one array for each mechanism, peaks}; a peak:
 *  {rank, time, load, sentence, detail: what fram why --json tells}. Times [s], forces [N]. */
export class Loads {
    constructor(told) {
        this.names = told.mechanisms.map(([name]) => name);
        this.texts = told.mechanisms.map(([, text]) => text);
        this.colours = told.mechanisms.map(([, , colour]) => colour);
        this.ends = new Map(told.ends); // of chains: name, text
        this.vessels = told.vessels.map((v) => ({
            ...v,
            peaks: v.peaks.map(({ sentence, detail }, i) => ({
                rank: i + 1, time: detail.time, load: detail.load, sentence, detail,
            })),
        }));
    }

    colour(mechanism) { return this.colours[this.names.indexOf(mechanism)] ?? BEHIND; }

    /** Mechanisms that have a part of the curve that is seen, by their place. */
    shown(vessel) {
        const most = vessel.load.reduce((a, b) => Math.max(a, b), 0);
        return this.names.map((_, m) => m).filter((m) => vessel.parts[m].some((p) => Math.abs(p) > 0.005 * most));
    }
}

/** The bodies of a peak by number of the floe: {number, colour, share of the load}; those of a chain that do not touch
 *  the vessel have no share. */
export function floesOf(loads, peak) {
    const out = new Map(), sum = (parts) => Object.values(parts).reduce((a, b) => a + b, 0);
    for (const f of peak.detail.floes) {
        if (f.floe < 0) continue;
        const before = out.get(f.floe)?.share ?? 0;
        const share = before + sum(f.parts) / peak.load;
        out.set(f.floe, { number: f.floe, colour: loads.colour(f.mechanism), share });
    }
    for (const f of peak.detail.floes)
        for (const link of f.chain)
            if (link.floe >= 0 && !out.has(link.floe)) out.set(link.floe, { number: link.floe, colour: BEHIND });
    return out;
}

/** Segments of a peak, {from, to, colour}: forces on the hull, as long as `length` metres a newton, and chains from
 *  body to body; places from the origin of the record. */
export function linesOf(loads, peak, length, [x, y]) {
    const out = [], near = (p) => [p[0] - x, p[1] - y, p[2]];
    for (const f of peak.detail.floes) {
        const colour = loads.colour(f.mechanism);
        const to = near(f.point);
        out.push({ to, from: to.map((p, i) => p - f.force[i] * length), colour });
        for (let k = 1; k < f.chain.length; k++) {
            if (k === f.left_out?.after) continue;
            out.push({ from: near(f.chain[k - 1].place), to: near(f.chain[k].place), colour: CHAIN });
        }
    }
    return out;
}

/** The longest chain of a peak in words: "hull, floe 3 (12 kN), floe 5 (9 kN): held by its inertia"; '' without one. */
export function chainText(loads, peak, forceText) {
    const length = (f) => f.chain.length + (f.left_out?.links ?? 0);
    const longest = peak.detail.floes.reduce((a, b) => (length(b) > length(a) ? b : a), { chain: [] });
    if (longest.chain.length < 2) return '';
    const other = (k) => (k + 1 === longest.chain.length && longest.end_vessel) || 'a body';
    const links = longest.chain.map((l, k) => `${l.floe >= 0 ? `floe ${l.floe}` : other(k)} (${
        forceText(Math.hypot(...l.push) / 1000)})`);
    if (longest.left_out) links.splice(longest.left_out.after, 0, `${longest.left_out.links} more`);
    return `Longest chain: hull, ${links.join(', ')}: ${loads.ends.get(longest.end)}.`;
}
