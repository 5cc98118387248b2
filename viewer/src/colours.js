// What stands for a number in the scene: the colours of bodies and the lengths of arrows, and how far each scale goes.
// Knows no drawing.
import * as THREE from 'three';
import { forceUnit } from './legend.js';
import { forcesOf } from './record.js';
import { own } from './scene.js';

/** Units of the ways to colour. */
const UNITS = {
    plain: null,
    speed: 'speed [m/s]',
    force: 'contact force [kN]',
    thickness: 'thickness [m]',
    age: 'time since it broke off [s]',
};

/** White as ice over amber to dark purple: slow or thin to fast or thick.  The same as image_ramp of src/io/image.c,
 *  which tests/views/test_playback.py looks at. */
const STOPS = [[0.96, 0.97, 0.96], [0.98, 0.72, 0.30], [0.42, 0.05, 0.35]];
export function ramp(t) {
    const x = 2 * Math.min(1, Math.max(0, t)), k = x < 1 ? 0 : 1;
    const [r, g, b] = STOPS[k].map((v, i) => v + (x - k) * (STOPS[k + 1][i] - v));
    return new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
}
/** Three numbers for each of 256 colours. */
export const RAMP = Float32Array.from({ length: 768 }, (_, i) => ramp(Math.floor(i / 3) / 255).toArray()[i % 3]);

/** The 99th percentile of numbers, or `least` where that is more. */
class End {
    constructor(all, least) {
        this.count = all.length;
        this.value = Math.max(least, Float64Array.from(all).sort()[this.rank] || 0);
        this.above = all.filter((v) => v > 2 * this.value).length;
    }

    get rank() { return Math.floor(0.99 * (this.count - 1)); }

    /** Whether that of these too is more than twice as large. */
    add(more) {
        this.count += more.length;
        this.above += more.filter((v) => v > 2 * this.value).length;
        return this.above > 0 && this.count - this.above <= this.rank;
    }
}

/** Per body: colour (rgb); per way to colour: least and greatest value (ranges); kinds of forces that there are. */
export class Colours {
    constructor(record, poses, sizes) {
        this.record = record;
        this.poses = poses;
        this.sizes = sizes;
        this.tabulate();
    }

    /** What does not change of each body, as tables: looked up in every frame. */
    tabulate() {
        const { bodies, frames } = this.record, n = bodies.length;
        this.ice = Uint32Array.from(bodies.filter((b) => b.material === 'ice'), (b) => b.index);
        this.thickness = Float32Array.from(bodies, (b) => b.thickness ?? 0);
        // What is left of a tile that broke has not broken off.
        const off = (b) => b.parent >= 0 && !b.level;
        this.brokeAt = Float64Array.from(bodies, (b) => (off(b) ? frames[b.birth]?.time ?? NaN : NaN));
        this.ownColours = new Float32Array(3 * n);
        for (const b of bodies) own(b).toArray(this.ownColours, 3 * b.index);
        this.rgb = this.ownColours.slice();
        this.coloured = null; // the way of the last time
    }

    /** Ends of the colours and lengths of arrows: the 99th percentile of the frames that need no file from beside the
     *  page; of speeds, which all bodies have, that of some of these.  field: of the scene; end: of the run [s]. */
    findRanges(field, end) {
        this.ranged = this.looked = this.record.frames.length;
        this.marked = this.record.fractures.length > 0;
        const { record, poses } = this, ice = record.bodies.filter((b) => b.material === 'ice');
        const thickness = ice.map((b) => b.thickness), n = record.frames.length, speed = [];
        const pairs = Array.from({ length: n - 1 }, (_, f) => f)
            .filter((f) => record.frames[f].view && record.frames[f + 1].view);
        const looks = Math.min(pairs.length, 12);
        for (let k = 0; k < looks; k++) {
            const f = pairs[Math.floor(k * pairs.length / looks)];
            poses.show(f, false);
            for (const b of ice) if (poses.shown[b.index] && b.death > f + 1) speed.push(poses.speed[b.index]);
        }
        // Contacts are rare: one that few frames have would be missed by looking at some of them.
        const { contacts: force, pulls: pull, kinds } = forcesOf(record);
        this.ends = { contacts: new End(force, this.sizes.force), pulls: new End(pull, this.sizes.force) };
        const least = (all) => all.reduce((a, b) => Math.min(a, b), Infinity);
        const most = (all) => all.reduce((a, b) => Math.max(a, b), -Infinity);
        this.ranges = {
            speed: [0, new End(speed, 0.05 * this.sizes.speed).value],
            force: [0, this.ends.contacts.value],
            thickness: thickness.length ? [least(thickness), most(thickness)] : [0, 1],
            age: [0, Math.max(10, 0.25 * (end - record.frames[0].time))],
        };
        this.kinds = ['ice', 'line', 'thruster', 'hull'].filter((kind) => kinds.has(kind));
        const size = field.getSize(new THREE.Vector3()), wide = Math.max(size.x, size.y);
        // A few arrows may be longer: one hard blow must not make all others vanish.
        this.arrowScale = 0.12 * wide / this.ends.pulls.value; // metres a newton
        this.arrowWidth = 0.05 * wide;
    }

    /** What the colours of a mode tell, with its unit, and their ends in it: of a force N, kN or MN as its end asks. */
    scale(mode) {
        const ends = [...this.ranges[mode] ?? [0, 1]], unit = UNITS[mode];
        if (mode !== 'force') return { unit, ends };
        const [name, per] = forceUnit(ends[1]);
        return { unit: unit.replace('kN', name), ends: ends.map((end) => end * per) };
    }

    /** Whether ends of colours and lengths of arrows have to be found again: at twice as many frames, and when a frame
     *  brings what they do not know: a kind of force, the first fracture, or so many large forces that an end more than
     *  doubles.  Each new frame is read once. */
    outgrown() {
        const { bodies, frames, fractures } = this.record, { ends } = this;
        const { contacts, pulls, kinds } = forcesOf({ bodies, frames: frames.slice(this.looked) });
        this.looked = frames.length;
        const rise = [ends.contacts.add(contacts), ends.pulls.add(pulls)].some(Boolean);
        return rise || frames.length >= 2 * this.ranged || fractures.length > 0 !== this.marked ||
            [...kinds].some((kind) => !this.kinds.includes(kind));
    }

    /** Own colours, and for the modes with a value those of the ramp for ice that has one. */
    colourBodies(mode, time) {
        const [lo, hi] = this.ranges[mode] ?? [0, 1], { rgb, poses } = this;
        const per = hi > lo ? 255 / (hi - lo) : 0, { shown } = poses, ice = this.ice;
        if (this.coloured !== mode) rgb.set(this.ownColours);
        this.coloured = mode;
        if (mode === 'plain') return;
        const values = mode === 'speed' ? poses.speed : mode === 'force' ? poses.contact
            : mode === 'thickness' ? this.thickness : this.brokeAt;
        for (let i = 0; i < ice.length; i++) {
            const k = ice[i];
            if (!shown[k]) continue;
            const value = mode === 'age' ? hi - (time - values[k]) : values[k]; // new is dark
            if (value !== value) continue; // an original floe has no age
            const c = 3 * Math.min(255, Math.max(0, Math.round((value - lo) * per)));
            rgb[3 * k] = RAMP[c]; rgb[3 * k + 1] = RAMP[c + 1]; rgb[3 * k + 2] = RAMP[c + 2];
        }
    }
}
