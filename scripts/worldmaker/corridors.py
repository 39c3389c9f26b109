# SPDX-License-Identifier: GPL-3.0-or-later
"""A loop of corridors with doors that all look alike; few things tell its sides from each other."""

from . import furniture as f
from . import surfaces as look
from .building import Building, painted
from .world import World

HEIGHT = 2.6
OUTER = [(0, 12), (6.5, 12), (6.5, 14), (9.5, 14), (9.5, 12), (16, 12), (16, 0), (0, 0)]
INNER = [(2, 2), (14, 2), (14, 10), (2, 10)]
PAINT = (198, 190, 170)
LAMPS = [(x, y) for y in (1, 11) for x in (2, 6, 10, 14)] + [
    (x, y) for x in (1, 15) for y in (4, 8)] + [(8, 13.2)]


def make():
    world = World("corridors", (8.0, 11.7))
    building = Building("corridors_building", HEIGHT)
    outer, inner = _walls(building)
    building.floor(0, 0, 16, 14, building.picture("corridors_floor", 1024, 896, look.lino,
                                              (140, 128, 110), 38))
    building.ceiling(0, 0, 16, 14, building.picture("corridors_ceiling", 768, 672, look.ceiling,
                                                    (206, 206, 202), 29))
    for x in (2, 6, 10):  # the closed offices
        for y in (2, 6):
            building.solid((x, y, 0), (x + 4, y + 4, HEIGHT))
    building.slab(-0.1, -0.1, 16.1, 14.1)
    for i, (x, y) in enumerate(LAMPS):
        along = y in (1, 11)
        building.lamp(x, y, 1.2 if along else 0.3, 0.3 if along else 1.2)
        world.lamp("lamp_%d" % (i + 1), x, y, HEIGHT - 0.22, (0.34, 0.33, 0.3), 9)
    _doors(world, building, outer, inner)
    _pictures(building, outer, inner)
    _furniture(world, outer, inner)
    world.add(building)
    return world


def _walls(b):
    skins = []
    for i, (a, c) in enumerate(zip(OUTER, OUTER[1:] + OUTER[:1])):
        length = abs(a[0] - c[0]) + abs(a[1] - c[1])
        skins.append(b.paint("corridors_outer_%d" % i, length, painted, PAINT, 0.88, 1.05, True,
                             (70, 84, 96)))
    outer = b.run(OUTER, skins)
    skins = [b.paint("corridors_inner_%d" % i, length, painted, PAINT, 0.88, 1.05, False, (70, 84, 96))
             for i, length in enumerate((12, 8, 12, 8))]
    return outer, b.run(INNER, skins)


def _doors(world, building, outer, inner):
    door = f.room_door("corridor_door", (132, 104, 74))
    rooms = 101
    for wall, spots in ((outer[0], (1.7, 4.4)), (outer[4], (1.6, 4.3)), (outer[5], (1.8, 4.4, 7.0, 9.6)),
                        (outer[6], (1.9, 4.5, 7.1, 9.7, 13.2)), (outer[7], (2.2, 4.8, 7.4, 10.0)),
                        (inner[0], (1.4, 4.0, 6.6, 9.9)), (inner[1], (1.6, 4.2, 6.4)),
                        (inner[2], (1.5, 4.1, 7.4, 10.2)), (inner[3], (1.6, 4.0, 6.5))):
        for s in spots:
            world.against(wall, s, door, 0.0)
            building.hang(wall, s + 0.72, 1.5, 0.22, 0.14,
                          building.swatch(0.22, 0.14, _plate, str(rooms), resolution=160))
            rooms += 1


def _plate(view, _rng, words):
    view.fill(look.WHITE)
    view.label(3, 4, view.width - 4, view.height - 6, words, look.DARK)


def _pictures(b, outer, inner):
    b.gallery(outer[0], ((3.0, 1.2, 0.7, 1.0), (5.7, 1.3, 0.6, 0.8)))
    b.gallery(outer[4], ((3.0, 1.2, 0.8, 0.6), (5.6, 1.2, 0.7, 1.0)))
    b.gallery(outer[5], ((3.1, 1.2, 0.7, 1.0), (8.3, 1.1, 0.9, 1.2)))
    b.gallery(outer[6], ((5.8, 1.2, 0.7, 1.0), (11.5, 1.0, 1.1, 1.3)))
    b.gallery(outer[7], ((3.5, 1.1, 0.7, 1.0), (8.7, 1.2, 0.6, 0.9)))
    b.gallery(inner[0], ((8.3, 1.3, 0.9, 0.7),))
    b.gallery(inner[1], ((2.9, 1.2, 0.7, 1.0),))
    b.gallery(inner[2], ((2.8, 1.2, 0.7, 1.0), (5.7, 1.1, 1.0, 1.3), (8.8, 1.3, 0.6, 0.8)))
    b.gallery(inner[3], ((5.2, 1.2, 0.8, 1.1),))
    b.hang(outer[2], 1.5, 0.95, 2.2, 1.3, b.swatch(2.2, 1.3, look.outdoors), 0.02)
    b.hang(outer[6], 3.2, 0.95, 1.2, 1.2, b.swatch(1.2, 1.2, look.outdoors), 0.02)
    b.hang(outer[7], 6.1, 0.95, 1.2, 1.2, b.swatch(1.2, 1.2, look.outdoors), 0.02)
    b.hang(outer[1], 1.0, 0.9, 1.4, 1.2, b.swatch(1.4, 1.2, look.papers, (70, 100, 120)), 0.02)


def _furniture(world, outer, inner):
    bottle = f.extinguisher("corridor_extinguisher")
    for wall, s in ((outer[0], 0.6), (outer[5], 5.7), (outer[6], 8.4), (inner[3], 0.7), (inner[1], 7.5)):
        world.against(wall, s, bottle)
    world.against(outer[2], 1.5, f.sofa("corridor_sofa", 1.7, (60, 90, 120)))
    world.add(f.plant("corridor_plant", 1.5), 6.9, 13.6)
    world.add(f.plant("corridor_plant_small", 1.1, (70, 120, 40)), 15.6, 0.4)
    world.against(outer[7], 0.8, f.file_cabinet("corridor_files", colour=(96, 112, 120)))
    world.against(outer[6], 14.9, f.cupboard("corridor_cupboard", 1.0, 1.8, 0.4, (150, 120, 90)))
    world.against(outer[4], 5.6, f.bench("corridor_bench"))
    world.against(inner[0], 5.3, f.notice_board("corridor_notices", 1.4))
    world.against(outer[5], 8.3, f.appliance("corridor_vending", 0.9, 0.5, 1.8, (50, 60, 130), look.goods))
    world.add(f.bin_("corridor_bin", (70, 80, 70)), 0.35, 11.6)
