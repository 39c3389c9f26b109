# SPDX-License-Identifier: GPL-3.0-or-later
"""Furniture: each function makes one model; the name seeds its looks."""

from . import surfaces as look
from .model import Model, Plain

BLACK = Plain("black", (32, 33, 36))
CHROME = Plain("chrome", (150, 152, 156))
PAPER = Plain("paper", (230, 228, 220))


def _mug(model, x, y, z):
    colour = model.rng.pick(look.BRIGHT)
    skin = Plain("mug_%02x%02x%02x" % colour, colour)
    model.column(x, y, 0.04, 0.045, z, z + 0.1, skin, skin, sides=8, solid=False)


def _monitor(model, x, y, z, width=0.52):
    height = width * 0.6
    face = model.swatch(width, height, look.screen, resolution=150)
    model.box((x - 0.1, y - 0.08, z), (x + 0.1, y + 0.1, z + 0.015), BLACK, solid=False)
    model.box((x - 0.025, y - 0.03, z), (x + 0.025, y, z + 0.14), BLACK, solid=False)
    model.box((x - width / 2, y - 0.02, z + 0.1), (x + width / 2, y + 0.02, z + 0.1 + height), BLACK,
              py=face)


def _pile(model, x, y, z):
    """Books lying on each other."""
    for _ in range(model.rng.integer(2, 6)):
        colour = model.rng.pick(look.BRIGHT)
        w, d, h = model.rng.uniform(0.1, 0.14), model.rng.uniform(0.08, 0.11), model.rng.uniform(0.02, 0.05)
        model.box((x - w, y - d, z), (x + w, y + d, z + h), Plain("book_%02x%02x%02x" % colour, colour),
                  solid=False)
        z += h


def _top_things(model, width, depth, z, screens):
    """What stands on a desk."""
    rng = model.rng
    slots = [(-width / 2 + width * (i + 0.5) / 3) for i in range(3)]
    for i, x in enumerate(slots):
        x += rng.uniform(-0.08, 0.08)
        if i in screens:
            _monitor(model, x, depth * 0.35, z, rng.pick((0.46, 0.52, 0.6)))
            model.box((x - 0.22, depth * 0.62, z), (x + 0.22, depth * 0.62 + 0.15, z + 0.025),
                      model.swatch(0.44, 0.16, look.papers, (60, 60, 64)), solid=False)
        else:
            kind = rng.integer(0, 2)
            if kind == 0:
                _pile(model, x, depth * rng.uniform(0.3, 0.6), z)
            elif kind == 1:
                s, skin = rng.uniform(0.12, 0.19), model.swatch(0.36, 0.3, look.carton)
                model.box((x - s, depth * 0.2, z), (x + s, depth * 0.2 + 0.25, z + s * 1.5), skin)
            else:
                skin = model.swatch(0.2, 0.42, look.drawers, rng.pick((look.WHITE, look.DARK)), 3)
                model.box((x - 0.1, depth * 0.15, z), (x + 0.1, depth * 0.15 + 0.42, z + 0.42), BLACK,
                          py=skin)
        if rng.chance(0.7):
            _mug(model, x + rng.uniform(0.12, 0.2), depth * rng.uniform(0.6, 0.85), z)


def desk(name, width=1.6, depth=0.8, colour=look.BEECH, knee=True, screens=(1,)):
    """A desk with closed pedestals; the laser meets them. Without knee hole all of it is closed."""
    model = Model(name)
    top = model.swatch(width, depth, look.clutter, colour)
    side = model.swatch(0.8, 0.72, look.wood, colour, tiling=True)
    model.box((-width / 2, 0, 0.70), (width / 2, depth, 0.74), side, pz=top)
    if knee:
        for x0, x1 in ((-width / 2, -0.35), (0.35, width / 2)):
            front = model.swatch(x1 - x0, 0.68, look.drawers, model.rng.near(colour, 14), 3)
            model.box((x0, 0, 0.02), (x1, depth - 0.04, 0.70), side, py=front, pz=None)
        model.box((-0.35, 0.05, 0.05), (0.35, 0.08, 0.70), side)
    else:
        front = model.swatch(width, 0.68, look.leaves, colour, max(2, round(width / 0.5)))
        model.box((-width / 2, 0, 0.02), (width / 2, depth - 0.04, 0.70), side, py=front, pz=None)
    _top_things(model, width, depth, 0.74, screens)
    return model


