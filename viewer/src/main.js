// The page: reads the record that stands in it, and plays it.
import { Camera, goesAlong } from './camera.js';
import { Colours, RAMP, ramp } from './colours.js';
import { Film } from './film.js';
import { History } from './history.js';
import { forceTextBeside, Legend, secondsText } from './legend.js';
import { follow } from './live.js';
import { Loads } from './loads.js';
import { $, tell } from './page.js';
import { PeakPanel } from './peaks.js';
import { Poses } from './poses.js';
import { bytesOf, Chunks, FrameStore, hullsOf, readRecord } from './record.js';
import { scenarioOf, sizesOf, vesselsOf } from './scenario.js';
import { own, rendererOn, Scene } from './scene.js';
import { Timeline } from './timeline.js';

const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 20, 60];
const MARKED = 10; // seconds that a fracture stays marked
const LEAST_VIEW = 40; // height [px]
const LEAST_LEGEND = 0.5; // of its full size: smaller it cannot be read
const GAP = 12, LEAST_PANEL = 150; // from the legend to the panel of a peak under it, and what that asks for [px]

class Player {
    /** @param live of a run that goes on: the view begins at its end, and so goes on with it. */
    constructor(record, live = false) {
        this.record = record;
        const files = 1 + record.frames.reduce((most, f) => Math.max(most, f.chunk ?? -1), -1);
        this.chunks = new Chunks($('record').dataset.beside, files, () => this.arrived(),
            (name) => this.lose(name));
        this.store = new FrameStore(record, this.chunks);
        this.poses = new Poses(record, this.store);
        this.end = record.frames.at(-1).time;
        this.time = live ? this.end : record.frames[0].time;
        this.playing = false;
        this.picked = null;
        this.dirty = true;
        const told = scenarioOf(record), vessels = vesselsOf(told);
        $('title').textContent = told.title || 'Fram';
        if (told.title) document.title = `${told.title} - Fram playback`;
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
        const renderer = rendererOn($('view'));
        if (!renderer) { this.giveUp(); return; }
        this.scene = new Scene(renderer, record, this.poses, first);
        this.hull = hullsOf(record)[0];
        this.camera = new Camera($('view'), this.scene, this.poses, this.hull);
        this.colours = new Colours(record, this.poses, this.sizes);
        this.legend = new Legend();
        this.film = new Film($('view'), this.legend, () => this.seen());
        this.peakShown = false;
        this.timeline = new Timeline($('timeline'), record, this.ofVessel || ' on the vessel', (t) => this.seek(t),
            (p) => this.peaks.open(p));
        this.tellLoads();
        this.history = new History($('history'), record, this.store, () => this.placeHistory());
        this.drawn = { bodies: record.bodies.length, fractures: record.fractures.length };
        this.poses.show(0);
        this.findRanges();
        this.connect();
        this.placeCamera();
        this.showPressure();
        this.resize();
        this.ready = true;
        requestAnimationFrame((now) => this.tick(now));
    }

    /** Without what draws there is nothing that a button could do. */
    giveUp() {
        this.blind = true;
        $('waiting').hidden = true;
        document.querySelector('footer').hidden = true;
        tell('This browser has no WebGL 2: turn on hardware acceleration, or use fram video.');
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
        const number = Number($('vessel').value), vessel = this.loads.vessels[number];
        this.peaks.setVessel(vessel);
        this.timeline.show(this.loads, vessel);
        this.goWith(hullsOf(this.record)[number]);
    }

