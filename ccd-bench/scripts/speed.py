#!/usr/bin/env python3
"""Draws docs/speed.svg: times of other methods over this project's, from the first table of figures of ccd-bench/README.md.

    ccd-bench/scripts/speed.py

A bar extends from the least to the greatest median of a scene, with a mark at the middle one of all scenes.
"""

import re
from math import log10
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parents[2]
NAMES = {
    "C2A": "C²A",
    "CONTACT": "CONTACT",
    "Dynamic Collision Checker": "Dynamic Collision Checker",
    "discrete stepping": "static test at every step",
    "coal-distance": "Coal, one static distance",
    "coal-steps": "Coal, test at every step",
    "parry-sweep-f64": "parry, sweeps of triangles",
    "parry-f64": "parry, nonlinear cast",
    "rapier-step-f64": "rapier, one step",
    "fcl-ca": "FCL, conservative advancement",
    "fcl-naive": "FCL, tests at equal steps",
}
LEFT, DECADE, TOP, ROW = 250, 72, 78, 26


def main() -> None:
    rows = table("Time in units of best-first direct, tolerance 1e-3")
    bars = [(name, *column([row[key] for row in rows])) for key, name in NAMES.items()]
    (ROOT / "docs/speed.svg").write_text(drawn(sorted(bars, key=lambda bar: bar[2])))


def table(title: str) -> list[dict[str, str]]:
    text = (ROOT / "ccd-bench/README.md").read_text()
    lines = re.search(rf"^{title}:?\n\n((\|.*\n)+)", text, re.MULTILINE)[1].splitlines()
    head, _, *rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
    return [dict(zip(head, row, strict=True)) for row in rows]


def column(cells: list[str]) -> tuple[list[float], float, bool]:
    """Returns the medians of the scenes that were measured, the middle one, and whether any scene was unsafe."""
    measured = [cell for cell in cells if cell != "–"]
    values = [float(re.search(r"[\d.]+", cell)[0]) for cell in measured]
    return values, median(values), any("†" in cell for cell in measured)


def drawn(bars: list[tuple[str, list[float], float, bool]]) -> str:
    bottom = TOP + ROW * (len(bars) + 1)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="760" height="{bottom + 50}" viewBox="0 0 760 {bottom + 50}"'
        ' role="img" aria-label="Times of other methods over that of this project" font-family="sans-serif"'
        ' font-size="13">',
        "<title>Times of other methods over that of this project</title>",
        f'<rect width="760" height="{bottom + 50}" fill="#FFFFFF"/>',
        text(12, 24, "Time of a query over that of rigid-ccd, tolerance 0.001: medians of up to 12 scenes", 'font-size="15"'),
        text(12, 48, "bar: least to greatest scene; line: the middle", ""),
        '<rect x="330" y="38" width="20" height="11" fill="#8A8A8A"/>',
        text(356, 48, "no contact late or missed here", ""),
        '<rect x="572" y="38" width="20" height="11" fill="#D55E00"/>',
        text(598, 48, "some late or missed", ""),
    ]
    for power in range(7):
        at = x(10**power)
        parts.append(f'<line x1="{at}" y1="{TOP - 8}" x2="{at}" y2="{bottom}" stroke="#DDDDDD"/>')
        parts.append(text(at, bottom + 18, f"{10**power:,}", 'text-anchor="middle"'))
    parts.append(text(12, bottom + 40, "times as long, logarithmic; rows that were cut off count with the time until then", ""))
    own = ("rigid-ccd: first contact", [1.0], 1.0, False)
    for index, (name, values, middle, unsafe) in enumerate([own, *bars]):
        y = TOP + ROW * index
        low, high, at = x(min(values)), x(max(values)), x(middle)
        colour = "#0072B2" if index == 0 else "#D55E00" if unsafe else "#8A8A8A"
        parts.append(text(LEFT - 12, y + 13, name, 'text-anchor="end"'))
        parts.append(f'<rect x="{low - 2:.1f}" y="{y + 2}" width="{high - low + 4:.1f}" height="14" fill="{colour}"/>')
        parts.append(f'<line x1="{at:.1f}" y1="{y}" x2="{at:.1f}" y2="{y + 18}" stroke="#000000" stroke-width="2"/>')
    return "\n".join([*parts, "</svg>", ""])


def x(ratio: float) -> float:
    return LEFT + DECADE * log10(ratio)


def text(at: float, y: float, words: str, attributes: str) -> str:
    return f'<text x="{at}" y="{y}" fill="#222222" {attributes}>{words}</text>'


if __name__ == "__main__":
    main()