def bookshelf(name, width=0.9, height=2.0, depth=0.32, colour=look.OAK, shelves=5):
    model = Model(name, resolution=150)
    side = model.swatch(0.4, 1.2, look.wood, colour, tiling=True)
    model.box((-width / 2, 0, 0), (width / 2, depth - 0.06, height), side, py=None)
    for x in (-width / 2, width / 2 - 0.025):
        model.box((x, depth - 0.06, 0), (x + 0.025, depth, height), side, solid=False)
    pitch = (height - 0.08) / shelves
    for i in range(shelves):
        z = 0.08 + i * pitch
        model.box((-width / 2, depth - 0.06, z - 0.03), (width / 2, depth, z), side, solid=False)
        if model.rng.chance(0.85):
            row = model.swatch(width, pitch - 0.03, look.books)
        else:
            row = model.swatch(width, pitch - 0.03, look.carton)
        y = depth - 0.05 + model.rng.uniform(0, 0.03)
        model.quad((width / 2, y, z), (-width / 2, y, z), (-width / 2, y, z + pitch - 0.03),
                   (width / 2, y, z + pitch - 0.03), row)
    model.box((-width / 2, depth - 0.06, height - 0.03), (width / 2, depth, height), side, solid=False)
    model.solid((-width / 2, depth - 0.06, 0), (width / 2, depth, height))
    if model.rng.chance(0.6):
        skin = model.swatch(0.4, 0.25, look.carton)
        model.box((-0.25, 0.02, height), (0.15, 0.28, height + 0.25), skin)
    return model


def file_cabinet(name, width=0.46, height=1.32, depth=0.6, colour=look.STEEL, count=4):
    model = Model(name, resolution=140)
    side = model.swatch(0.6, 1.0, look.metal, colour, tiling=True)
    front = model.swatch(width, height, look.drawers, colour, count)
    model.box((-width / 2, 0, 0), (width / 2, depth, height), side, py=front)
    if model.rng.chance(0.7):
        _pile(model, 0, depth * 0.5, height)
    return model


def cupboard(name, width=1.0, height=1.9, depth=0.45, colour=look.WHITE, count=2):
    model = Model(name, resolution=120)
    side = model.swatch(0.6, 1.2, look.wood, colour, tiling=True)
    model.box((-width / 2, 0, 0), (width / 2, depth, height), side,
              py=model.swatch(width, height, look.leaves, colour, count))
    return model


def swivel_chair(name, colour=(40, 60, 110)):
    """On a column and a star of feet; the laser meets only the column. Seat over the origin, facing -y."""
    model = Model(name, width=128)
    skin = model.swatch(0.5, 0.5, look.fabric, colour, tiling=True)
    model.box((-0.27, -0.035, 0.05), (0.27, 0.035, 0.09), BLACK, solid=False)
    model.box((-0.035, -0.27, 0.05), (0.035, 0.27, 0.09), BLACK, solid=False)
    model.solids.append(("cylinder", (0, 0, 0.07), (0.25, 0.04)))
    model.column(0, 0, 0.035, 0.035, 0.05, 0.43, CHROME, sides=8)
    model.box((-0.23, -0.22, 0.43), (0.23, 0.22, 0.50), skin)
    model.box((-0.03, 0.2, 0.45), (0.03, 0.24, 0.65), BLACK, solid=False)
    model.box((-0.21, 0.18, 0.58), (0.21, 0.24, 0.98), skin)
    return model


def wooden_chair(name, colour=look.OAK):
    """Four legs that the laser meets, facing -y."""
    model = Model(name, width=128)
    skin = model.swatch(0.5, 0.5, look.wood, colour, tiling=True)
    for x in (-0.21, 0.17):
        model.box((x, -0.2, 0), (x + 0.04, -0.16, 0.43), skin)
        model.box((x, 0.17, 0), (x + 0.04, 0.21, 0.92), skin)
    model.box((-0.22, -0.22, 0.43), (0.22, 0.22, 0.46), skin)
    for z in (0.58, 0.74):
        model.box((-0.2, 0.18, z), (0.2, 0.205, z + 0.12), skin)
    return model


def stool(name, colour):
    """A padded cube."""
    model = Model(name, width=128)
    skin = model.swatch(0.42, 0.84, look.fabric, colour, tiling=True)
    model.box((-0.21, -0.21, 0), (0.21, 0.21, 0.45), skin)
    return model


def study_table(name, width=2.4, depth=1.2, colour=look.WALNUT):
    """Stands free: the origin is its middle. End panels and a panel along its middle reach the floor."""
    model = Model(name)
    side = model.swatch(1.0, 0.7, look.wood, colour, tiling=True)
    top = model.swatch(width, depth, look.clutter, colour)
    model.box((-width / 2, -depth / 2, 0.70), (width / 2, depth / 2, 0.75), side, pz=top)
    for x in (-width / 2, width / 2 - 0.05):
        model.box((x, -depth / 2 + 0.05, 0), (x + 0.05, depth / 2 - 0.05, 0.70), side)
    model.box((-width / 2 + 0.05, -0.03, 0.1), (width / 2 - 0.05, 0.03, 0.70), side)
    for _ in range(4):
        x, y = model.rng.uniform(-0.42, 0.42) * width, model.rng.uniform(-0.35, 0.35) * depth
        model.rng.pick((_pile, _mug, _pile))(model, x, y, 0.75)
    return model


