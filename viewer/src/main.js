// The page: reads the record that stands in it, and plays it.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { History } from './history.js';
import { drawHeader, Legend, secondsText } from './legend.js';
import { Poses } from './poses.js';
import { Loads } from './loads.js';
import { PeakPanel } from './peaks.js';
import { follow } from './live.js';
import { bytesOf, Chunks, forcesOf, FrameStore, readRecord } from './record.js';
import { readScenario, sizesOf, vesselsOf } from './scenario.js';
import { own, Scene } from './scene.js';
import { Timeline } from './timeline.js';

const $ = (id) => document.getElementById(id);
const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 20, 60];
const MARKED = 10; // seconds that a fracture stays marked
const GAP = 12, LEAST_PANEL = 150; // from the legend to the panel of a peak under it, and what that asks for [px]
const COLOURS = {
    plain: { unit: null },
    speed: { unit: 'speed [m/s]' },
    force: { unit: 'contact force [kN]' },
    thickness: { unit: 'thickness [m]' },
    age: { unit: 'time since it broke off [s]' },
};

class Player {
    constructor(record) {
        this.record = record;
        const files = 1 + record.frames.reduce((most, f) => Math.max(most, f.chunk ?? -1), -1);
        this.chunks = new Chunks($('record').dataset.beside, files, () => this.arrived(),
            (name) => this.lose(name));
        this.store = new FrameStore(record, this.chunks);
        this.poses = new Poses(record, this.store);
        this.time = record.frames[0].time;
        this.end = record.frames.at(-1).time;
        this.playing = false;
        this.picked = null;
        this.dirty = true;
        const told = readScenario(record.scenario), vessels = vesselsOf(told);
        $('title').textContent = told.title || 'Fram';
        this.sizes = sizesOf(told);
        this.ofVessel = vessels.length > 1 ? ` on ${vessels[0].name}` : ''; // frames tell the force on the first
        this.begin();
    }

    /** Loads by mechanism and peaks have come, after the end of a run that was looked at. */
    explain() {
        if (!this.ready) return; // begin tells them
        this.findRanges();
        this.tellLoads();
        this.resize();
        this.dirty = true;
    }

    /** When the first frame is there, which may lie in a file beside the page. */
    begin() {
        const { record } = this, first = this.store.get(0);
        if (!first) {
            if (!this.sayGone([0])) setTimeout(() => this.begin(), 20);
            return;
        }
        this.scene = new Scene($('view'), record, this.poses, first);
        this.controls = new OrbitControls(this.scene.camera, $('view'));
        this.legend = new Legend();
        this.peakShown = false;
        this.timeline = new Timeline($('timeline'), record, (t) => this.seek(t), (p) => this.peaks.open(p));
        this.tellLoads();
        this.history = new History($('history'), record, this.store);
        this.hull = record.bodies.find((b) => b.material === 'hull');
        this.drawn = { bodies: record.bodies.length, fractures: record.fractures.length };
        this.tabulate();
        this.poses.show(0);
        this.findRanges();
        this.connect();
        this.placeCamera();
        this.showPressure();
        this.resize();
        this.ready = true;
        requestAnimationFrame((now) => this.tick(now));
    }

    /** Curve and peaks of the vessel that is chosen; a page without them shows the load at the frames. */
    tellLoads() {
        const { record } = this;
        $('timeline').className = record.loads ? '' : 'plain';
        $('hulls').hidden = !this.scene.pressure;
        if (!record.loads) return;
        this.loads = new Loads(record.loads);
        this.peaks = new PeakPanel($('peak'), record, this.loads, (t) => this.seek(t), () => this.changePeak());
        this.loads.vessels.forEach((v, i) => $('vessel').add(new Option(v.name, i)));
        $('vessels').hidden = this.loads.vessels.length < 2;
        $('vessel').onchange = () => this.chooseVessel();
        this.chooseVessel();
    }

