"""What a gradient by 1000 numbers costs: CPU of a run and of a sweep back, on a rope of springs.

python -m benchmarks.gradients [--sections 251] [--integrator GSTIFF] [--of MEASURE]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

import adamslite as al

#: Arguments whose numbers are varied, and the most of them.
VARIED, MOST = ("K", "C", "LENGTH", "MASS"), 1000
MEASURE = "max REQUEST/1.F3"


def rope(sections: int) -> str:
    """Point masses between two hooks, a little out of line, each spring with numbers of its own."""
    lines = ["A rope of springs", "UNITS/SYSTEM=MKS", "ACCGRAV/KGRAV=-9.81", "PART/1, GROUND"]
    lines += ["MARKER/1, PART=1", "MARKER/2, PART=1, QP=9,0,0"]
    for k in range(1, sections):
        sag = -0.02 * (k % 3) - 1e-3
        lines.append(f"POINT_MASS/{k + 1}, MASS={0.5 + 0.007 * (k % 7):.6f}, CM={10 + k}")
        lines.append(f", QG={9 * k / sections:.9f},0,{sag:.6f}")
        lines.append(f"MARKER/{10 + k}, POINT_MASS={k + 1}")
    ends = [1, *range(11, 10 + sections), 2]
    for k, (j, i) in enumerate(zip(ends, ends[1:], strict=False)):
        lines.append(f"SPRINGDAMPER/{k + 1}, TRANSLATIONAL, I={i}, J={j}, K={2e4 + 1e3 * (k % 5)}")
        lines.append(f", C={20 + 0.1 * (k % 11):.3f}, LENGTH={9 / sections:.9f}")
    lines += [f"REQUEST/1, F3=DZ({10 + sections // 2},1)", "INTEGRATOR/GSTIFF, SI2, ERROR=1E-5"]
    return "\n".join([*lines, "SIMULATE/DYNAMIC, END=1, STEPS=50", "END", ""])


def least(work: Callable[[], Any]) -> tuple[float, Any]:
    """CPU [s], the least of three, behind one that compiles."""
    found, best = work(), float("inf")
    for _ in range(3):
        began = time.process_time()
        found = work()
        best = min(best, time.process_time() - began)
    return best, found


def main() -> None:
    """Print the two and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sections", type=int, default=251)
    parser.add_argument("--integrator", default="GSTIFF")
    parser.add_argument("--of", default=MEASURE)
    args = parser.parse_args()
    deck = al.read(rope(args.sections))
    kernels = al.compile_model(al.assemble(deck))
    by = [each.name for each in al.names(deck) if each.name.partition(".")[2] in VARIED][:MOST]
    flags: dict[str, Any] = {"integrator": args.integrator}
    run, results = least(lambda: al.simulate(kernels, **flags))
    sweep, _ = least(lambda: al.gradient(kernels, [args.of], by, **flags))
    print(f"{len(by)} numbers, {results.summary['steps']} steps: run {run:.4f} s of CPU, "
          f"gradient {sweep:.4f} s, {sweep / run:.2f} runs")  # fmt: skip


if __name__ == "__main__":
    main()