def counter_block(name, width, depth, height, colour, painter=look.leaves, solid_top=None, items=True):
    """A closed box with a painted front: sideboards, kitchen units, benches of a workshop."""
    model = Model(name, resolution=110)
    side = model.swatch(0.7, 0.8, look.wood, colour, tiling=True)
    front = model.swatch(width, height, painter, colour, max(1, round(width / 0.55)))
    top = model.swatch(width, depth, look.clutter, solid_top or colour)
    model.box((-width / 2, 0, 0), (width / 2, depth, height), side, py=front, pz=top)
    if items:
        for i in range(max(1, round(width / 0.5))):
            x = -width / 2 + 0.25 + i * 0.5 + model.rng.uniform(-0.08, 0.08)
            if x < width / 2 - 0.15:
                model.rng.pick((_pile, _mug, _mug))(model, x, depth * model.rng.uniform(0.3, 0.6), height)
    return model


def appliance(name, width, depth, height, colour, front, *arguments):
    """A box with its own front: copier, fridge, oven, television stand."""
    model = Model(name, resolution=120)
    side = model.swatch(0.6, 0.8, look.metal, colour, tiling=True)
    model.box((-width / 2, 0, 0), (width / 2, depth, height), side,
              py=model.swatch(width, height, front, *arguments))
    return model


def plant(name, height=1.4, colour=(50, 110, 50)):
    """Stands free, the origin is its middle."""
    model = Model(name, width=128)
    rng = model.rng
    leaf = model.swatch(0.6, 0.6, look.fabric, colour, tiling=True)
    pot = Plain("pot", rng.near((150, 90, 60), 25))
    model.column(0, 0, 0.15, 0.19, 0, 0.4, pot, Plain("soil", (60, 45, 35)))
    model.column(0, 0, 0.025, 0.02, 0.4, height * 0.7, Plain("trunk", (95, 70, 45)), sides=6, solid=False)
    z = 0.5
    while z < height:
        r, h = rng.uniform(0.14, 0.27), rng.uniform(0.12, 0.24)
        x, y = rng.uniform(-0.06, 0.06), rng.uniform(-0.06, 0.06)
        model.column(x, y, r, r * 0.3, z, z + h, leaf, leaf, sides=7, solid=False)
        z += h * 0.7
    model.solids.append(("cylinder", (0, 0, (0.4 + height) / 2), (0.22, height - 0.4)))
    return model


def bin_(name, colour):
    model = Model(name, width=128)
    skin = model.swatch(0.5, 0.4, look.fabric, colour)
    model.column(0, 0, 0.13, 0.16, 0, 0.42, skin, BLACK)
    return model


def cartons(name, count=3):
    """A heap of boxes, backs at y = 0."""
    model = Model(name)
    x = -0.28 * count
    for _ in range(count):
        w, z = model.rng.uniform(0.4, 0.55), 0.0
        for _ in range(model.rng.integer(1, 3)):
            h, d = model.rng.uniform(0.38, 0.46), model.rng.uniform(0.34, 0.45)
            model.box((x, 0, z), (x + w, d, z + h), model.swatch(w, h, look.carton))
            z += h
        x += w + 0.02
    return model


def sofa(name, width=1.8, colour=(130, 50, 50)):
    model = Model(name)
    skin = model.swatch(1.2, 0.8, look.fabric, colour, tiling=True)
    model.box((-width / 2, 0, 0.02), (width / 2, 0.85, 0.42), skin)
    model.box((-width / 2, 0, 0.42), (width / 2, 0.22, 0.85), skin)
    for x in (-width / 2, width / 2 - 0.18):
        model.box((x, 0.22, 0.42), (x + 0.18, 0.85, 0.62), skin)
    for i in range(2):
        cushion = model.swatch(0.4, 0.4, look.rug)
        x = -width / 4 + i * width / 2
        model.box((x - 0.2, 0.22, 0.43), (x + 0.2, 0.34, 0.8), cushion)
    return model


