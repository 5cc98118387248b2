// White edges of shapes that must be seen on water, ice and hulls alike: a second, white drawing of each under it, so
// many pixels wider however far away it is.
import * as THREE from 'three';
import { HALO } from './legend.js';

export class Haloes {
    static WIDTH = 2; // [px]

    constructor(scene) {
        this.scene = scene;
        this.pixel = { value: new THREE.Vector2(1, 1) }; // in the units of the screen, which is two wide and high
    }

    /** Under all that is drawn as late as the shape itself. */
    static under(shape) { return shape.renderOrder - 0.5; }

    resize(width, height) { this.pixel.value.set(2 / width, 2 / height); }

    /** Of an InstancedMesh, in all places that it gets. */
    add(mesh) {
        const material = new THREE.MeshBasicMaterial({ color: HALO, depthTest: false, transparent: true });
        material.onBeforeCompile = (shader) => {
            shader.uniforms.pixel = this.pixel;
            shader.vertexShader = shader.vertexShader
                .replace('#include <common>', '#include <common>\nuniform vec2 pixel;')
                .replace('#include <project_vertex>', `#include <project_vertex>
                    vec2 aside = (modelViewMatrix * instanceMatrix * vec4(normal, 0.0)).xy;
                    float far = length(aside);
                    if (far > 0.0)
                        gl_Position.xy += aside / far * ${Haloes.WIDTH.toFixed(1)} * pixel * gl_Position.w;`);
        };
        const halo = new THREE.InstancedMesh(mesh.geometry, material, mesh.instanceMatrix.count);
        halo.instanceMatrix = mesh.instanceMatrix;
        halo.frustumCulled = false;
        halo.renderOrder = Haloes.under(mesh);
        halo.onBeforeRender = () => { halo.count = mesh.count; };
        halo.count = mesh.count;
        this.scene.add(halo);
        return halo;
    }
}
