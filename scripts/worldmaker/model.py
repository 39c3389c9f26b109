# SPDX-License-Identifier: GPL-3.0-or-later
"""A Gazebo model: a textured OBJ mesh, and boxes and cylinders to collide with."""

import math

from .canvas import Canvas, Rng

GAP = 2  # pixels between the regions of an atlas


def number(value):
    return "%g" % (round(value, 4) + 0.0)


class Region:
    """A part of a texture. A tiling one is cropped to the size of the face it covers."""

    def __init__(self, texture, x, y, width, height, resolution, tiling):
        self.texture, self.resolution, self.tiling = texture, resolution, tiling
        self.x, self.y, self.width, self.height = x, y, width, height

    def crop(self, rng, width_m, height_m):
        if not self.tiling:
            return self
        width = min(self.width, max(2, width_m * self.resolution))
        height = min(self.height, max(2, height_m * self.resolution))
        return Region(self.texture, self.x + rng.uniform(0, self.width - width),
                      self.y + rng.uniform(0, self.height - height), width, height,
                      self.resolution, False)

    def part(self, left, right, top=0.0, bottom=1.0):
        """The shares left to right and top to bottom of it."""
        return Region(self.texture, self.x + left * self.width, self.y + top * self.height,
                      (right - left) * self.width, (bottom - top) * self.height,
                      self.resolution, self.tiling)

    def corners(self, canvas):
        """Texture coordinates of bottom left, bottom right, top right, top left; v grows upwards."""
        u0, u1 = (self.x + 0.5) / canvas.width, (self.x + self.width - 0.5) / canvas.width
        v0 = 1 - (self.y + self.height - 0.5) / canvas.height
        v1 = 1 - (self.y + 0.5) / canvas.height
        return (u0, v0), (u1, v0), (u1, v1), (u0, v1)


class Plain:
    """A colour without texture."""

    def __init__(self, name, colour):
        self.name, self.colour = name, colour

    def crop(self, _rng, _width_m, _height_m):
        return self


