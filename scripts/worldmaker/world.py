# SPDX-License-Identifier: GPL-3.0-or-later
"""A world: models at their places, lamps, and a floor plan to look at."""

import math

from .canvas import Canvas
from .model import number

LASER_HEIGHT = 0.33
BODY = (0.03, 0.97)  # heights the robot's body fills, metres


class World:
    """`start` is the place, in the builder's coordinates, that becomes the world's origin."""

    def __init__(self, name, start, ambient=0.35):
        self.name, self.start, self.ambient = name, start, ambient
        self.places = []
        self.lights = []

    def add(self, model, x=0.0, y=0.0, yaw_deg=0.0, z=0.0):
        self.places.append((model, x, y, z, math.radians(yaw_deg)))

    def against(self, wall, s, model, out=0.02):
        """Furniture with its back to a wall."""
        widths = [centre[0] + sign * (size[0] / 2 if kind == "box" else size[0])
                  for kind, centre, size in model.solids for sign in (-1, 1)]
        wall.keep(s - max(widths), s - min(widths))
        x, y, _ = wall.at(s, 0.0, out)
        self.add(model, x, y, wall.yaw())

    def lamp(self, name, x, y, z, colour, reach=12.0):
        self.lights.append((name, x, y, z, colour, reach))

    def models(self):
        return {model.name: model for model, *_ in self.places}

    def sdf(self):
        lines = ['<?xml version="1.0"?>', "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->",
                 "<!-- Made by scripts/make-worlds. -->", '<sdf version="1.6">',
                 '  <world name="%s">' % self.name, "    <scene>",
                 "      <ambient>%s 1</ambient>" % " ".join([number(self.ambient)] * 3),
                 "      <background>0.55 0.65 0.8 1</background>", "    </scene>"]
        for name, x, y, z, colour, reach in self.lights:
            lines.append(
                '    <light name="%s" type="point"><pose>%s 0 0 0</pose><diffuse>%s 1</diffuse>'
                "<specular>0.1 0.1 0.1 1</specular><attenuation><range>%s</range>"
                "<constant>0.25</constant><linear>0.08</linear><quadratic>0.1</quadratic>"
                "</attenuation><cast_shadows>true</cast_shadows></light>"
                % (name, self._pose(x, y, z), " ".join(map(number, colour)), number(reach)))
        counts = {}
        for model, x, y, z, yaw in self.places:
            counts[model.name] = counts.get(model.name, 0) + 1
            lines.append("    <include><name>%s_%d</name><uri>model://%s</uri>"
                         "<pose>%s 0 0 %s</pose></include>"
                         % (model.name, counts[model.name], model.name, self._pose(x, y, z), number(yaw)))
        return "\n".join(lines + ["  </world>", "</sdf>", ""])

    def _pose(self, x, y, z):
        return "%s %s %s" % (number(x - self.start[0]), number(y - self.start[1]), number(z))

    def plan(self, pixels=40):
        """
        A floor plan: black is met by the laser, orange only by the body, pink is nearer than 0.6 m
        to either, the cross is the start.
        """
        shapes = [shape for place in self.places for shape in _footprints(*place)]
        xs = [x for outline, *_ in shapes for x, _ in outline]
        ys = [y for outline, *_ in shapes for _, y in outline]
        x0, y1 = min(xs) - 0.2, max(ys) + 0.2
        canvas = Canvas(int((max(xs) + 0.2 - x0) * pixels), int((y1 - min(ys) + 0.2) * pixels),
                        (255, 255, 255))
        for margin, colour, blind in ((0.6, (255, 190, 200), True), (0.0, (240, 140, 40), True),
                                      (0.0, (0, 0, 0), False)):
            for outline, low, high in shapes:
                laser = low <= LASER_HEIGHT <= high
                if laser or (blind and low < BODY[1] and high > BODY[0]):
                    _draw(canvas, [((x - x0) * pixels, (y1 - y) * pixels) for x, y in outline],
                          margin * pixels, colour)
        cx, cy = (self.start[0] - x0) * pixels, (y1 - self.start[1]) * pixels
        canvas.line(cx - 8, cy, cx + 8, cy, (0, 0, 220), 2)
        canvas.line(cx, cy - 8, cx, cy + 8, (0, 0, 220), 2)
        for i in range(1, int(canvas.width / pixels)):
            canvas.rect(i * pixels, canvas.height - 4, i * pixels + 1, canvas.height, (0, 0, 220))
        return canvas.png()


def _footprints(model, x, y, z, yaw):
    """(outline, lowest, highest) of each solid."""
    c, s = math.cos(yaw), math.sin(yaw)
    for kind, centre, size in model.solids:
        if kind == "box":
            half, tall = (size[0] / 2, size[1] / 2), size[2]
            points = [(a * half[0], b * half[1]) for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        else:
            tall = size[1]
            points = [(size[0] * math.cos(t * math.pi / 6), size[0] * math.sin(t * math.pi / 6))
                      for t in range(12)]
        points = [(p + centre[0], q + centre[1]) for p, q in points]
        yield ([(x + c * p - s * q, y + s * p + c * q) for p, q in points],
               z + centre[2] - tall / 2, z + centre[2] + tall / 2)


def _draw(canvas, outline, margin, colour):
    """Fills a convex outline, and all within the margin of it."""
    if margin:
        for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
            steps = int(math.hypot(bx - ax, by - ay) / 4) + 1
            for i in range(steps):
                canvas.ellipse(ax + (bx - ax) * i / steps, ay + (by - ay) * i / steps, margin, margin,
                               colour)
    ys = [y for _, y in outline]
    for row in range(int(min(ys)), int(max(ys)) + 1):
        cuts = []
        for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
            if ay != by and min(ay, by) <= row + 0.5 <= max(ay, by):
                cuts.append(ax + (bx - ax) * (row + 0.5 - ay) / (by - ay))
        if cuts:
            canvas.rect(round(min(cuts)), row, max(round(max(cuts)), round(min(cuts)) + 1), row + 1, colour)