    chooseVessel() {
        const vessel = this.loads.vessels[$('vessel').value];
        this.peaks.setVessel(vessel);
        this.timeline.show(this.loads, vessel);
    }

    changePeak() {
        if (this.peaks.peak) {
            this.pick(null);
            this.scene.lit.set(this.peaks.bodies);
        }
        if (this.ready) this.setLegend();
        this.dirty = true;
    }

    /** Floes of the peak and what they press with, as long as the moment is near. */
    showPeak(time) {
        const near = this.peaks?.isNear(time) ?? false, { scene } = this;
        scene.lit.place(this.poses, near);
        if (near === this.peakShown) return;
        this.peakShown = near;
        const width = this.scene.arrowWidth, scale = this.arrowScale;
        scene.peakArrows.show(near ? this.peaks.lines(scale, 0.05 * width) : []);
    }

    showStation() {
        const { station } = this.scene, before = station.gone;
        station.show(this.poses);
        if (station.gone > 0 !== before > 0) this.setLegend();
    }

    showPressure() {
        const { scene } = this, which = scene.pressure ? $('hull').value : 'none';
        const high = scene.pressure?.colour(which, RAMP) ?? 0;
        this.hullScale = which === 'none' ? null : { unit: `${which} pressure [kPa]`, ends: [0, high / 1000] };
        scene.veil(which !== 'none');
        this.setLegend();
    }

    /** The record has grown.  A view that stood at its end goes on with it. */
    grow() {
        if (!this.ready) return;
        const { frames, bodies, fractures } = this.record, atEnd = this.time >= this.end;
        this.end = frames.at(-1).time;
        if (bodies.length !== this.drawn.bodies || fractures.length !== this.drawn.fractures) {
            this.drawn = { bodies: bodies.length, fractures: fractures.length };
            this.poses.grow();
            this.scene.grow();
            this.tabulate();
            this.coloured = null;
        }
        this.poses.frame = -1;
        if (this.outgrown()) {
            this.findRanges();
            this.setLegend();
        }
        this.timeline.grow();
        if (this.picked) this.history.grow();
        if (atEnd && !this.playing) this.time = this.end;
        this.dirty = true;
    }

    /** Of a file from beside the page: there is more to draw, and to tell of a picked floe. */
    arrived() {
        this.dirty = true;
        if (this.picked) this.history.more();
    }

    lose(name) {
        this.dirty = true;
        tell(`${name} is missing or damaged: it belongs beside this page.`);
    }

    /** Whether the file of one of these frames is lost, which is said where others are waited for. */
    sayGone(frames) {
        const { lost } = this.chunks, gone = frames.some((f) => lost.has(this.record.frames[f].chunk));
        $('waiting').textContent = gone ? 'the file of this moment is missing or damaged' : 'loading ...';
        $('waiting').hidden = false;
        return gone;
    }

    connect() {
        for (const s of SPEEDS) $('speed').add(new Option(`${s} x`, s, s === 5, s === 5));
        $('play').onclick = () => this.toggle();
        $('camera').onchange = () => this.placeCamera();
        $('colour').onchange = () => { this.setLegend(); this.dirty = true; };
        $('forces').onchange = () => { this.setLegend(); this.dirty = true; };
        $('hull').onchange = () => this.showPressure();
        $('still').onclick = () => this.still();
        $('film').onclick = () => this.film();
        this.controls.addEventListener('change', () => { this.dirty = true; });
        window.addEventListener('resize', () => this.resize());
        // Its texts may take another line; the view ends where it begins.
        new ResizeObserver(() => this.resize()).observe(document.querySelector('footer'));
        window.addEventListener('keydown', (e) => this.key(e));
        const canvas = $('view');
        canvas.addEventListener('pointerdown', (e) => { this.pressed = [e.clientX, e.clientY]; });
        canvas.addEventListener('pointerup', (e) => {
            const [x, y] = this.pressed ?? [0, 0];
            if (Math.hypot(e.clientX - x, e.clientY - y) < 4) this.pickAt(e.clientX, e.clientY);
        });
    }