class Model:
    """
    Local frame of furniture: back at y = 0, front towards +y, x along the back with the middle at
    0, z up from the floor; metres.
    """

    def __init__(self, name, width=256, resolution=100):
        self.name, self.resolution = name, resolution
        self.rng = Rng(name)
        self.textures = {name: Canvas(width, 4)}
        self.solids = []
        self._faces = []
        self._cursor = [0, 0, 0]

    def swatch(self, width_m, height_m, painter, *arguments, tiling=False, resolution=None):
        """Paints a new region of the model's atlas: painter(view, rng, *arguments)."""
        resolution = resolution or self.resolution
        atlas = self.textures[self.name]
        width = min(atlas.width, max(4, round(width_m * resolution)))
        height = max(4, round(height_m * resolution))
        x, y, row = self._cursor
        if x + width > atlas.width:
            x, y, row = 0, y + row + GAP, 0
        atlas.grow(y + height)
        painter(atlas.view(x, y, width, height), self.rng, *arguments)
        self._cursor = [x + width + GAP, y, max(row, height)]
        return Region(self.name, x, y, width, height, resolution, tiling)

    def picture(self, name, width, height, painter, *arguments):
        """A texture of its own."""
        canvas = Canvas(width, height)
        painter(canvas, self.rng, *arguments)
        self.textures[name] = canvas
        return Region(name, 0, 0, width, height, self.resolution, False)

    def quad(self, a, b, c, d, skin):
        """Corners as seen from its front: bottom left, bottom right, top right, top left."""
        skin = skin.crop(self.rng, math.dist(a, b), math.dist(b, c))
        self._faces.append(((a, b, c, d), skin))

    def box(self, low, high, skin, solid=True, **sides):
        """`sides` px, nx, py, ny, pz, nz override the skin of a face; None leaves it out."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        for side, corners in (
                ("py", ((x1, y1, z0), (x0, y1, z0), (x0, y1, z1), (x1, y1, z1))),
                ("ny", ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1))),
                ("px", ((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1))),
                ("nx", ((x0, y1, z0), (x0, y0, z0), (x0, y0, z1), (x0, y1, z1))),
                ("pz", ((x1, y1, z1), (x0, y1, z1), (x0, y0, z1), (x1, y0, z1))),
                ("nz", ((x0, y1, z0), (x1, y1, z0), (x1, y0, z0), (x0, y0, z0)))):
            chosen = sides.get(side, skin)
            if chosen is not None:
                self.quad(*corners, chosen)
        if solid:
            self.solid(low, high)

    def column(self, x, y, r0, r1, z0, z1, skin, top=None, sides=10, solid=True):
        """An upright cylinder, or a cone's slice with radius r0 below and r1 above."""
        for i in range(sides):
            a, b = 2 * math.pi * i / sides, 2 * math.pi * (i + 1) / sides
            ring = [(x + r * math.cos(t), y + r * math.sin(t), z)
                    for r, t, z in ((r0, a, z0), (r0, b, z0), (r1, b, z1), (r1, a, z1))]
            part = skin.part(i / sides, (i + 1) / sides) if isinstance(skin, Region) else skin
            self._faces.append((ring, part))
            if top is not None:
                self.quad((x, y, z1), ring[3], ring[2], ring[2], top)
        if solid:
            self.solids.append(("cylinder", (x, y, (z0 + z1) / 2), (max(r0, r1), z1 - z0)))

    def solid(self, low, high):
        self.solids.append(("box", tuple((a + b) / 2 for a, b in zip(low, high)),
                            tuple(b - a for a, b in zip(low, high))))

    def files(self):
        """Name below the model's folder -> bytes."""
        result = {"model.config": self._config(), "model.sdf": self._sdf(),
                  "meshes/%s.obj" % self.name: self._obj(), "meshes/%s.mtl" % self.name: self._mtl()}
        result = {name: text.encode() for name, text in result.items()}
        for name in sorted({f[1].texture for f in self._faces if isinstance(f[1], Region)}):
            result["materials/textures/%s.png" % name] = self.textures[name].png()
        return result

    def _obj(self):
        places, uvs, normals = {}, {}, {}
        groups = {}
        for corners, skin in self._faces:
            if isinstance(skin, Region):
                material, spots = skin.texture, skin.corners(self.textures[skin.texture])
            else:
                material, spots = skin.name, ((0, 0), (1, 0), (1, 1), (0, 1))
            normal = _normal(corners)
            face, seen = [], []
            for corner, spot in zip(corners, spots):
                if corner in seen:
                    continue
                seen.append(corner)
                indices = [pool.setdefault(" ".join(map(number, each)), len(pool) + 1)
                           for pool, each in ((places, corner), (uvs, spot), (normals, normal))]
                face.append("/".join(map(str, indices)))
            groups.setdefault(material, []).append("f " + " ".join(face))
        lines = ["# SPDX-License-Identifier: GPL-3.0-or-later", "mtllib %s.mtl" % self.name]
        for prefix, pool in (("v ", places), ("vt ", uvs), ("vn ", normals)):
            lines += [prefix + each for each in pool]
        for material in sorted(groups):
            lines += ["usemtl " + material] + groups[material]
        return "\n".join(lines) + "\n"

    def _mtl(self):
        lines = ["# SPDX-License-Identifier: GPL-3.0-or-later"]
        skins = {}
        for _, skin in self._faces:
            skins[skin.texture if isinstance(skin, Region) else skin.name] = skin
        for name in sorted(skins):
            skin = skins[name]
            lines += ["newmtl " + name, "Ka 0 0 0", "Ks 0 0 0", "illum 1"]
            if isinstance(skin, Region):
                lines += ["Kd 1 1 1", "map_Kd ../materials/textures/%s.png" % name]
            else:
                lines += ["Kd %s %s %s" % tuple(number(c / 255) for c in skin.colour)]
        return "\n".join(lines) + "\n"

    def _sdf(self):
        parts = []
        for i, (kind, centre, size) in enumerate(self.solids):
            if kind == "box":
                shape = "<box><size>%s</size></box>" % " ".join(map(number, size))
            else:
                shape = "<cylinder><radius>%s</radius><length>%s</length></cylinder>" % tuple(
                    map(number, size))
            parts.append('      <collision name="part_%d"><pose>%s 0 0 0</pose>'
                         "<geometry>%s</geometry></collision>\n"
                         % (i, " ".join(map(number, centre)), shape))
        return ('<?xml version="1.0"?>\n<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n'
                '<sdf version="1.6">\n  <model name="%s">\n    <static>true</static>\n'
                '    <link name="link">\n      <visual name="visual"><geometry><mesh>'
                "<uri>model://%s/meshes/%s.obj</uri></mesh></geometry></visual>\n%s"
                "    </link>\n  </model>\n</sdf>\n"
                % (self.name, self.name, self.name, "".join(parts)))

    def _config(self):
        return ('<?xml version="1.0"?>\n<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n'
                "<model>\n  <name>%s</name>\n  <version>1.0</version>\n"
                '  <sdf version="1.6">model.sdf</sdf>\n'
                "  <description>Made by scripts/make-worlds.</description>\n</model>\n" % self.name)


def _normal(corners):
    a, b, d = corners[0], corners[1], corners[3]
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, d)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.hypot(*n) or 1.0
    return tuple(c / length for c in n)
