// Lines of a width in pixels, shaded like round bars, in one colour or coloured by a value 0..1.
import {
    BufferAttribute, BufferGeometry, Color, DataTexture, DynamicDrawUsage, InterleavedBuffer, InterleavedBufferAttribute,
    LinearFilter, Mesh, ShaderMaterial, SRGBColorSpace, Vector2,
} from "three";
import { corners, rectangles } from "./rectangles.js";
import { viridis } from "./colours.js";

// A segment is a rectangle on the screen, longer than it by half its width at both ends, which are
// cut round. What varies over it is multiplied by w so that it is linear on the screen.
const VERTEX = `
attribute vec2 corner;
attribute vec4 from;
attribute vec4 to;
uniform float width;
uniform vec2 resolution;
varying vec4 place;
varying float span;
void main() {
    vec4 a = modelViewMatrix * vec4(from.xyz, 1.0);
    vec4 b = modelViewMatrix * vec4(to.xyz, 1.0);
    float near = -projectionMatrix[3][2] / (projectionMatrix[2][2] - 1.0);
    if (projectionMatrix[3][3] == 0.0) {
        if (a.z > near && b.z < near) a = mix(b, a, (near - b.z) / (a.z - b.z));
        if (b.z > near && a.z < near) b = mix(a, b, (near - a.z) / (b.z - a.z));
    }
    vec4 ca = projectionMatrix * a;
    vec4 cb = projectionMatrix * b;
    vec2 pa = ca.xy / ca.w * 0.5 * resolution;
    vec2 pb = cb.xy / cb.w * 0.5 * resolution;
    vec2 along = pb - pa;
    span = length(along);
    along = span > 1e-4 ? along / span : vec2(1.0, 0.0);
    float reach = 0.5 * width;
    float x = corner.x * span + (2.0 * corner.x - 1.0) * reach;
    vec2 p = pa + along * x + vec2(-along.y, along.x) * corner.y * reach;
    vec4 c = corner.x < 0.5 ? ca : cb;
    gl_Position = vec4(p / (0.5 * resolution) * c.w, c.z, c.w);
    place = vec4(x, corner.y * reach, corner.x < 0.5 ? from.w : to.w, 1.0) * c.w;
}`;

const FRAGMENT = `
uniform float width;
uniform float shading;
uniform float opacity;
uniform bool mapped;
uniform vec3 ink;
uniform sampler2D map;
varying vec4 place;
varying float span;
void main() {
    vec3 p = place.xyz / place.w;
    float reach = 0.5 * width;
    float beyond = p.x < 0.0 ? p.x : max(p.x - span, 0.0);
    if (beyond * beyond + p.y * p.y > reach * reach) discard;
    float height = sqrt(max(1.0 - p.y * p.y / (reach * reach), 0.0));
    vec3 colour = mapped && p.z > -0.5 ? texture2D(map, vec2(clamp(p.z, 0.002, 0.998), 0.5)).rgb : ink;
    gl_FragColor = vec4(colour * mix(1.0, 0.5 + 0.55 * height, shading), opacity);
    #include <colorspace_fragment>
}`;

function tensionMap(theme) {
    const size = 256;
    const data = new Uint8Array(4 * size);
    for (let k = 0; k < size; k += 1) data.set([...viridis(k / (size - 1), theme), 255], 4 * k);
    const texture = new DataTexture(data, size, 1);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = LinearFilter;
    texture.magFilter = LinearFilter;
    texture.needsUpdate = true;
    return texture;
}

export class Strokes {
    /** `count` segments; `width` in pixels; `mapped`: coloured by value instead of `colour`. */
    constructor(count, { width = 2, colour = "#000", mapped = false, theme = "light", shading = 0.8, opacity = 1 } = {}) {
        this.count = count;
        this.width = width;
        this.array = new Float32Array(8 * count);
        // Every corner of a segment holds both its ends: instances of a rectangle would hold them
        // once, but take software renderers twenty times as long.
        this.buffer = new InterleavedBuffer(new Float32Array(32 * Math.max(count, 1)), 8);
        this.buffer.setUsage(DynamicDrawUsage);
        this.geometry = new BufferGeometry();
        this.geometry.setAttribute("corner", new BufferAttribute(corners(count, [0, -1, 1, -1, 1, 1, 0, 1]), 2));
        this.geometry.setAttribute("position", new InterleavedBufferAttribute(this.buffer, 3, 0));
        this.geometry.setAttribute("from", new InterleavedBufferAttribute(this.buffer, 4, 0));
        this.geometry.setAttribute("to", new InterleavedBufferAttribute(this.buffer, 4, 4));
        this.geometry.setIndex(rectangles(count));
        this.material = new ShaderMaterial({
            vertexShader: VERTEX,
            fragmentShader: FRAGMENT,
            transparent: opacity < 1,
            uniforms: {
                width: { value: width },
                shading: { value: shading },
                opacity: { value: opacity },
                mapped: { value: mapped },
                ink: { value: new Color(colour) },
                map: { value: mapped ? tensionMap(theme) : null },
                resolution: { value: new Vector2(1, 1) },
            },
        });
        this.mesh = new Mesh(this.geometry, this.material);
        this.mesh.frustumCulled = false;
        this.mesh.matrixAutoUpdate = false;
    }

    setResolution(width, height) {
        this.material.uniforms.resolution.value.set(width, height);
    }

    setColour(colour) {
        this.material.uniforms.ink.value.set(colour);
    }

    setTheme(theme) {
        this.material.uniforms.map.value?.dispose();
        this.material.uniforms.map.value = tensionMap(theme);
    }

    /** After `array` has changed: from and to, each x, y, z and value, for every segment. */
    touched() {
        const { array, buffer, count } = this;
        const copies = buffer.array;
        for (let k = 0; k < count; k += 1) {
            for (let c = 0; c < 8; c += 1) {
                const value = array[8 * k + c];
                copies[32 * k + c] = value;
                copies[32 * k + c + 8] = value;
                copies[32 * k + c + 16] = value;
                copies[32 * k + c + 24] = value;
            }
        }
        buffer.needsUpdate = true;
    }

    dispose() {
        this.geometry.dispose();
        this.material.uniforms.map.value?.dispose();
        this.material.dispose();
    }
}

/** Segments between points that belong to bodies: outlines, circles, links. */
export class BodyLines {
    /** `polylines`: lists of points [body, x, y, z]. */
    constructor(polylines, bodies, options) {
        this.bodies = bodies;
        this.ends = polylines.flatMap((points) => points.slice(1).map((point, k) => [points[k], point]));
        this.strokes = new Strokes(this.ends.length, options);
        const moves = ([a, b]) => bodies.moving[a[0]] || bodies.moving[b[0]];
        this.moving = Uint32Array.from(this.ends.keys()).filter((k) => moves(this.ends[k]));
        this.ends.forEach((_, k) => this.#write(k));
        this.strokes.touched();
    }

    #write(k) {
        const [a, b] = this.ends[k];
        this.bodies.point(a, this.strokes.array, 8 * k);
        this.bodies.point(b, this.strokes.array, 8 * k + 4);
    }

    update() {
        if (!this.moving.length) return;
        for (const k of this.moving) this.#write(k);
        this.strokes.touched();
    }
}