    key(e) {
        // A control that has the focus keeps the keys it works by: without a mouse there is no other way.
        const { target } = e, own = e.code === 'Space' ? 'button, input, select' : 'select';
        if (e.ctrlKey || e.altKey || e.metaKey || target.matches?.(own)) return;
        const { frames } = this.record, [before, after] = this.beside();
        if (e.code === 'Space') this.toggle();
        else if (e.code === 'ArrowRight') this.seek(frames[after].time);
        else if (e.code === 'ArrowLeft') this.seek(frames[before].time);
        else if (e.code === 'Home') this.seek(frames[0].time);
        else if (e.code === 'End') this.seek(this.end);
        else if (e.code === 'Enter' && target === $('timeline')) this.timeline.openNearest(this.time);
        else if (e.code === 'Escape') { this.peaks?.close(); this.pick(null); }
        else return;
        e.preventDefault();
    }

    /** The frames before and after the time, which may be that of a frame to rounding. */
    beside() {
        const at = this.frameAt(this.time), near = Math.round(at), now = Math.abs(at - near) < 1e-6 ? near : at;
        return [Math.max(Math.ceil(now) - 1, 0), Math.min(Math.floor(now) + 1, this.record.frames.length - 1)];
    }

    seek(time) {
        this.time = Math.min(this.end, Math.max(this.record.frames[0].time, time));
        this.dirty = true;
    }

    toggle() {
        if (!this.playing && this.time >= this.end) this.time = this.record.frames[0].time;
        this.playing = !this.playing;
        this.dirty = true;
        $('play').innerHTML = this.playing ? '&#10074;&#10074;' : '&#9654;';
        $('play').ariaLabel = this.playing ? 'pause' : 'play';
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

    /** Ends of the colours and lengths of arrows: the 99th percentile of the frames that need no file from beside the
     *  page; of speeds, which all bodies have, that of some of these. */
    findRanges() {
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
            age: [0, Math.max(10, 0.25 * (this.end - record.frames[0].time))],
        };
        this.kinds = ['ice', 'line', 'thruster', 'hull'].filter((kind) => kinds.has(kind));
        const size = this.scene.box.getSize(new THREE.Vector3());
        // A few arrows may be longer: one hard blow must not make all others vanish.
        this.arrowScale = 0.12 * Math.max(size.x, size.y) / this.ends.pulls.value;
        this.scene.arrowWidth = 0.05 * Math.max(size.x, size.y);
    }

    centre() {
        if (this.hull) {
            const at = 7 * this.hull.index;
            return new THREE.Vector3(this.poses.pose[at], this.poses.pose[at + 1], 0);
        }
        return this.scene.box.getCenter(new THREE.Vector3()).setZ(0);
    }

    /** Of the hull [m]. */
    length() {
        let [stern, stem] = [Infinity, -Infinity];
        for (let i = 0; i < (this.hull?.vertices?.length ?? 0); i += 3) {
            stern = Math.min(stern, this.hull.vertices[i]);
            stem = Math.max(stem, this.hull.vertices[i]);
        }
        return Math.max(0, stem - stern);
    }

    placeCamera() {
        const size = this.scene.box.getSize(new THREE.Vector3()), wide = Math.max(size.x, size.y);
        const mode = $('camera').value, camera = this.scene.camera;
        // A ship is seen whole, however small the domain is beside it and however narrow the window.
        const { width, height } = this.room();
        const upright = Math.max(1, height / width);
        const near = Math.max(wide, 3.5 * this.length()) * upright;
        this.poses.show(this.frameAt(this.time));
        const target = mode === 'follow' || mode === 'below' ? this.centre()
            : this.scene.box.getCenter(new THREE.Vector3()).setZ(0);
        const offset = mode === 'top' ? [0, -0.001, 1.35 * wide]
            : mode === 'below' ? [-0.12 * wide, -0.24 * wide, -0.14 * wide]
            : mode === 'follow' ? [-0.28 * near, -0.3 * near, 0.2 * near]
            : [-0.55 * wide, -0.75 * wide, 0.6 * wide];
        camera.position.copy(target).add(new THREE.Vector3(...offset));
        this.controls.target.copy(target);
        this.controls.update();
        this.hullAt = this.hull && this.centre();
        this.dirty = true;
    }

