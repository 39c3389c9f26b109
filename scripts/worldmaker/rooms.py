# SPDX-License-Identifier: GPL-3.0-or-later
"""Five rooms round a hall with a reading corner; open doorways, two of them from room to room."""

from . import furniture as f
from . import surfaces as look
from .building import Building, openings, painted
from .canvas import scaled
from .world import World

HEIGHT, LINTEL, HALF = 2.6, 2.05, 0.06
HALL = [(0, 2.2), (11.4, 2.2), (11.4, 0), (7.56, 0), (7.56, -4.0), (3.84, -4.0), (3.84, 0), (0, 0)]
ROOMS = {  # x0, y0, x1, y1, paint, floor, tile of the floor in pixels
    "bedroom": (0, 2.32, 3.72, 6.82, (150, 160, 190), (150, 116, 80), 12),
    "office": (3.84, 2.32, 7.56, 6.82, (204, 196, 160), (110, 116, 120), 48),
    "kitchen": (7.68, 2.32, 11.4, 6.82, (196, 206, 190), (176, 170, 156), 32),
    "workshop": (0, -4.62, 3.72, -0.12, (170, 168, 164), (104, 102, 98), 96),
    "parlour": (7.68, -4.62, 11.4, -0.12, (186, 130, 100), (120, 84, 56), 12)}
DOORWAYS = [(0.85, 2.2, 1.95, 2.32, LINTEL), (5.15, 2.2, 6.25, 2.32, LINTEL), 
            (9.35, 2.2, 10.45, 2.32, LINTEL),
            (2.15, -0.12, 3.25, 0, LINTEL), (8.15, -0.12, 9.25, 0, LINTEL),
            (3.72, 4.95, 3.84, 6.05, LINTEL), (3.72, -3.45, 3.84, -2.35, LINTEL)]
PIXELS = 80  # a metre of floor


def make():
    world = World("rooms", (5.7, 1.05))
    b = Building("rooms_building", HEIGHT, HALF)
    walls = {name: _room(world, b, name) for name in ROOMS}
    walls["hall"] = _hall(world, b)
    threshold = b.swatch(1.2, 0.12, look.wood, look.WALNUT)
    jamb = b.swatch(0.12, 2.05, look.wood, (214, 208, 196))
    for x0, y0, x1, y1, height in DOORWAYS:
        b.doorway(x0, y0, x1, y1, height, x1 - x0 < y1 - y0, threshold, jamb)
    b.slab(-0.1, -4.8, 11.5, 7.0)
    world.add(b)
    _bedroom(world, b, walls["bedroom"])
    _office(world, b, walls["office"])
    _kitchen(world, b, walls["kitchen"])
    _workshop(world, b, walls["workshop"])
    _parlour(world, b, walls["parlour"])
    _corner(world, b, walls["hall"])
    return world


def _run(b, name, corners, paint):
    skins = []
    for i, (p, q) in enumerate(zip(corners, corners[1:] + corners[:1])):
        length = abs(p[0] - q[0]) + abs(p[1] - q[1])
        skins.append(b.paint("%s_wall_%d" % (name, i), length, painted, scaled(paint, 1 - 0.04 * i)))
    return b.run(corners, skins, openings(corners, DOORWAYS))


def _ground(b, name, x0, y0, x1, y1, colour, tile):
    size = round((x1 - x0) * PIXELS), round((y1 - y0) * PIXELS)
    b.floor(x0, y0, x1, y1, b.picture(name + "_floor", *size, look.lino, colour, tile))
    top = b.picture(name + "_ceiling", size[0] // 2, size[1] // 2, look.plaster,
                    (212, 210, 204), 0.85, 1.0, None)
    b.ceiling(x0, y0, x1, y1, top)


def _room(world, b, name):
    x0, y0, x1, y1, paint, floor, tile = ROOMS[name]
    _ground(b, name, x0, y0, x1, y1, floor, tile)
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    b.lamp(x, y, 0.5, 0.5)
    world.lamp("lamp_" + name, x, y, HEIGHT - 0.25, (0.62, 0.6, 0.54), 9)
    return _run(b, name, [(x0, y1), (x1, y1), (x1, y0), (x0, y0)], paint)


def _hall(world, b):
    _ground(b, "hall", 0, 0, 11.4, 2.2, (130, 120, 104), 40)
    _ground(b, "corner", 3.84, -4.0, 7.56, 0, (118, 96, 72), 14)
    for i, (x, y) in enumerate(((1.9, 1.1), (5.7, 1.1), (9.5, 1.1), (5.7, -2.2))):
        b.lamp(x, y, 0.9, 0.25)
        world.lamp("lamp_hall_%d" % (i + 1), x, y, HEIGHT - 0.25, (0.42, 0.4, 0.36), 8)
    return _run(b, "hall", HALL, (206, 200, 186))


