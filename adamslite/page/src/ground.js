// The ground as a grid below the motion.
import { BufferAttribute, BufferGeometry, Color, LineSegments, LineBasicMaterial } from "three";
import { niceStep } from "./dom.js";

/** Indices of the two horizontal axes and of the vertical one. */
export function axesOf(up) {
    const vertical = "xyz".indexOf(up);
    return { vertical, flat: [0, 1, 2].filter((axis) => axis !== vertical) };
}

export class Ground {
    constructor({ low, high, centre, radius }, up, sign, stage) {
        this.step = niceStep(radius / 3);
        const { vertical, flat } = axesOf(up);
        const reach = Math.ceil((1.5 * radius) / this.step);
        const middle = flat.map((axis) => Math.round(centre[axis] / this.step));
        const level = sign > 0 ? low[vertical] : high[vertical];
        const points = [];
        const line = (axis, n) => {
            const across = 1 - axis;
            for (const end of [-reach, reach]) {
                const p = [0, 0, 0];
                p[flat[axis]] = (middle[axis] + n) * this.step;
                p[flat[across]] = (middle[across] + end) * this.step;
                p[vertical] = level;
                points.push(...p);
            }
        };
        for (let n = -reach; n <= reach; n += 1) {
            line(0, n);
            line(1, n);
        }
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points), 3));
        this.lines = new LineSegments(geometry, new LineBasicMaterial({ color: new Color(stage.palette.grid) }));
        this.lines.matrixAutoUpdate = false;
        stage.add(this.lines);
    }

    setTheme(palette) {
        this.lines.material.color.set(palette.grid);
    }

    set visible(shown) {
        this.lines.visible = shown;
    }
}
