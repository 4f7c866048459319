# Copyright (c) 2026 The Quadrille authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures for reproduce.py as SVG text, and their conversion to small PNG files (rsvg-convert and ImageMagick)."""

import html
import math
import os
import re
import subprocess

PANELS = ("field", "map", "layout", "mesh")  # as the program's --picture draws them, two by two


def svg(width, height, content):
    return ('<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" font-family="sans-serif" font-size="15">'
            '<rect width="{0}" height="{1}" fill="#fff"/>{2}</svg>').format(round(width), round(height), content)


def text(x, y, content, anchor="start"):
    return '<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>'.format(x, y, anchor, html.escape(content))


# Of the program's pictures and of the plots; a palette keeps a file to a third of its size.
COLORS = ("#000000", "#666666", "#228877", "#224466", "#dd2222", "#2222dd", "#aa22aa", "#cc6600")


def palette():
    """The colours, and how they fade into white where lines are thinner than a pixel."""
    shades = {"#ffffff"}
    for color in COLORS:
        channels = [int(color[i:i + 2], 16) for i in (1, 3, 5)]
        for share in (1, 0.8, 0.6, 0.4, 0.25, 0.1):
            shades.add("#" + "".join("{:02x}".format(round(255 + share * (c - 255))) for c in channels))
    return sorted(shades)


def write_png(name, picture, n_colors=0):
    """With the palette, or with any `n_colors` colours."""
    temporary = name + ".svg"
    with open(temporary, "w", encoding="utf-8") as file:
        file.write(picture)
    subprocess.run(["rsvg-convert", "-o", name, temporary], check=True)
    if n_colors > 0:
        reduce = ["-colors", str(n_colors)]
    else:
        subprocess.run(["convert", "-size", "1x1"] + ["xc:" + color for color in palette()] +
                       ["+append", "PNG24:" + temporary], check=True)
        reduce = ["-remap", "PNG24:" + temporary]
    subprocess.run(["convert", name, "+dither"] + reduce + ["-strip", "-define", "png:compression-level=9",
                                                           "PNG8:" + name], check=True)
    os.remove(temporary)


def panel(picture, kind, x, y, side):
    """One panel of a picture by the program, without its title, in a square with the upper left corner (x, y), and how
    high it is. Pictures of surfaces have one panel, "all"."""
    match = re.match(r'<svg [^>]*width="([\d.]+)" height="([\d.]+)"[^>]*>(.*)</svg>\s*$', picture, re.DOTALL)
    width, height = float(match.group(1)), float(match.group(2))
    x0, y0 = 0, 0
    if kind != "all":
        margin, title = 14, 44  # the program's, but for a little
        place = PANELS.index(kind)
        x0, y0 = place % 2 * width / 2 + margin, place // 2 * height / 2 + title
        width, height = width / 2 - 2 * margin, height / 2 - title - margin
    scale = side / max(width, height)
    content = re.sub(r"<text.*?</text>", "", match.group(3))
    # Lines that suit the program's 900 pixels would fade.
    content = re.sub(r'stroke-width="([\d.]+)"',
                     lambda m: 'stroke-width="{:.2f}"'.format(float(m.group(1)) * min(1 / scale, 2.2)), content)
    content = content.replace('r="5"', 'r="{:.1f}"'.format(3 / scale))
    drawing = '<svg x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" viewBox="{} {} {} {}">{}</svg>'.format(
        x + (side - width * scale) / 2, y, width * scale, height * scale, x0, y0, width, height, content)
    return drawing, height * scale


def grid(columns, rows, side):
    """`rows` are pairs of a caption and a list of panels (picture or None, kind, caption of the panel)."""
    gap, head, line = 12, 26, 24
    content = "".join(text(i * (side + gap) + side / 2, 18, title, "middle") for i, title in enumerate(columns))
    y = head
    for caption, panels in rows:
        if caption:
            content += text(4, y + 16, caption)
            y += line
        row_height = 0
        for i, (picture, kind, _) in enumerate(panels):
            x = i * (side + gap)
            if picture:
                drawing, height = panel(picture, kind, x, y, side)
                content += drawing
                row_height = max(row_height, height)
            else:
                content += text(x + side / 2, y + side / 2, "no valid result", "middle")
        y += row_height
        if any(label for _, _, label in panels):
            for i, (_, _, label) in enumerate(panels):
                content += text(i * (side + gap) + side / 2, y + 16, label, "middle")
            y += line
        y += 6
    return svg(len(columns) * (side + gap) - gap, y, content)