    /** Number of the frame at a time, with a fraction. */
    frameAt(time) {
        const frames = this.record.frames;
        let lo = 0, hi = frames.length - 1;
        while (hi - lo > 1) {
            const mid = (lo + hi) >> 1;
            if (frames[mid].time <= time) lo = mid; else hi = mid;
        }
        const span = frames[hi].time - frames[lo].time;
        return span > 0 ? lo + Math.min(1, Math.max(0, (time - frames[lo].time) / span)) : lo;
    }

    // ---- colours ----

    /** Own colours, and for the modes with a value those of the ramp for ice that has one. */
    colourBodies(time) {
        const mode = $('colour').value, [lo, hi] = this.ranges[mode] ?? [0, 1], { rgb, poses } = this;
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
    }

    setLegend() {
        const { unit } = COLOURS[$('colour').value], mode = $('colour').value, ends = [...this.ranges[mode] ?? [0, 1]];
        if (mode === 'age') ends.reverse();
        const ice = this.record.bodies.some((b) => b.material === 'ice');
        const keys = [[ice, own({ material: 'ice' }), 'ice'], [this.hull, own({ material: 'hull' }), 'vessel']];
        this.legend.set({
            unit, ends, ramp: [0, 0.25, 0.5, 0.75, 1].map((t) => `#${ramp(t).getHexString()}`),
            keys: keys.filter(([there]) => there).map(([, colour, name]) => [`#${colour.getHexString()}`, name]),
            forces: $('forces').checked ? this.kinds : [], station: this.scene.station.keys(),
            marked: this.record.fractures.length ? MARKED : 0, hull: this.hullScale, peak: Boolean(this.peaks?.peak),
            vessels: this.record.bodies.filter((b) => b.material === 'hull').length,
        });
        this.placePeak();
        this.dirty = true;
    }

    /** The scale bar holds at the point the camera looks at; the arrow points along global Y as it is seen there. */
    scaleAndNorth() {
        const camera = this.scene.camera, { target } = this.controls, distance = camera.position.distanceTo(target);
        const perPixel = 2 * distance * Math.tan(camera.fov * Math.PI / 360) / $('view').clientHeight;
        const raw = 130 * perPixel, power = 10 ** Math.floor(Math.log10(raw));
        const length = power * [5, 2, 1].find((m) => m * power <= raw);
        camera.updateMatrixWorld();
        const at = target.clone().project(camera);
        const to = target.clone().add(new THREE.Vector3(0, 0.05 * distance, 0)).project(camera);
        const angle = Math.atan2((to.x - at.x) * camera.aspect, to.y - at.y);
        return { length, pixels: Math.round(length / perPixel), force: length / this.arrowScale / 1000,
                 angle: Math.round(angle * 100) / 100 };
    }

    // ---- picking and export ----

    pickAt(clientX, clientY) {
        const box = $('view').getBoundingClientRect();
        const x = 2 * (clientX - box.left) / box.width - 1, y = 1 - 2 * (clientY - box.top) / box.height;
        this.pick(this.scene.bodyAt(x, y));
    }

    pick(body) {
        this.picked = body;
        this.scene.pick(body);
        this.history.show(body);
        this.dirty = true;
    }