def bed(name, width=1.5, length=2.0, colour=(90, 120, 160)):
    model = Model(name)
    wood = model.swatch(0.8, 0.6, look.wood, look.OAK, tiling=True)
    model.box((-width / 2, 0.06, 0.02), (width / 2, length, 0.36), wood)
    cover = model.swatch(width, length - 0.5, look.rug, resolution=90)
    model.box((-width / 2 + 0.02, 0.55, 0.36), (width / 2 - 0.02, length - 0.02, 0.54),
              model.swatch(0.8, 0.3, look.fabric, colour, tiling=True), pz=cover)
    model.box((-width / 2 + 0.02, 0.06, 0.36), (width / 2 - 0.02, 0.55, 0.58), PAPER)
    model.box((-width / 2, 0, 0), (width / 2, 0.06, 1.0), wood)
    return model


def pillar(name, side=0.4, height=2.8, colour=(190, 190, 180)):
    """Stands free, the origin is its middle; a poster on each face."""
    model = Model(name, width=256)
    half = side / 2
    faces = {face: model.swatch(side, height, _pillar_face, colour) for face in ("px", "nx", "py", "ny")}
    model.box((-half, -half, 0), (half, half, height), PAPER, pz=None, nz=None, **faces)
    return model


def _pillar_face(view, rng, colour):
    look.plaster(view, rng, rng.near(colour, 12))
    w = int(view.width * 0.8)
    look.poster(view.view(view.width * 0.1, view.height * rng.uniform(0.3, 0.45), w, w * 1.3), rng)


def extinguisher(name):
    """Hangs on a wall, its back at y = 0."""
    model = Model(name, width=128)
    red = model.swatch(0.5, 0.5, _red_bottle)
    model.column(0, 0.1, 0.08, 0.08, 0.15, 0.62, red, BLACK)
    model.column(0, 0.1, 0.02, 0.02, 0.62, 0.72, BLACK, sides=6, solid=False)
    return model


def _red_bottle(view, rng):
    view.fill((190, 25, 22))
    view.rect(0, view.height * 0.3, view.width, view.height * 0.75, look.WHITE)
    look.lines_of_text(view, rng, 2, view.height * 0.34, view.width - 2, view.height * 0.7, look.DARK, 4)


def bench(name, width=1.6, colour=look.OAK):
    """A closed bench against a wall."""
    model = Model(name)
    skin = model.swatch(1.0, 0.6, look.wood, colour, tiling=True)
    model.box((-width / 2, 0, 0), (width / 2, 0.38, 0.44), skin,
              pz=model.swatch(width, 0.38, look.fabric, model.rng.colour(60, 180)))
    return model


def notice_board(name, width=1.5, colour=(60, 90, 130)):
    """A board on feet that stands off the wall by a hand's breadth."""
    model = Model(name, resolution=130)
    board = model.swatch(width, 1.3, look.papers, colour)
    model.box((-width / 2, 0.1, 0.6), (width / 2, 0.14, 1.9), Plain("frame", (120, 120, 122)), py=board)
    model.box((-width / 2, 0.02, 0), (-width / 2 + 0.05, 0.22, 0.6), BLACK)
    model.box((width / 2 - 0.05, 0.02, 0), (width / 2, 0.22, 0.6), BLACK)
    return model


def room_door(name, colour):
    """A closed door in its frame, its back at y = 0."""
    model = Model(name, resolution=110)
    leaf = model.swatch(0.95, 2.05, look.door, colour, "")
    rim = Plain("door_rim", (96, 92, 88))
    model.box((-0.475, 0, 0), (0.475, 0.03, 2.05), rim, py=leaf)
    model.box((-0.54, 0, 0), (-0.475, 0.05, 2.12), rim)
    model.box((0.475, 0, 0), (0.54, 0.05, 2.12), rim)
    model.box((-0.475, 0, 2.05), (0.475, 0.05, 2.12), rim)
    return model


def television(name, width=1.4):
    model = counter_block(name, width, 0.42, 0.5, look.WALNUT, items=False)
    face = model.swatch(1.1, 0.64, look.screen, resolution=90)
    model.box((-0.55, 0.1, 0.55), (0.55, 0.15, 1.19), BLACK, py=face)
    return model


def kitchen(name, width=2.4, colour=(200, 190, 170)):
    """Lower and upper units."""
    model = counter_block(name, width, 0.6, 0.9, colour, solid_top=look.STEEL)
    upper = model.swatch(width, 0.6, look.leaves, colour, round(width / 0.5))
    model.box((-width / 2, 0, 1.45), (width / 2, 0.35, 2.05), PAPER, py=upper)
    tiles = model.swatch(width, 0.55, look.lino, (190, 205, 205), 16)
    model.quad((width / 2, 0.01, 0.9), (-width / 2, 0.01, 0.9), (-width / 2, 0.01, 1.45),
               (width / 2, 0.01, 1.45), tiles)
    return model
