# SPDX-License-Identifier: GPL-3.0-or-later
"""Walls, floors, ceilings and doorways of a building, as one model."""

import math

from . import surfaces
from .model import Model, Plain

LAMP = Plain("lamp", (255, 250, 235))  # the light just below it makes it bright
WALL_PIXELS = 86  # pixels a metre of wall, both ways


class Wall:
    """From a to b, the room on the right; s runs along it, from left to right as the room sees it."""

    def __init__(self, a, b):
        self.a, self.length = a, math.dist(a, b)
        self.along = ((b[0] - a[0]) / self.length, (b[1] - a[1]) / self.length)
        self.into = (self.along[1], -self.along[0])
        self.openings = []

    def at(self, s, z, out=0.0):
        return (self.a[0] + s * self.along[0] + out * self.into[0],
                self.a[1] + s * self.along[1] + out * self.into[1], z)

    def keep(self, s0, s1):
        """Refuses what would hang or stand in an opening, or past the wall's ends."""
        if s0 < -1e-6 or s1 > self.length + 1e-6 or any(a < s1 and s0 < b for a, b, _ in self.openings):
            raise ValueError("no wall at s = %.2f to %.2f of the wall from %s" % (s0, s1, self.a))

    def yaw(self):
        """Turns furniture's +y into the room."""
        return math.degrees(math.atan2(self.into[1], self.into[0])) - 90


class Building(Model):
    def __init__(self, name, height, thickness=0.1):
        super().__init__(name, width=1024, resolution=110)
        self.height, self.thickness = height, thickness

    def paint(self, name, length, painter, *arguments):
        """A texture for a wall of that length."""
        return self.picture(name, min(1024, round(length * WALL_PIXELS)),
                            round(self.height * WALL_PIXELS), painter, *arguments)

    def run(self, corners, skins, openings=None, closed=True):
        """
        Walls through the corners, the room on their right. openings: wall -> [(s0, s1, height)].
        skins: a region for each wall.
        """
        pairs = list(zip(corners, corners[1:] + (corners[:1] if closed else [])))
        walls = [Wall(a, b) for a, b in pairs]
        for i, wall in enumerate(walls):
            ends = []
            for other, first in ((walls[i - 1], False), (walls[(i + 1) % len(walls)], True)):
                d, e = (wall.along, other.along) if first else (other.along, wall.along)
                ends.append(self.thickness if d[0] * e[1] - d[1] * e[0] < -0.5 else 0.0)
            wall.openings = sorted((openings or {}).get(i, []))
            self._wall(wall, skins[i], ends)
        return walls

    def _wall(self, wall, skin, ends):
        start = 0.0
        for s0, s1, height in wall.openings + [(wall.length, wall.length, 0.0)]:
            self._panel(wall, skin, start, s0, 0.0, ends[0] if start == 0.0 else 0.0,
                        ends[1] if s0 == wall.length else 0.0)
            self._panel(wall, skin, s0, s1, height, 0.0, 0.0)
            start = s1

    def _panel(self, wall, skin, s0, s1, z0, before, after):
        if s1 - s0 < 1e-6 or self.height - z0 < 1e-6:
            return
        self.quad(wall.at(s0, z0), wall.at(s1, z0), wall.at(s1, self.height), wall.at(s0, self.height),
                  skin.part(s0 / wall.length, s1 / wall.length, 0.0, 1 - z0 / self.height))
        p, q = wall.at(s0 - before, z0), wall.at(s1 + after, self.height, -self.thickness)
        self.solid(tuple(map(min, p, q)), tuple(map(max, p, q)))

    def hang(self, wall, s, z, width, height, skin, out=0.012):
        """A picture on a wall: its middle at s, its lower edge at z."""
        s0, s1 = s - width / 2, s + width / 2
        wall.keep(s0, s1)
        self.quad(wall.at(s0, z, out), wall.at(s1, z, out), wall.at(s1, z + height, out),
                  wall.at(s0, z + height, out), skin)

    def shelf_box(self, wall, s, z, width, height, depth, skin, front=None, solid=True):
        """A box that stands out of a wall."""
        p, q = wall.at(s - width / 2, z), wall.at(s + width / 2, z + height, depth)
        side = {(0, -1): "ny", (0, 1): "py", (1, 0): "px", (-1, 0): "nx"}[
            tuple(round(c) for c in wall.into)]
        self.box(tuple(map(min, p, q)), tuple(map(max, p, q)), skin, solid, **{side: front or skin})

    def floor(self, x0, y0, x1, y1, skin, z=0.0):
        self.quad((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z), skin)

    def ceiling(self, x0, y0, x1, y1, skin):
        z = self.height
        self.quad((x0, y0, z), (x0, y1, z), (x1, y1, z), (x1, y0, z), skin)

    def slab(self, x0, y0, x1, y1):
        """What carries the floor and the ceiling, for whatever falls."""
        self.solid((x0, y0, -0.1), (x1, y1, 0.0))
        self.solid((x0, y0, self.height), (x1, y1, self.height + 0.1))

    def lamp(self, x, y, wide, deep, drop=0.06):
        """The panel of a lamp below the ceiling."""
        z = self.height
        self.box((x - wide / 2, y - deep / 2, z - drop), (x + wide / 2, y + deep / 2, z),
                 Plain("lamp_rim", (225, 225, 222)), solid=False, nz=LAMP, pz=None)

    def doorway(self, x0, y0, x1, y1, height, through_x, floor_skin, jamb_skin):
        """The inside of an opening through a wall: jambs, lintel, threshold."""
        self.floor(x0, y0, x1, y1, floor_skin)
        self.quad((x0, y0, height), (x0, y1, height), (x1, y1, height), (x1, y0, height), jamb_skin)
        if through_x:
            self.quad((x1, y0, 0), (x0, y0, 0), (x0, y0, height), (x1, y0, height), jamb_skin)
            self.quad((x0, y1, 0), (x1, y1, 0), (x1, y1, height), (x0, y1, height), jamb_skin)
        else:
            self.quad((x0, y0, 0), (x0, y1, 0), (x0, y1, height), (x0, y0, height), jamb_skin)
            self.quad((x1, y1, 0), (x1, y0, 0), (x1, y0, height), (x1, y1, height), jamb_skin)

    def gallery(self, wall, spots, resolution=None):
        """Posters: (s, z, width, height)."""
        for s, z, width, height in spots:
            self.hang(wall, s, z, width, height,
                      self.swatch(width, height, surfaces.poster, resolution=resolution))


def painted(view, rng, colour, low=0.86, high=1.06, ducts=True, skirting=(90, 80, 72)):
    """A wall's own texture."""
    surfaces.plaster(view, rng, colour, low, high, skirting)
    surfaces.fittings(view, rng, WALL_PIXELS, ducts)


def openings(corners, doorways):
    """For run(): which parts of which walls lie on doorways (x0, y0, x1, y1, height)."""
    found = {}
    for i, (a, b) in enumerate(zip(corners, corners[1:] + corners[:1])):
        wall = Wall(a, b)
        for x0, y0, x1, y1, height in doorways:
            spots = [((x - a[0]) * wall.along[0] + (y - a[1]) * wall.along[1],
                      (x - a[0]) * wall.into[0] + (y - a[1]) * wall.into[1])
                     for x, y in ((x0, y0), (x1, y1))]
            (s0, s1), (n0, n1) = sorted(s for s, _ in spots), sorted(n for _, n in spots)
            if abs(n1) < 1e-6 and n0 > -0.3 and s0 > 0 and s1 < wall.length:
                found.setdefault(i, []).append((s0, s1, height))
    return found
