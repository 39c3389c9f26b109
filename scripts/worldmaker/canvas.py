# SPDX-License-Identifier: GPL-3.0-or-later
"""Palette pictures, painted in pure Python so that a bare system can make the worlds."""

import random
import struct
import zlib

# Columns of 5 x 7 letters, lowest bit on top.
FONT = dict(zip(
    "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789",
    (bytes.fromhex(code) for code in (
        "7E1111117E 7F49494936 3E41414122 7F4141221C 7F49494941 7F09090901 3E4149497A 7F0808087F "
        "00417F4100 2040413F01 7F08142241 7F40404040 7F020C027F 7F0408107F 3E4141413E 7F09090906 "
        "3E4151215E 7F09192946 4649494931 01017F0101 3F4040403F 1F2040201F 3F4038403F 6314081463 "
        "0708700807 6151494543 3E5149453E 00427F4000 4261514946 2141454B31 1814127F10 2745454539 "
        "3C4A494930 0171090503 3649494936 064949291E").split())))


class Rng:
    """Random numbers from a name; only random() is used, which no version of Python changes."""

    def __init__(self, name):
        self._random = random.Random(zlib.crc32(name.encode()))

    def uniform(self, low, high):
        return low + (high - low) * self._random.random()

    def integer(self, low, high):
        """Between low and high, both included."""
        return low + int((high - low + 1) * self._random.random())

    def pick(self, items):
        return items[int(len(items) * self._random.random())]

    def chance(self, share):
        return self._random.random() < share

    def colour(self, low=30, high=230):
        return tuple(self.integer(low, high) for _ in range(3))

    def near(self, colour, spread):
        return tuple(c + self.integer(-spread, spread) for c in colour)


def scaled(colour, factor):
    return tuple(c * factor for c in colour)


class Palette:
    """At most 256 colours; when it is full the nearest one serves."""

    STEP = 5

    def __init__(self):
        self.colours = []
        self._index = {}

    def index(self, colour):
        key = tuple(min(51, max(0, round(c / self.STEP))) for c in colour)
        if key not in self._index:
            if len(self.colours) < 256:
                self._index[key] = len(self.colours)
                self.colours.append(tuple(c * self.STEP for c in key))
            else:
                wanted = [c * self.STEP for c in key]
                self._index[key] = min(
                    range(256), key=lambda i: sum((a - b) ** 2 for a, b in
                                                  zip(self.colours[i], wanted)))
        return self._index[key]


class Noise:
    """Smooth noise in [0, 1] on a lattice of `cell` pixels, summed over octaves."""

    def __init__(self, rng, width, height, cell, octaves=2):
        self._layers = []
        weight, total = 1.0, 0.0
        for _ in range(octaves):
            columns, rows = int(width / cell) + 2, int(height / cell) + 2
            lattice = [[rng.uniform(0, 1) for _ in range(columns)] for _ in range(rows)]
            steps = []
            for x in range(width):
                i, t = divmod(x / cell, 1.0)
                steps.append((int(i), t * t * (3 - 2 * t)))
            self._layers.append((lattice, steps, cell, weight))
            total += weight
            weight, cell = weight / 2, max(2, cell / 2)
        self._total = total

    def row(self, y):
        sums = None
        for lattice, steps, cell, weight in self._layers:
            j, t = divmod(y / cell, 1.0)
            t = t * t * (3 - 2 * t) * weight
            upper, lower = lattice[int(j)], lattice[int(j) + 1]
            line = [a * (weight - t) + b * t for a, b in zip(upper, lower)]
            layer = [line[i] + (line[i + 1] - line[i]) * s for i, s in steps]
            sums = layer if sums is None else [a + b for a, b in zip(sums, layer)]
        return [value / self._total for value in sums]


