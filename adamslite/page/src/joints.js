// Joints as symbols at their I markers.
import { Balls } from "./balls.js";
import { symbol, symbolKind } from "./geometry.js";
import { Instances, placed } from "./instances.js";

const FEW = 24; // joints of a kind up to which their symbols have all their facets
const MANY = 60; // and from which on they are balls, too small to tell more

export class Joints {
    constructor(joints, bodies, stage, look) {
        const kinds = new Map();
        for (const { kind, i } of joints) {
            const key = symbolKind(kind);
            if (!kinds.has(key)) kinds.set(key, []);
            const size = look.joint;
            kinds.get(key).push({
                body: i[0],
                local: placed(i.slice(1), [0, 0, 0], [size, size, size]),
                colour: stage.palette.joint,
            });
        }
        this.groups = [...kinds].map(([kind, items]) =>
            items.length > MANY
                ? new Balls(items, bodies, stage, 1)
                : new Instances(symbol(kind, items.length <= FEW), items, bodies));
        for (const group of this.groups) stage.add(...group.objects);
    }

    update() {
        for (const group of this.groups) group.update();
    }

    setTheme(palette) {
        for (const group of this.groups) group.paint(null, () => palette.joint);
    }

    set visible(shown) {
        for (const { mesh } of this.groups) mesh.visible = shown;
    }
}