    /** The picture as it stands with title, time and legend drawn into it. */
    compose(out) {
        const from = $('view'), ratio = from.width / from.clientWidth, g = out.getContext('2d');
        if (out.width !== from.width || out.height !== from.height) {
            out.width = from.width; out.height = from.height;
        }
        g.setTransform(1, 0, 0, 1, 0, 0);
        g.drawImage(from, 0, 0);
        g.setTransform(ratio, 0, 0, ratio, 12 * ratio, 12 * ratio);
        drawHeader(g, $('title').textContent, [$('clock').textContent, $('load').textContent]);
        g.setTransform(ratio, 0, 0, ratio, from.width - (this.legend.width + 12) * ratio, 12 * ratio);
        this.legend.draw(g, this.scaleAndNorth());
        return out;
    }

    still() {
        return new Promise((done) => {
            this.draw();
            this.compose(document.createElement('canvas')).toBlob((blob) => {
                download(blob, `fram-${this.time.toFixed(1)}s.png`);
                done(blob);
            });
        });
    }

    /** Records the canvas while the run plays to its end; a second click ends it. */
    film() {
        if (this.recorder) { this.recorder.stop(); return this.filmed; }
        const type = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/mp4']
            .find((t) => window.MediaRecorder?.isTypeSupported(t));
        if (!type) { note('This browser cannot record video; fram video makes one.'); return Promise.resolve(null); }
        const parts = [];
        this.filmCanvas = this.compose(document.createElement('canvas'));
        const stream = this.filmCanvas.captureStream(25);
        this.recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 8e6 });
        this.recorder.ondataavailable = (e) => parts.push(e.data);
        this.filmed = new Promise((done) => {
            this.recorder.onstop = () => {
                const blob = new Blob(parts, { type });
                this.recorder = null;
                $('film').textContent = 'video';
                download(blob, `fram.${type.includes('mp4') ? 'mp4' : 'webm'}`);
                done(blob);
            };
        });
        this.recorder.start(500);
        $('film').textContent = 'stop';
        if (!this.playing) this.toggle();
        return this.filmed;
    }

    // ---- the loop ----

    /** Size of the scene: of the page's root, since a phone's window grows with what sticks out of the screen. */
    room() {
        const { clientWidth, clientHeight } = document.documentElement;
        return { width: clientWidth, height: clientHeight - document.querySelector('footer').offsetHeight };
    }

    resize() {
        const { width, height } = this.room();
        this.scene.resize(width, height);
        this.placePeak();
        this.dirty = true;
    }

    /** What a peak tells stands under the legend, in a low window beside it, and never under the buttons. */
    placePeak() {
        const legend = $('legend'), { style } = $('peak'), { height } = this.room();
        const foot = legend.offsetTop + new DOMMatrix(getComputedStyle(legend).transform).a * this.legend.height;
        const under = height - foot - GAP >= LEAST_PANEL, top = under ? foot + GAP : 8;
        style.top = `${top}px`;
        style.left = under ? '' : '8px';
        style.right = under ? '' : 'auto';
        style.maxHeight = `${height - top - 8}px`;
    }

    tick(now) {
        const passed = this.last ? (now - this.last) / 1000 : 0;
        this.last = now;
        if (this.playing && !this.waiting) {
            this.time = Math.min(this.end, this.time + passed * Number($('speed').value));
            if (this.time >= this.end) this.stop();
            this.dirty = true;
        }
        if (this.dirty) this.draw();
        requestAnimationFrame((t) => this.tick(t));
    }

    stop() {
        this.toggle();
        if (this.recorder) this.recorder.stop();
    }

    /** What a frame costs this script, without the drawing itself, is measured in prepare(). */
    draw() {
        this.dirty = false;
        if (!this.prepare()) return;
        this.scene.render();
        if (this.recorder) this.compose(this.filmCanvas);
    }

    prepare() {
        const before = this.hullAt; // where it was drawn last: the poses may be of another moment by now
        const state = this.poses.show(this.frameAt(this.time));
        this.waiting = !state;
        $('waiting').hidden = true;
        if (!state) {
            if (this.sayGone(this.poses.wanted) && this.playing) this.stop();
            return false;
        }
        this.hullAt = this.hull && this.centre();
        if (['follow', 'below'].includes($('camera').value) && before) {
            const moved = this.hullAt.clone().sub(before);
            this.scene.camera.position.add(moved);
            this.controls.target.add(moved);
        }
        this.colourBodies(state.time);
        this.scene.update(this.rgb);
        this.showPeak(state.time);
        this.scene.pressure?.place(this.poses);
        const forces = $('forces').checked ? this.poses.forces : [];
        this.scene.showForces(this.peakShown ? forces.filter((f) => f.kind !== 'ice') : forces, this.arrowScale);
        this.showStation();
        this.scene.showMarkers(state.time, MARKED);
        if (this.picked) this.scene.placeRing(this.picked);
        this.history.draw(state.time);
        this.timeline.draw(this.time);
        this.legend.show($('legend'), this.scaleAndNorth());
        this.tell(state);
        return true;
    }

    /** Whole kilonewtons, of a model with as many digits as its size asks for; never "-0". */
    loadText(newton) {
        const digits = Math.min(20, Math.max(0, -Math.floor(Math.log10(this.sizes.force))));
        return `${(Number((newton / 1000).toFixed(digits)) || 0).toFixed(digits)} kN`;
    }

    tell(state) {
        const { floes, tiles } = this.poses, count = `${floes} ${floes === 1 ? 'floe' : 'floes'}`;
        const ice = tiles === 0 ? count : floes === 0 ? 'level ice' : `level ice and ${count}`;
        $('clock').textContent = `t = ${state.time.toFixed(2)} s of ${secondsText(this.end)} s, ${ice}`;
        this.timeline.tell(state.time);
        const [x, y] = state.force.map((newton) => this.loadText(newton));
        const [name, numbers] = $('load').children;
        name.textContent = this.hull ? `averaged ice force${this.ofVessel}: ` : '';
        numbers.textContent = this.hull ? `X ${x}, Y ${y}` : '';
    }
}

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