class Canvas:
    """A rectangle of a picture; views share its pixels. Row 0 is on top."""

    def __init__(self, width, height, colour=(128, 128, 128)):
        self.width, self.height = width, height
        self.palette = Palette()
        self._rows = [bytearray([self.palette.index(colour)]) * width for _ in range(height)]
        self._x = self._y = 0

    def view(self, x, y, width, height):
        part = Canvas.__new__(Canvas)
        part.width, part.height = int(width), int(height)
        part.palette, part._rows = self.palette, self._rows
        part._x, part._y = self._x + int(x), self._y + int(y)
        return part

    def grow(self, height):
        while len(self._rows) < height:
            self._rows.append(bytearray(self.width))
        self.height = len(self._rows)

    def rect(self, x0, y0, x1, y1, colour):
        x0, x1 = max(0, int(x0)), min(self.width, int(x1))
        if x1 <= x0:
            return
        line = bytes([self.palette.index(colour)]) * (x1 - x0)
        for y in range(max(0, int(y0)), min(self.height, int(y1))):
            self._rows[self._y + y][self._x + x0:self._x + x1] = line

    def fill(self, colour):
        self.rect(0, 0, self.width, self.height, colour)

    def frame(self, x0, y0, x1, y1, colour, thick=1):
        self.rect(x0, y0, x1, y0 + thick, colour)
        self.rect(x0, y1 - thick, x1, y1, colour)
        self.rect(x0, y0, x0 + thick, y1, colour)
        self.rect(x1 - thick, y0, x1, y1, colour)

    def ellipse(self, cx, cy, rx, ry, colour):
        for y in range(int(cy - ry), int(cy + ry) + 1):
            inside = 1 - ((y - cy) / max(ry, 0.5)) ** 2
            if inside >= 0:
                half = rx * inside ** 0.5
                self.rect(round(cx - half), y, round(cx + half) + 1, y + 1, colour)

    def line(self, x0, y0, x1, y1, colour, thick=1):
        steps = int(max(abs(x1 - x0), abs(y1 - y0))) + 1
        for i in range(steps + 1):
            x, y = x0 + (x1 - x0) * i / steps, y0 + (y1 - y0) * i / steps
            self.rect(round(x), round(y), round(x) + thick, round(y) + thick, colour)

    def text(self, x, y, words, colour, scale=1):
        for letter in words:
            for column, bits in enumerate(FONT.get(letter, b"")):
                for row in range(7):
                    if bits >> row & 1:
                        self.rect(x + column * scale, y + row * scale,
                                  x + (column + 1) * scale, y + (row + 1) * scale, colour)
            x += 6 * scale

    def label(self, x, y, width, height, words, colour):
        """Text as large as fits."""
        self.text(x, y, words, colour, max(1, int(min(width / (6 * len(words)), height / 7))))

    def shade(self, noise, low, high, levels=5):
        """Multiplies by a factor from low to high, in few steps: steps compress well."""
        palette, tables = self.palette, [{} for _ in range(levels)]
        for y in range(self.height):
            row = self._rows[self._y + y]
            for x, value in enumerate(noise.row(y), self._x):
                level = min(levels - 1, int(value * levels))
                table, index = tables[level], row[x]
                if index not in table:
                    factor = low + (high - low) * level / (levels - 1)
                    table[index] = palette.index(scaled(palette.colours[index], factor))
                row[x] = table[index]

    def speckle(self, rng, share, colours):
        for _ in range(int(share * self.width * self.height)):
            x, y = rng.integer(0, self.width - 1), rng.integer(0, self.height - 1)
            self.rect(x, y, x + rng.integer(1, 2), y + 1, rng.pick(colours))

    def png(self):
        def chunk(kind, body):
            return (struct.pack(">I", len(body)) + kind + body
                    + struct.pack(">I", zlib.crc32(kind + body)))
        pixels = b"".join(b"\0" + bytes(row[:self.width]) for row in self._rows[:self.height])
        return (b"\x89PNG\r\n\x1a\n"
                + chunk(b"IHDR", struct.pack(">IIBBBBB", self.width, self.height, 8, 3, 0, 0, 0))
                + chunk(b"PLTE", b"".join(bytes(colour) for colour in self.palette.colours))
                + chunk(b"IDAT", zlib.compress(pixels, 9))
                + chunk(b"IEND", b""))