def log_plot(title, x_label, series, width=430, height=330):
    """`series`: list of (label, colour, [(x, y)]). Both axes are logarithmic."""
    left, right, top, bottom = 62, 14, 34, 46
    xs = [math.log10(x) for _, _, points in series for x, _ in points]
    ys = [math.log10(y) for _, _, points in series for _, y in points]
    x0, x1 = min(xs) - 0.1, max(xs) + 0.1
    y0, y1 = math.floor(min(ys) + 1e-9), math.ceil(max(ys) - 1e-9)

    def place(x, y):
        return (left + (math.log10(x) - x0) / (x1 - x0) * (width - left - right),
                height - bottom - (math.log10(y) - y0) / (y1 - y0) * (height - top - bottom))

    content = text(width / 2, 20, title, "middle") + text((left + width) / 2, height - 8, x_label, "middle")
    for axis, (low, high) in enumerate(((x0, x1), (y0, y1))):
        for exponent in range(math.ceil(low), math.floor(high) + 1):
            x, y = place(10.0 ** exponent, 10.0 ** y0) if axis == 0 else place(10.0 ** x0, 10.0 ** exponent)
            end = (x, top) if axis == 0 else (width - right, y)
            content += '<path d="M{:.1f} {:.1f}L{:.1f} {:.1f}" stroke="#ccc"/>'.format(x, y, *end)
            content += text(x if axis == 0 else x - 6, y + (18 if axis == 0 else 5), "{:g}".format(10.0 ** exponent),
                            "middle" if axis == 0 else "end")
    content += '<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#000"/>'.format(
        left, top, width - left - right, height - top - bottom)
    for i, (label, color, points) in enumerate(series):
        places = [place(*point) for point in points]
        content += '<path fill="none" stroke="{}" stroke-width="1.5" d="M{}"/>'.format(
            color, "L".join("{:.1f} {:.1f}".format(*p) for p in places))
        content += "".join('<circle r="3" cx="{:.1f}" cy="{:.1f}" fill="{}"/>'.format(*p, color) for p in places)
        x, y = width - right - 92, top + 0.3 * height + 20 * i
        content += '<path d="M{} {}h18" stroke="{}" stroke-width="2"/>'.format(x - 24, y - 5, color) + text(x, y, label)
    return content


def side_by_side(drawings, width, height):
    return svg(width * len(drawings), height, "".join('<g transform="translate({} 0)">{}</g>'.format(i * width, drawing)
                                                      for i, drawing in enumerate(drawings)))


def glyphs(vertices, centre, reach, side, caption):
    """The polynomials r(t) = p_T(t) of the tensors at the vertices (x, y, q0, ..., q4) within `reach` of the centre."""
    scale = side / (2 * reach)
    near = [v for v in vertices if max(abs(v[0] - centre[0]), abs(v[1] - centre[1])) < reach]
    if not near:
        return ""
    spacing = 2 * reach / math.sqrt(len(near))
    largest = max(v[2] / math.sqrt(2 * math.pi) for v in near)
    content = text(side / 2, 18, caption, "middle")
    content += '<rect x="0" y="26" width="{0}" height="{0}" fill="none" stroke="#ccc"/>'.format(side)
    for x, y, q0, q1, q2, q3, q4 in near:
        outline = []
        for i in range(72):
            t = 2 * math.pi * i / 72
            r = (q0 / math.sqrt(2) + q1 * math.cos(2 * t) + q2 * math.sin(2 * t) + q3 * math.cos(4 * t) +
                 q4 * math.sin(4 * t)) / math.sqrt(math.pi)
            r *= 0.36 * spacing * scale / largest
            outline.append("{:.1f} {:.1f}".format((x - centre[0] + reach) * scale + r * math.cos(t),
                                                  26 + (centre[1] + reach - y) * scale - r * math.sin(t)))
        # 1 on the odeco variety, 0 where the polynomial is a circle.
        share = min(1.0, math.sqrt(18 * (q3 * q3 + q4 * q4)) / q0)
        color = "#{:02x}{:02x}{:02x}".format(round(210 - 190 * share), round(60 + 40 * share), round(40 + 120 * share))
        content += '<path fill="{}" d="M{}Z"/>'.format(color, "L".join(outline))
    return content
