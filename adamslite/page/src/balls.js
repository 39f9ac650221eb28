// Balls, each fixed to a body: rectangles that face the viewer and are shaded as balls. A ball of
// facets needs hundreds of triangles, which software renderers take long for.
import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Mesh, ShaderMaterial, Sphere, Vector3 } from "three";
import { corners, rectangles } from "./rectangles.js";

// A rectangle lies across the ray to the middle of its ball, as large as the ball is seen; with d to
// the middle, a ball of radius r covers there the radius r d / sqrt(d^2 - r^2). Depth is that of the
// ball, so that what runs through it comes out of it.
const VERTEX = `
attribute vec2 corner;
attribute float radius;
attribute vec3 tone;
varying vec2 place;
varying vec3 colour;
varying vec3 middle;
varying vec3 right;
varying vec3 up;
varying float size;
void main() {
    middle = (modelViewMatrix * vec4(position, 1.0)).xyz;
    float apart = max(length(middle), 1.001 * radius);
    vec3 toward = -middle / apart;
    right = normalize(cross(vec3(0.0, 1.0, 0.0), toward));
    up = cross(toward, right);
    float seen = radius * apart / sqrt(apart * apart - radius * radius);
    gl_Position = projectionMatrix * vec4(middle + seen * (corner.x * right + corner.y * up), 1.0);
    place = corner;
    colour = tone;
    size = radius;
}`;
const FRAGMENT = `
uniform mat4 projectionMatrix;
uniform vec3 upward;
uniform float lamp;
uniform vec3 sky;
uniform vec3 soil;
uniform float opacity;
varying vec2 place;
varying vec3 colour;
varying vec3 middle;
varying vec3 right;
varying vec3 up;
varying float size;
void main() {
    float square = dot(place, place);
    if (square > 1.0) discard;
    vec3 n = place.x * right + place.y * up + sqrt(1.0 - square) * cross(right, up);
    vec3 light = mix(soil, sky, 0.5 + 0.5 * dot(n, upward)) + lamp * max(dot(n, vec3(-0.345, 0.537, 0.767)), 0.0);
    gl_FragColor = vec4(colour * light, opacity);
    vec4 clip = projectionMatrix * vec4(middle + size * n, 1.0);
    gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w + (opacity < 1.0 ? 1e-4 : 0.0);
    #include <colorspace_fragment>
}`;

/** Has the same face to the outside as `Instances`. */
export class Balls {
    /** `items`: {body, local (Matrix4), colour}; radii are those of the matrices' x axes. */
    constructor(items, bodies, stage, opacity) {
        this.items = items;
        this.bodies = bodies;
        this.stage = stage;
        this.places = items.map(({ body, local }) => [body, ...local.elements.slice(12, 15)]);
        this.radii = items.map(({ local }) => Math.hypot(...local.elements.slice(0, 3)));
        this.centre = [0, 0, 0];
        this.mesh = new Mesh(this.#geometry(), this.#material(opacity));
        this.mesh.frustumCulled = false;
        this.mesh.matrixAutoUpdate = false;
        this.mesh.userData.bodyOf = (k) => items[k].body;
        this.mesh.raycast = (ray, hits) => this.#raycast(ray, hits);
        this.mesh.onBeforeRender = (renderer, scene, camera) => this.#light(camera);
        this.moving = Uint32Array.from(items.keys()).filter((k) => bodies.moving[items[k].body]);
        items.forEach((_, k) => this.#write(k));
        this.paint(null, ({ colour }) => colour);
    }

    get objects() {
        return [this.mesh];
    }

    #geometry() {
        const count = this.items.length;
        const geometry = new BufferGeometry();
        const dynamic = new BufferAttribute(new Float32Array(12 * count), 3).setUsage(DynamicDrawUsage);
        geometry.setAttribute("position", dynamic);
        geometry.setAttribute("corner", new BufferAttribute(corners(count, [-1, -1, 1, -1, 1, 1, -1, 1]), 2));
        const radii = Float32Array.from({ length: 4 * count }, (_, k) => this.radii[k >> 2]);
        geometry.setAttribute("radius", new BufferAttribute(radii, 1));
        geometry.setAttribute("tone", new BufferAttribute(new Float32Array(12 * count), 3));
        geometry.setIndex(rectangles(count));
        return geometry;
    }

    #material(opacity) {
        return new ShaderMaterial({
            vertexShader: VERTEX,
            fragmentShader: FRAGMENT,
            transparent: opacity < 1,
            uniforms: {
                upward: { value: new Vector3() },
                lamp: { value: 0 },
                sky: { value: new Color() },
                soil: { value: new Color() },
                opacity: { value: opacity },
            },
        });
    }

    // The lights of the stage, divided by pi as for a matt surface.
    #light(camera) {
        const { hemisphere, lamp } = this.stage;
        const { uniforms } = this.mesh.material;
        uniforms.upward.value.setFromMatrixPosition(hemisphere.matrixWorld).transformDirection(camera.matrixWorldInverse);
        uniforms.lamp.value = lamp.intensity / Math.PI;
        uniforms.sky.value.copy(hemisphere.color).multiplyScalar(hemisphere.intensity / Math.PI);
        uniforms.soil.value.copy(hemisphere.groundColor).multiplyScalar(hemisphere.intensity / Math.PI);
        this.mesh.material.uniformsNeedUpdate = true;
    }

    #write(k) {
        const { array } = this.mesh.geometry.getAttribute("position");
        const { centre } = this;
        this.bodies.point(this.places[k], centre);
        for (let c = 0; c < 12; c += 3) {
            array[12 * k + c] = centre[0];
            array[12 * k + c + 1] = centre[1];
            array[12 * k + c + 2] = centre[2];
        }
    }

    update() {
        if (!this.moving.length) return;
        for (const k of this.moving) this.#write(k);
        this.mesh.geometry.getAttribute("position").needsUpdate = true;
    }

    paint(b, colourOf) {
        const tone = this.mesh.geometry.getAttribute("tone");
        this.items.forEach((item, k) => {
            if (b !== null && item.body !== b) return;
            const colour = new Color(colourOf(item)).toArray();
            for (let c = 0; c < 12; c += 3) tone.array.set(colour, 12 * k + c);
        });
        tone.needsUpdate = true;
    }

    #raycast({ ray }, hits) {
        const point = new Vector3();
        const sphere = new Sphere();
        const { array } = this.mesh.geometry.getAttribute("position");
        this.radii.forEach((radius, k) => {
            sphere.set(point.fromArray(array, 12 * k), radius);
            const hit = ray.intersectSphere(sphere, new Vector3());
            if (hit) hits.push({ distance: ray.origin.distanceTo(hit), point: hit, object: this.mesh, instanceId: k });
        });
    }
}