    /** Loads and hulls are both of the vessels that take part, in their order. */
    goWith(hull) {
        if (!hull || hull === this.hull) return;
        this.hull = this.camera.hull = hull;
        if (goesAlong($('camera').value)) this.placeCamera();
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
        const { arrowScale, arrowWidth } = this.colours;
        scene.peakArrows.show(near ? this.peaks.lines(arrowScale, 0.05 * arrowWidth) : []);
        this.setLegend();
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
            this.colours.tabulate();
            this.setLegend(); // the first ice has come, or the first break
        }
        this.poses.frame = -1;
        if (this.colours.outgrown()) {
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
        $('picture').onclick = () => this.still();
        $('film').onclick = () => this.takeFilm();
        this.camera.controls.addEventListener('change', () => { this.dirty = true; });
        window.addEventListener('resize', () => this.resize());
        // Its texts may take another line; the view ends where it begins.
        new ResizeObserver(() => this.resize()).observe(document.querySelector('footer'));
        window.addEventListener('keydown', (e) => this.key(e));
        // A list that was used with a pointer lets the keys go again; with keys it keeps them.
        window.addEventListener('pointerdown', (e) => { this.pointed = e.target; });
        window.addEventListener('change', ({ target }) => {
            if (target === this.pointed && target.matches('select')) target.blur();
        });
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
        this.pointed = null;
        if (e.ctrlKey || e.altKey || e.metaKey || (e.code !== 'Escape' && target.matches?.(own))) return;
        const { frames } = this.record, [before, after] = this.beside();
        if (target === $('view') && this.viewKey(e)) { e.preventDefault(); return; }
        if (e.code === 'Space') this.toggle();
        else if (e.code === 'ArrowRight') this.seek(frames[after].time);
        else if (e.code === 'ArrowLeft') this.seek(frames[before].time);
        else if (e.code === 'Home') this.seek(frames[0].time);
        else if (e.code === 'End') this.seek(this.end);
        else if (e.code === 'Enter' && target === $('timeline')) this.openNearest();
        else if (e.code === 'Escape') { this.peaks?.close(); this.pick(null); }
        else return;
        e.preventDefault();
    }

    /** Whether a key is one of the view's own, which it has with the focus only: letters are typed elsewhere. */
    viewKey(e) {
        const step = { n: 1, p: -1 }[e.key.toLowerCase()];
        if (step) this.pickNext(step);
        return Boolean(step) || this.camera.key(e);
    }

    /** Of whoever has no mouse: from the middle of the view outwards, and back. */
    pickNext(by) {
        const floes = this.scene.floesFrom(this.camera.controls.target), at = floes.indexOf(this.picked);
        if (floes.length) this.pick(floes[(Math.max(at, by < 0 ? 0 : -1) + by + floes.length) % floes.length]);
    }