/** A page is opened to see the run; with #still at its end it waits for the button. */
function playWhenReady(player) {
    if (!player.ready) setTimeout(() => playWhenReady(player), 20);
    else if (!player.playing && player.record.frames.length > 1) player.toggle();
}

/** Follows a run that goes on, and says so until its first frame is there. */
function watch(address) {
    const waiting = $('waiting');
    waiting.textContent = 'waiting for the first frame ...';
    waiting.hidden = false;
    const begin = (grown) => {
        waiting.textContent = 'loading ...';
        window.fram = new Player(grown);
        return window.fram;
    };
    follow(address, begin, (text) => { waiting.hidden = true; tell(text); });
}

function download(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function note(text) { tell(text); setTimeout(() => { $('note').textContent = ''; }, 6000); }
function tell(text) { $('note').textContent = text; }

/** White as ice over amber to dark purple: slow or thin to fast or thick.  The same as image_ramp of src/io/image.c. */
const STOPS = [[0.96, 0.97, 0.96], [0.98, 0.72, 0.30], [0.42, 0.05, 0.35]];
function ramp(t) {
    const x = 2 * Math.min(1, Math.max(0, t)), k = x < 1 ? 0 : 1;
    const [r, g, b] = STOPS[k].map((v, i) => v + (x - k) * (STOPS[k + 1][i] - v));
    return new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
}
const RAMP = Float32Array.from({ length: 768 }, (_, i) => ramp(Math.floor(i / 3) / 255).toArray()[i % 3]);

try {
    const record = $('record').textContent.trim();
    // A page without a record follows one that is being written.
    if (record) {
        window.fram = new Player(readRecord(bytesOf(record)));
        if (location.hash !== '#still') playWhenReady(window.fram);
    }
    else watch($('record').dataset.beside);
} catch (e) {
    $('note').textContent = `The record cannot be played: ${e.message}`;
    throw e;
}