def _bedroom(world, b, walls):
    north, east, south, west = walls
    world.against(north, 0.8, f.bed("bedroom_bed"))
    world.against(north, 1.9, f.counter_block("bedroom_night_stand", 0.45, 0.4, 0.5, look.OAK))
    world.against(east, 3.5, f.cupboard("bedroom_wardrobe", 1.3, 2.0, 0.5, look.WALNUT, 3))
    world.against(west, 1.0, f.counter_block("bedroom_chest", 1.1, 0.42, 0.8, look.PINE, look.drawers))
    world.add(f.plant("bedroom_plant", 1.2), 3.4, 6.5)
    b.hang(north, 0.8, 1.2, 1.2, 0.7, b.swatch(1.2, 0.7, look.poster), 0.02)
    b.hang(west, 2.8, 0.9, 1.3, 1.3, b.swatch(1.3, 1.3, look.outdoors), 0.02)
    b.gallery(north, ((2.6, 1.2, 0.6, 0.8),))
    b.gallery(east, ((2.25, 1.2, 0.5, 0.7),))
    b.gallery(south, ((0.7, 1.1, 0.8, 1.1), (3.3, 1.3, 0.5, 0.6)))
    b.gallery(west, ((1.0, 1.3, 0.7, 0.6), (4.0, 1.2, 0.5, 0.8)))
    b.floor(1.7, 3.6, 3.1, 5.4, b.swatch(1.4, 1.8, look.rug, resolution=80), 0.004)


def _office(world, b, walls):
    north, east, south, west = walls
    world.against(north, 2.0, f.desk("office_desk", colour=look.BEECH, screens=(0, 1)))
    x, y, _ = north.at(2.0, 0, 0.6)
    world.add(f.swivel_chair("office_chair", (120, 60, 30)), x, y, north.yaw() - 7)
    for i, s in enumerate((1.4, 2.35, 3.3)):
        world.against(east, s, f.bookshelf("office_shelf_%d" % i, height=(2.0, 2.1, 1.7)[i],
                                           colour=(look.OAK, look.PINE, look.WALNUT)[i]))
    world.against(south, 3.2, f.file_cabinet("office_files", colour=(120, 110, 90)))
    world.against(west, 0.9, f.appliance("office_printer", 0.6, 0.5, 0.95, (190, 190, 186), look.drawers,
                                         look.WHITE, 3))
    b.hang(north, 2.0, 1.3, 1.7, 1.0, b.swatch(1.7, 1.0, look.papers), 0.02)
    b.gallery(west, ((0.8, 1.2, 0.7, 1.0), (4.1, 1.2, 0.7, 1.0)))
    b.gallery(south, ((0.5, 1.3, 0.6, 0.8), (2.9, 1.45, 0.7, 0.7)))
    b.gallery(north, ((3.3, 1.2, 0.5, 0.8),))


def _kitchen(world, b, walls):
    north, east, south, west = walls
    world.against(north, 1.5, f.kitchen("kitchen_units"))
    world.against(north, 3.2, f.appliance("kitchen_fridge", 0.65, 0.62, 1.75, (212, 214, 216), look.drawers,
                                          (206, 208, 210), 2))
    world.against(west, 2.3, f.counter_block("kitchen_table", 1.2, 0.8, 0.75, look.PINE))
    for s, colour in ((1.4, (150, 40, 40)), (3.2, (40, 90, 120))):
        x, y, _ = west.at(s, 0, 0.4)
        world.add(f.stool("kitchen_stool_%02x" % colour[0], colour), x, y, 8)
    world.against(east, 3.2, f.counter_block("kitchen_sideboard", 1.4, 0.45, 0.95, (120, 140, 110)))
    world.add(f.bin_("kitchen_bin", (140, 140, 60)), 11.1, 2.7)
    b.hang(east, 1.9, 1.0, 1.2, 1.2, b.swatch(1.2, 1.2, look.outdoors), 0.02)
    b.gallery(west, ((2.3, 1.2, 0.9, 0.9), (3.8, 1.4, 0.5, 0.7)))
    b.gallery(east, ((3.3, 1.3, 0.8, 0.6),))
    b.gallery(south, ((0.5, 1.3, 0.6, 0.8), (2.8, 1.1, 0.8, 1.2)))


