// From where the scene is seen: the ready views, the one that goes along with the hull, and what a metre and Y are on
// the screen.
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

const TURN = Math.PI / 24, ZOOM = 0.85, SHIFT = 40; // by a key: [radians], a factor, [px]
/** With Shift by the place of the key, else by what is written on it. */
const TURNS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const MOVES = { a: [1, 0], d: [-1, 0], w: [0, 1], s: [0, -1] };

export class Camera {
    /** hull: of the record, or none. */
    constructor(canvas, scene, poses, hull) {
        this.canvas = canvas;
        this.scene = scene;
        this.poses = poses;
        this.hull = hull;
        this.controls = new OrbitControls(scene.camera, canvas);
    }

    /** Whether a key turned, moved or zoomed the view. */
    key({ code, key, shiftKey }) {
        const { controls } = this, turn = shiftKey && TURNS[code], move = MOVES[key.toLowerCase()];
        if (turn?.[0]) controls.rotateLeft(TURN * turn[0]);
        else if (turn) controls.rotateUp(TURN * turn[1]);
        else if (move) controls.pan(SHIFT * move[0], SHIFT * move[1]);
        else if (key === '+' || key === '=') controls.dollyIn(ZOOM);
        else if (key === '-') controls.dollyOut(ZOOM);
        else return false;
        return true;
    }

    centre() {
        if (this.hull) {
            const at = 7 * this.hull.index;
            return new THREE.Vector3(this.poses.pose[at], this.poses.pose[at + 1], 0);
        }
        return this.scene.field.getCenter(new THREE.Vector3()).setZ(0);
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

    /** A ready view, of the moment that the poses are of.  room: {width, height} of the view. */
    place(mode, room) {
        const { camera, box, field } = this.scene, along = goesAlong(mode);
        const size = (along ? field : box).getSize(new THREE.Vector3()), wide = Math.max(size.x, size.y);
        // A ship is seen whole, however small the field is beside it and however narrow the window; from below, where
        // the camera is nearer, by more of its lengths.
        const upright = Math.max(1, room.height / room.width), length = this.length();
        const near = Math.max(wide, 3.5 * length) * upright, under = Math.max(wide, 5.5 * length * upright);
        const target = along ? this.centre() : box.getCenter(new THREE.Vector3()).setZ(0);
        const offset = mode === 'top' ? [0, -0.001, 1.35 * wide]
            : mode === 'below' ? [-0.12 * under, -0.24 * under, -0.14 * under]
            : mode === 'follow' ? [-0.28 * near, -0.3 * near, 0.2 * near]
            : [-0.55 * wide, -0.75 * wide, 0.6 * wide];
        camera.position.copy(target).add(new THREE.Vector3(...offset));
        this.controls.target.copy(target);
        this.controls.update();
        if (!along) this.showWhole(room);
        camera.far = Math.max(camera.far, 2 * camera.position.distanceTo(target));
        camera.updateProjectionMatrix();
        this.hullAt = this.hull && this.centre();
    }

    /** Back from the target until the corners of the box are in a view of this shape. */
    showWhole(room) {
        const { camera, box } = this.scene, { target } = this.controls, high = Math.tan(camera.fov * Math.PI / 360);
        camera.updateMatrixWorld();
        const [right, up, back] = [0, 1, 2].map((k) => new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, k));
        let away = camera.position.distanceTo(target);
        for (const x of [box.min.x, box.max.x]) {
            for (const y of [box.min.y, box.max.y]) {
                const p = new THREE.Vector3(x, y, 0).sub(target);
                const reach = Math.max(Math.abs(p.dot(up)), Math.abs(p.dot(right)) * room.height / room.width);
                away = Math.max(away, p.dot(back) + reach / high);
            }
        }
        camera.position.copy(target).addScaledVector(back, away);
    }

    /** After the poses have gone on: as far as the hull has from where it was at the last call. */
    follow(mode) {
        const before = this.hullAt;
        this.hullAt = this.hull && this.centre();
        if (!goesAlong(mode) || !before) return;
        const moved = this.hullAt.clone().sub(before);
        this.scene.camera.position.add(moved);
        this.controls.target.add(moved);
    }

    /** The scale bar holds at the point the camera looks at; the arrow points along global Y as it is seen there.
     *  arrowScale: of forces, metres a newton. */
    scaleAndNorth(arrowScale) {
        const { camera } = this.scene, { target } = this.controls, distance = camera.position.distanceTo(target);
        const perPixel = 2 * distance * Math.tan(camera.fov * Math.PI / 360) / this.canvas.clientHeight;
        const raw = 130 * perPixel, power = 10 ** Math.floor(Math.log10(raw));
        const length = power * [5, 2, 1].find((m) => m * power <= raw);
        camera.updateMatrixWorld();
        const at = target.clone().project(camera);
        const to = target.clone().add(new THREE.Vector3(0, 0.05 * distance, 0)).project(camera);
        const angle = Math.atan2((to.x - at.x) * camera.aspect, to.y - at.y);
        return { length, pixels: Math.round(length / perPixel), force: length / arrowScale / 1000,
                 angle: Math.round(angle * 100) / 100 };
    }
}

export function goesAlong(mode) { return mode === 'follow' || mode === 'below'; }