    /** With the focus, which goes back when the panel is closed. */
    openNearest() {
        this.timeline.openNearest(this.time);
        this.peaks?.focus();
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

    findRanges() {
        this.colours.findRanges(this.scene.field, this.end);
        this.scene.arrowWidth = this.colours.arrowWidth;
    }

    placeCamera() {
        this.poses.show(this.frameAt(this.time));
        this.camera.place($('camera').value, this.room());
        this.dirty = true;
    }

    /** What the legend shows of the camera. */
    seen() { return this.camera.scaleAndNorth(this.colours.arrowScale); }

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

    setLegend() {
        const ice = this.record.bodies.some((b) => b.material === 'ice');
        const mode = ice ? $('colour').value : 'plain'; // nothing else has the colour of a number
        const { kinds } = this.colours, { unit, ends } = this.colours.scale(mode);
        if (mode === 'age') ends.reverse();
        const keys = [[ice, own({ material: 'ice' }), 'ice'], [this.hull, own({ material: 'hull' }), 'vessel']];
        this.legend.set({
            unit, ends, ramp: [0, 0.25, 0.5, 0.75, 1].map((t) => `#${ramp(t).getHexString()}`),
            keys: keys.filter(([there]) => there).map(([, colour, name]) => [`#${colour.getHexString()}`, name]),
            forces: $('forces').checked ? kinds : [], lit: this.peakShown, station: this.scene.station.keys(),
            marked: this.record.fractures.length ? MARKED : 0, hull: this.hullScale, peak: Boolean(this.peaks?.peak),
            vessels: hullsOf(this.record).length,
        });
        this.placePeak();
        this.dirty = true;
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

    still() {
        this.draw();
        return this.film.still(`fram-${this.time.toFixed(1)}s.png`);
    }

    /** Records the canvas while the run plays to its end; a second click ends it. */
    takeFilm() {
        return this.film.click(() => { if (!this.playing) this.toggle(); });
    }

    // ---- the loop ----

    /** Size of the scene: of the page's root, since a phone's window grows with what sticks out of the screen. */
    room() {
        const { clientWidth, clientHeight } = document.documentElement;
        const foot = document.querySelector('footer').offsetHeight;
        return { width: clientWidth, height: Math.max(LEAST_VIEW, clientHeight - foot) };
    }

    resize() {
        const { width, height } = this.room();
        this.ratio = window.devicePixelRatio;
        this.scene.resize(width, height);
        this.placePeak();
        this.placeHistory();
        this.dirty = true;
    }

    /** The legend is as small as the room asks for; returns where it ends. */
    placeLegend() {
        const legend = $('legend'), { a: size } = new DOMMatrix(getComputedStyle(legend).transform);
        const high = size * this.legend.height;
        const fit = Math.min(1, Math.max(0, this.room().height - legend.offsetTop - 8) / high);
        legend.style.scale = fit;
        document.body.classList.toggle('folded', size * fit < LEAST_LEGEND);
        return legend.offsetTop + fit * high;
    }

    /** What a peak tells stands under the legend, in a low window beside it, and never under the buttons. */
    placePeak() {
        const { style } = $('peak'), { height } = this.room(), foot = this.placeLegend();
        const under = height - foot - GAP >= LEAST_PANEL, top = under ? foot + GAP : 8;
        style.top = `${top}px`;
        style.left = under ? '' : '8px';
        style.right = under ? '' : 'auto';
        style.maxHeight = `${height - top - 8}px`;
    }

    /** What is told of a floe neither; where it has no room it takes the pointer, to be scrolled. */
    placeHistory() {
        const panel = $('history');
        panel.style.maxHeight = `${this.room().height - panel.offsetTop - 8}px`;
        panel.style.pointerEvents = panel.scrollHeight > panel.clientHeight ? 'auto' : '';
    }

    tick(now) {
        const passed = this.last ? (now - this.last) / 1000 : 0;
        this.last = now;
        // A page that is zoomed, or comes to another screen, may keep its size, and hear of nothing.  One that is
        // printed is asked for other pixels too, but has no ticks then: it keeps its picture, which is not drawn again
        // before it is on the paper.
        if (window.devicePixelRatio !== this.ratio) this.resize();
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
        this.film.stop();
    }

    /** What a frame costs this script, without the drawing itself, is measured in prepare(). */
    draw() {
        this.dirty = false;
        if (!this.prepare()) return;
        this.scene.render();
        this.film.add();
    }

    prepare() {
        const state = this.poses.show(this.frameAt(this.time));
        this.waiting = !state;
        $('waiting').hidden = true;
        if (!state) {
            if (this.sayGone(this.poses.wanted) && this.playing) this.stop();
            return false;
        }
        this.camera.follow($('camera').value);
        this.colours.colourBodies($('colour').value, state.time);
        this.scene.update(this.colours.rgb);
        this.showPeak(state.time);
        this.scene.pressure?.place(this.poses);
        const forces = $('forces').checked ? this.poses.forces : [];
        this.scene.showForces(this.peakShown ? forces.filter((f) => f.kind !== 'ice') : forces,
            this.colours.arrowScale);
        this.showStation();
        this.scene.showMarkers(state.time, MARKED);
        if (this.picked) this.scene.placeRing(this.picked);
        this.history.draw(state.time);
        this.timeline.draw(this.time);
        this.legend.show($('legend'), this.seen());
        this.tell(state);
        return true;
    }

    /** Beside the largest load at the frames. */
    loadText(newton) { return forceTextBeside(newton / 1000, this.timeline.most); }

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

/** A page is opened to see the run; with #still at its end, or where nothing shall move by itself, it waits for the
 *  button. */
function playWhenReady(player) {
    if (player.blind) return;
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
        window.fram = new Player(grown, true);
        return window.fram;
    };
    follow(address, begin, (text) => { waiting.hidden = true; if (!window.fram?.blind) tell(text); });
}

try {
    const record = $('record').textContent.trim();
    // A page without a record follows one that is being written.
    if (record) {
        window.fram = new Player(readRecord(bytesOf(record)));
        const rest = location.hash === '#still' || matchMedia('(prefers-reduced-motion: reduce)').matches;
        if (!rest) playWhenReady(window.fram);
    }
    else watch($('record').dataset.beside);
} catch (e) {
    $('note').textContent = `The record cannot be played: ${e.message}`;
    throw e;
}
