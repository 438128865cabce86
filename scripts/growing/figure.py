"""Curves as SVG, both axes logarithmic."""
import math

COLORS = ["#1b6ac9", "#d1541f", "#2a9250", "#8a3fb4", "#b08a00"]
LEFT, RIGHT, TOP, BOTTOM = 70, 470, 20, 270  # of the plot, pixels


def plot(curves, limits, x_name, y_name):
    """`curves`, and dashed `limits`: lists of (name, [(x, y), ...])."""
    points = [p for _, line in curves + limits for p in line]
    bounds = []
    for axis in (0, 1):
        low, high = (f(math.log10(p[axis]) for p in points) for f in (min, max))
        margin = max(0.06 * (high - low), 0.1)
        bounds.append((low - margin, high + margin))
    place = lambda v, bound, begin, end: begin + (end - begin) * (math.log10(v) - bound[0]) / (bound[1] - bound[0])
    x = lambda v: place(v, bounds[0], LEFT, RIGHT)
    y = lambda v: place(v, bounds[1], BOTTOM, TOP)
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 700 320" font-family="sans-serif" font-size="12">',
             '<rect width="700" height="320" fill="#fff"/>',
             f'<path d="M{LEFT} {TOP}V{BOTTOM}H{RIGHT}" fill="none" stroke="#888"/>']
    for v in _ticks(bounds[0]):
        lines.append(f'<path d="M{x(v):.1f} {TOP}V{BOTTOM}" stroke="#e4e4e4"/>'
                     f'<text x="{x(v):.1f}" y="{BOTTOM + 16}" text-anchor="middle">{v:,.0f}</text>')
    for v in _ticks(bounds[1]):
        lines.append(f'<path d="M{LEFT} {y(v):.1f}H{RIGHT}" stroke="#e4e4e4"/>'
                     f'<text x="{LEFT - 6}" y="{y(v) + 4:.1f}" text-anchor="end">{v:g}</text>')
    lines.append(f'<text x="{(LEFT + RIGHT) / 2}" y="308" text-anchor="middle">{x_name}</text>')
    lines.append(f'<text x="16" y="145" text-anchor="middle" transform="rotate(-90 16 145)">{y_name}</text>')
    for index, (name, line) in enumerate(curves + limits):
        is_limit = index >= len(curves)
        color = "#888" if is_limit else COLORS[index]
        path = "".join(f"{'L' if i else 'M'}{x(a):.1f} {y(b):.1f}" for i, (a, b) in enumerate(line))
        dash = ' stroke-dasharray="5 4"' if is_limit else ""
        lines.append(f'<path d="{path}" fill="none" stroke="{color}" stroke-width="2"{dash}/>')
        if not is_limit:
            lines += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="3.5" fill="{color}"/>' for a, b in line]
        lines.append(f'<text x="{RIGHT + 14}" y="{40 + 20 * index}" fill="{color}">{name}</text>')
    return "\n".join(lines + ["</svg>"]) + "\n"


def _ticks(bound):
    """1, 2 and 5 times powers of ten, or the powers alone where they are many."""
    steps = (1, 2, 5) if bound[1] - bound[0] < 2.5 else (1,)
    values = [m * 10.0 ** k for k in range(-9, 13) for m in steps]
    return [v for v in values if bound[0] <= math.log10(v) <= bound[1]]