def _workshop(world, b, walls):
    north, east, south, west = walls
    world.against(west, 2.3, f.counter_block("workshop_bench", 2.4, 0.65, 0.88, (140, 110, 70), look.drawers))
    world.against(south, 0.9, f.bookshelf("workshop_shelf", 1.2, 1.9, 0.45, look.STEEL, 4))
    world.against(south, 2.2, f.cupboard("workshop_locker", 1.2, 1.7, 0.45, (60, 90, 70), 3))
    world.against(north, 0.85, f.cartons("workshop_cartons", 2))
    world.against(east, 0.75, f.file_cabinet("workshop_drawers", 0.6, 1.1, 0.45, (150, 60, 40), 6))
    b.hang(west, 2.3, 1.2, 1.9, 0.9, b.swatch(1.9, 0.9, look.papers, (60, 64, 70)), 0.02)
    b.gallery(east, ((3.85, 1.2, 0.8, 1.1), (0.8, 1.3, 0.5, 0.7)))
    b.gallery(north, ((1.4, 1.3, 0.8, 0.9),))
    b.gallery(south, ((3.2, 1.3, 0.6, 0.9),))


def _parlour(world, b, walls):
    north, east, south, west = walls
    world.against(south, 1.8, f.sofa("parlour_sofa", 1.9, (110, 46, 60)))
    world.against(north, 2.8, f.television("parlour_television"))
    world.against(east, 2.4, f.bookshelf("parlour_shelf", 1.2, 1.9, 0.32, look.WALNUT))
    world.against(east, 3.9, f.sofa("parlour_armchair", 0.85, (70, 90, 70)))
    world.against(west, 1.6, f.counter_block("parlour_sideboard", 1.3, 0.42, 0.85, look.OAK))
    world.add(f.plant("parlour_plant", 1.7, (40, 90, 60)), 8.05, -4.2)
    b.hang(west, 3.1, 0.9, 1.2, 1.3, b.swatch(1.2, 1.3, look.outdoors), 0.02)
    b.gallery(south, ((0.8, 1.2, 0.6, 0.8), (1.9, 1.3, 1.2, 0.8), (3.1, 1.2, 0.6, 0.8)))
    b.gallery(west, ((1.5, 1.2, 0.8, 1.0),))
    b.gallery(east, ((1.0, 1.2, 0.8, 1.1),))
    b.floor(8.9, -3.6, 10.7, -1.4, b.swatch(1.8, 2.2, look.rug, resolution=80), 0.004)


def _corner(world, b, walls):
    north, east, upper_east, corner_east, south, corner_west, upper_west, west = walls
    for i, s in enumerate((0.6, 1.86, 3.12)):
        world.against(south, s, f.bookshelf("corner_shelf_%d" % i, 1.2, (1.9, 1.5, 2.0)[i], 0.32,
                                            (look.PINE, look.OAK, look.BEECH)[i]))
    world.add(f.counter_block("corner_table", 0.9, 0.9, 0.74, look.WALNUT), 5.7, -2.2)
    world.add(f.stool("corner_stool", (60, 110, 90)), 7.3, -0.5, 10)
    world.against(north, 3.6, f.bench("hall_bench", 1.3, look.WALNUT))
    world.against(north, 7.7, f.counter_block("hall_sideboard", 1.3, 0.4, 0.9, look.BEECH))
    world.against(west, 1.1, f.cupboard("hall_wardrobe", 1.5, 2.0, 0.45, (176, 150, 120), 3))
    world.against(east, 1.1, f.cartons("hall_cartons", 2))
    world.against(upper_west, 2.9, f.file_cabinet("hall_files", 0.46, 1.1, 0.45, (90, 100, 130)))
    b.gallery(north, ((2.5, 1.2, 0.7, 1.0), (3.6, 1.3, 0.9, 0.7), (7.0, 1.2, 0.6, 0.9), (8.3, 1.2, 0.8, 1.0),
                      (10.9, 1.2, 0.6, 0.9)))
    b.gallery(upper_east, ((1.2, 1.2, 0.7, 1.0), (3.55, 1.3, 0.5, 0.7)))
    b.gallery(upper_west, ((2.2, 1.2, 0.9, 0.7), (3.1, 1.3, 0.6, 0.8)))
    b.gallery(corner_east, ((1.2, 1.2, 0.8, 1.1), (2.6, 1.1, 1.0, 1.3)))
    b.gallery(corner_west, ((3.2, 1.2, 0.7, 1.0), (2.2, 1.3, 0.6, 0.8)))
    b.gallery(east, ((1.1, 1.5, 0.8, 0.6),))
