"""Line charts with logarithmic axes as SVG, for light and dark pages."""

import math
from html import escape

# Distinguishable with the common kinds of colour blindness (Okabe and Ito), on white and on dark grey.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7f7f7f", "#8c564b"]
# Without CSS variables, which some programs that show SVG do not support.
STYLE = """
  .page { fill: #ffffff; } .grid { stroke: #d1d9e0; } .line { fill: none; stroke-width: 2; }
  text { fill: #1f2328; font: 12px sans-serif; } .title { font-weight: bold; }
  @media (prefers-color-scheme: dark) {
    .page { fill: #0d1117; } .grid { stroke: #3d444d; } text { fill: #e6edf3; }
  }
"""
WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 460, 340, 56, 46, 14, 44


def label(value):
    """A number in short form: 0.25, 160, 16k, 1M."""
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:.3g}{letter}"
    return f"{value:.3g}"


def ticks(low, high):
    """Round numbers between low and high, in the finest of these steps that gives at most nine numbers."""
    powers = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 1)
    for steps in ([1 + i / 10 for i in range(90)], [1 + i / 5 for i in range(45)], [1 + i / 2 for i in range(18)],
                  [1, 1.5, 2, 3, 4, 5, 7], [1, 2, 5], [1]):
        numbers = [step * 10.0**power for power in powers for step in steps]
        numbers = [number for number in numbers if low <= number <= high]
        if len(numbers) <= 9:
            return numbers
    return numbers


class Axis:
    """Maps values to positions on a logarithmic axis from pixel `start` to pixel `end`."""

    def __init__(self, values, start, end):
        self.low, self.high = min(values) / 1.15, max(values) * 1.15
        self.start, self.end = start, end

    def __call__(self, value):
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return self.start + share * (self.end - self.start)


def chart(title, x_name, y_name, series, x_ticks=None):
    """One chart as SVG elements. `series`: name, [(x, y), ...] with positive numbers, and an addition for the legend."""
    points = [point for _, line, _ in series for point in line]
    x_axis = Axis([x for x, _ in points], LEFT, WIDTH - RIGHT)
    y_axis = Axis([y for _, y in points], HEIGHT - BOTTOM, TOP)
    out = [f'<text class="title" x="{LEFT}" y="18">{escape(title)}</text>']
    for x in x_ticks or ticks(x_axis.low, x_axis.high):
        at = x_axis(x)
        out.append(f'<path class="grid" d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        out.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{label(x)}</text>')
    for y in ticks(y_axis.low, y_axis.high):
        at = y_axis(y)
        out.append(f'<path class="grid" d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}"/>')
        out.append(f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{label(y)}</text>')
    out.append(f'<text x="{(LEFT + WIDTH) / 2:.0f}" y="{HEIGHT - 8}" text-anchor="middle">{escape(x_name)}</text>')
    out.append(f'<text x="{LEFT - 40}" y="{TOP - 4}">{escape(y_name)}</text>')
    for i, (name, line, note) in enumerate(series):
        colour = COLOURS[i % len(COLOURS)]
        path = " ".join(f"{x_axis(x):.1f},{y_axis(y):.1f}" for x, y in sorted(line))
        out.append(f'<polyline class="line" stroke="{colour}" points="{path}"/>')
        out += [f'<circle r="3" fill="{colour}" cx="{x_axis(x):.1f}" cy="{y_axis(y):.1f}"/>' for x, y in line]
        at = HEIGHT + 10 + 17 * i
        out.append(f'<path stroke="{colour}" class="line" d="M{LEFT} {at - 4}h22"/>')
        out.append(f'<text x="{LEFT + 30}" y="{at}">{escape(name)}{escape(note)}</text>')
    return "\n".join(out)


def page(charts):
    """Charts, each (title, x name, y name, series, x ticks), side by side as one SVG document."""
    rows = max(len(series) for _, _, _, series, _ in charts)
    width, height = WIDTH * len(charts), HEIGHT + 17 * rows + 14
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}">',
             f"<style>{STYLE}</style>", f'<rect class="page" width="{width}" height="{height}"/>']
    for i, contents in enumerate(charts):
        parts.append(f'<g transform="translate({WIDTH * i} 0)">\n{chart(*contents)}\n</g>')
    return "\n".join([*parts, "</svg>", ""])
