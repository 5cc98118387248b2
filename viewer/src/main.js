// The page: reads the record that stands in it, and plays it.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { Poses } from './poses.js';
import { readRecord, titleOf } from './record.js';
import { Scene } from './scene.js';
import { Timeline } from './timeline.js';

const $ = (id) => document.getElementById(id);
const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 20, 60];

function bytesOf(base64) {
    const text = atob(base64.trim()), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
    return bytes.buffer;
}

class Player {
    constructor(record) {
        this.record = record;
        this.poses = new Poses(record);
        this.scene = new Scene($('view'), record, this.poses);
        this.controls = new OrbitControls(this.scene.camera, $('view'));
        this.timeline = new Timeline($('timeline'), record.frames, (t) => { this.time = t; this.dirty = true; });
        this.time = record.frames[0].time;
        this.end = record.frames.at(-1).time;
        this.hull = record.bodies.find((b) => b.material === 'hull');
        this.ranges = { thickness: this.range((b) => b.thickness), speed: [0, this.topSpeed()] };
        this.playing = false;
        this.dirty = true;
        $('title').textContent = titleOf(record) || 'Fram';
        this.connect();
        this.placeCamera();
        this.resize();
        this.legend();
        requestAnimationFrame((now) => this.tick(now));
    }

    connect() {
        for (const s of SPEEDS) $('speed').add(new Option(`${s} x`, s, s === 5, s === 5));
        $('play').onclick = () => this.toggle();
        $('camera').onchange = () => this.placeCamera();
        $('colour').onchange = () => { this.legend(); this.dirty = true; };
        this.controls.addEventListener('change', () => { this.dirty = true; });
        window.addEventListener('resize', () => this.resize());
        window.addEventListener('keydown', (e) => { if (e.code === 'Space') { e.preventDefault(); this.toggle(); } });
    }

    toggle() {
        if (this.time >= this.end) this.time = this.record.frames[0].time;
        this.playing = !this.playing;
        $('play').innerHTML = this.playing ? '&#10074;&#10074;' : '&#9654;';
    }

    range(value) {
        const all = this.record.bodies.filter((b) => b.material === 'ice').map(value);
        return all.length ? [Math.min(...all), Math.max(...all)] : [0, 1];
    }

    /** The 99th percentile of the floes' speeds at some frames. */
    topSpeed() {
        const all = [], n = this.record.frames.length;
        for (let k = 0; k < Math.min(n, 12); k++) {
            this.poses.show(Math.floor(k * (n - 1) / 12));
            for (const b of this.record.bodies)
                if (b.material === 'ice' && this.poses.shown[b.index]) all.push(this.poses.speed[b.index]);
        }
        all.sort((a, b) => a - b);
        return Math.max(0.05, all[Math.floor(0.99 * (all.length - 1))] || 0);
    }

    centre() {
        if (this.hull) {
            const at = 7 * this.hull.index;
            return new THREE.Vector3(...this.poses.pose.subarray(at, at + 2), 0);
        }
        return this.scene.box.getCenter(new THREE.Vector3()).setZ(0);
    }

    placeCamera() {
        const size = this.scene.box.getSize(new THREE.Vector3()), wide = Math.max(size.x, size.y);
        const mode = $('camera').value, camera = this.scene.camera;
        this.poses.show(this.frameAt(this.time));
        const target = mode === 'follow' ? this.centre() : this.scene.box.getCenter(new THREE.Vector3()).setZ(0);
        const offset = mode === 'top' ? [0, -0.001, 1.35 * wide]
            : mode === 'follow' ? [-0.28 * wide, -0.3 * wide, 0.2 * wide]
            : [-0.55 * wide, -0.75 * wide, 0.6 * wide];
        camera.position.copy(target).add(new THREE.Vector3(...offset));
        this.controls.target.copy(target);
        this.controls.update();
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

    colour(body) {
        const mode = $('colour').value;
        if (mode === 'plain' || body.material !== 'ice') return null;
        const [lo, hi] = this.ranges[mode], value = mode === 'speed' ? this.poses.speed[body.index] : body.thickness;
        return ramp(hi > lo ? (value - lo) / (hi - lo) : 0);
    }

    legend() {
        const mode = $('colour').value, unit = { speed: 'speed [m/s]', thickness: 'thickness [m]' }[mode];
        const stops = [0, 0.25, 0.5, 0.75, 1].map((t) => `#${ramp(t).getHexString()}`).join(',');
        const [lo, hi] = this.ranges[mode] ?? [];
        const bar = () => `${unit}<div class="bar" style="background:linear-gradient(90deg,${stops})"></div>
            <div class="ends"><span>${lo.toPrecision(2)}</span><span>${hi.toPrecision(2)}</span></div>`;
        $('legend').innerHTML = (unit ? bar() : 'floes white, vessel red')
            + '<div class="scale" id="scale"></div><span id="scale-text"></span>';
        this.dirty = true;
    }

    /** The scale bar holds at the point the camera looks at. */
    drawScale() {
        const camera = this.scene.camera, distance = camera.position.distanceTo(this.controls.target);
        const perPixel = 2 * distance * Math.tan(camera.fov * Math.PI / 360) / $('view').clientHeight;
        const raw = 150 * perPixel, power = 10 ** Math.floor(Math.log10(raw));
        const length = power * [5, 2, 1].find((m) => m * power <= raw);
        $('scale').style.width = `${length / perPixel}px`;
        $('scale-text').textContent = `${length} m`;
    }

    resize() {
        this.scene.resize(window.innerWidth, window.innerHeight);
        this.dirty = true;
    }

    tick(now) {
        const passed = this.last ? (now - this.last) / 1000 : 0;
        this.last = now;
        if (this.playing) {
            this.time = Math.min(this.end, this.time + passed * Number($('speed').value));
            if (this.time >= this.end) this.toggle();
            this.dirty = true;
        }
        if (this.dirty) this.draw();
        requestAnimationFrame((t) => this.tick(t));
    }

    draw() {
        this.dirty = false;
        const before = this.hull && this.centre();
        const state = this.poses.show(this.frameAt(this.time));
        if ($('camera').value === 'follow' && before) {
            const moved = this.centre().sub(before);
            this.scene.camera.position.add(moved);
            this.controls.target.add(moved);
        }
        this.scene.update((b) => this.colour(b));
        this.scene.render();
        this.timeline.draw(this.time);
        this.drawScale();
        const floes = this.record.bodies.reduce((n, b) => n + (b.material === 'ice' && this.poses.shown[b.index]), 0);
        $('clock').textContent = `t = ${state.time.toFixed(2)} s of ${this.end.toFixed(0)} s, ${floes} floes`;
        const [x, y] = state.force.map((newton) => (newton / 1000).toFixed(0));
        $('load').textContent = `ice force X ${x} kN, Y ${y} kN`;
    }
}

/** Blue over white to red: slow or thin to fast or thick. */
function ramp(t) {
    const x = Math.min(1, Math.max(0, t));
    return x < 0.5 ? new THREE.Color(0x3a6fb0).lerp(new THREE.Color(0xf4f4ee), 2 * x)
        : new THREE.Color(0xf4f4ee).lerp(new THREE.Color(0xb8321e), 2 * x - 1);
}

try {
    window.fram = new Player(readRecord(bytesOf($('record').textContent)));
} catch (e) {
    $('note').textContent = `The record cannot be played: ${e.message}`;
    throw e;
}
