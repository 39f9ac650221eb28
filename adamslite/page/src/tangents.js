// Where a line that runs over wheels touches them.
//
// In the plane of a wheel, let d be the vector from its centre to that of its neighbour, R and S
// their radii with the sign of their sense of turn (+ about z; a point has 0), u the unit direction
// of the line and n = z x u. A line touches a wheel at c - R n, so n.d = S - R; with D = |d|, the
// angle from d to u has the sine (R - S) / D.

/** Contact of the straight part towards a neighbour, relative to the wheel's centre, in its plane.
 *  dx, dy: from this centre to the neighbour's; `leaving`: the line runs towards the neighbour. */
export function contact(dx, dy, own, other, leaving, out) {
    const distance = Math.hypot(dx, dy);
    if (distance === 0) {
        out[0] = Math.abs(own);
        out[1] = 0;
        return out;
    }
    // A line that arrives runs against d: it is the line that leaves with both senses reversed.
    const sign = leaving ? 1 : -1;
    const sine = Math.min(Math.max((sign * (own - other)) / distance, -1), 1);
    const cosine = Math.sqrt(1 - sine * sine);
    const ux = (dx * cosine - dy * sine) / distance;
    const uy = (dx * sine + dy * cosine) / distance;
    out[0] = sign * own * uy;
    out[1] = -sign * own * ux;
    return out;
}

/** Angle from one contact to the next in the wheel's sense, 0 to 2 pi; almost a turn is none. */
export function wrap(fromX, fromY, toX, toY, sense) {
    const turn = 2 * Math.PI;
    const difference = sense * (Math.atan2(toY, toX) - Math.atan2(fromY, fromX));
    const angle = ((difference % turn) + turn) % turn;
    return angle > turn - 0.05 ? 0 : angle;
}
