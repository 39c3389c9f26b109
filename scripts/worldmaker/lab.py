# SPDX-License-Identifier: GPL-3.0-or-later
"""A robotics laboratory of 12 x 10 m: desks along the walls, shelves, and a study table in the middle."""

from . import furniture as f
from . import surfaces as look
from .building import Building, painted
from .world import World

WIDTH, DEPTH, HEIGHT = 12.0, 10.0, 2.8
WARM, COOL = (0.5, 0.48, 0.43), (0.44, 0.47, 0.5)


def make():
    world = World("lab", (2.6, 4.6))
    north, east, south, west = _building(world)
    _north(world, north)
    _east(world, east)
    _south(world, south)
    _west(world, west)
    _middle(world)
    for i, (x, y) in enumerate(((2.2, 2.4), (6.0, 2.2), (10.0, 2.4), (2.2, 7.4), (6.2, 7.6), (10.0, 7.4))):
        world.lamp("lamp_%d" % (i + 1), x, y, HEIGHT - 0.25, WARM if i % 2 else COOL)
    return world


def _building(world):
    b = Building("lab_building", HEIGHT)
    corners = [(0, DEPTH), (WIDTH, DEPTH), (WIDTH, 0), (0, 0)]
    skins = [b.paint("lab_wall_north", WIDTH, painted, (196, 190, 172)),
             b.paint("lab_wall_east", DEPTH, painted, (126, 146, 160), 0.8, 1.08),
             b.paint("lab_wall_south", WIDTH, painted, (214, 186, 138), 0.84, 1.05),
             b.paint("lab_wall_west", DEPTH, painted, (158, 174, 142), 0.8, 1.06)]
    walls = b.run(corners, skins)
    b.floor(0, 0, WIDTH, DEPTH, b.picture("lab_floor", 1024, 852, look.lino, (128, 124, 116), 51))
    b.ceiling(0, 0, WIDTH, DEPTH, b.picture("lab_ceiling", 512, 426, look.ceiling, (205, 204, 198), 25))
    b.slab(-0.1, -0.1, WIDTH + 0.1, DEPTH + 0.1)
    for x, y in ((2.2, 2.4), (6.0, 2.2), (10.0, 2.4), (2.2, 7.4), (6.2, 7.6), (10.0, 7.4)):
        b.lamp(x, y, 1.3, 0.32)
    _windows_and_pictures(b, walls)
    b.floor(3.3, 3.0, 5.0, 5.4, b.swatch(1.7, 2.4, look.rug, resolution=70), 0.004)
    b.floor(8.7, 6.6, 10.6, 8.0, b.swatch(1.9, 1.4, look.rug, resolution=70), 0.004)
    b.shelf_box(walls[0], 3.45, 2.3, 0.3, 0.5, 0.3, b.swatch(0.3, 0.5, look.metal, look.STEEL), solid=False)
    world.add(b)
    return walls


def _windows_and_pictures(b, walls):
    north, east, south, west = walls
    for s, width in ((2.2, 1.7), (5.6, 2.0), (9.4, 1.5)):
        b.hang(north, s, 0.95, width, 1.5, b.swatch(width, 1.5, look.outdoors), 0.02)
    for s, width, colour in ((1.15, 0.5, (150, 60, 50)), (3.3, 0.5, (150, 60, 50)), (6.9, 0.6, (60, 80, 120)),
                             (10.4, 0.5, (70, 110, 80))):
        b.hang(north, s, 0.8, width, 1.8, b.swatch(width, 1.8, look.curtain, colour, resolution=60), 0.05)
    b.gallery(north, ((7.6, 1.3, 0.5, 0.7), (11.3, 1.2, 0.7, 1.0)))
    b.gallery(east, ((0.5, 1.2, 0.6, 0.9), (6.6, 1.1, 0.9, 1.3), (7.7, 1.4, 0.6, 0.8), (9.4, 1.0, 0.8, 1.1)))
    b.gallery(south, ((0.9, 1.3, 0.7, 1.0), (4.5, 1.35, 0.6, 0.8), (5.4, 1.5, 0.9, 0.6), (6.6, 1.3, 0.7, 1.0),
                      (8.2, 1.4, 0.8, 1.1), (9.6, 1.3, 0.6, 0.9), (11.0, 1.2, 1.0, 1.3)))
    b.gallery(west, ((0.8, 1.3, 0.8, 1.1), (6.3, 1.3, 0.5, 0.7), (9.4, 1.2, 0.7, 1.0)))
    b.hang(south, 2.6, 1.0, 1.8, 1.2, b.swatch(1.8, 1.2, look.papers), 0.02)
    b.hang(west, 2.6, 0.95, 2.2, 1.25, b.swatch(2.2, 1.25, look.whiteboard), 0.03)
    b.hang(west, 5.2, 0.0, 1.0, 2.1, b.swatch(1.0, 2.1, look.door, (120, 76, 52), "LAB217"), 0.03)
    b.hang(east, 8.55, 1.75, 0.4, 0.4, b.swatch(0.4, 0.4, _clock), 0.03)


def _clock(view, _rng):
    view.fill((126, 146, 160))
    r = view.width / 2 - 1
    view.ellipse(r, r, r, r, look.DARK)
    view.ellipse(r, r, r - 3, r - 3, look.WHITE)
    view.line(r, r, r + r * 0.5, r - r * 0.2, look.DARK, 2)
    view.line(r, r, r - r * 0.2, r - r * 0.75, look.DARK)


def _north(world, wall):
    world.against(wall, 1.0, f.cupboard("lab_cupboard", 1.2, 1.9, 0.5, (188, 176, 150), 2))
    for i, (s, knee, screens) in enumerate(((5.1, True, (0, 2)), (6.7, True, (1,)), (8.3, False, (0,)))):
        world.against(wall, s, f.desk("lab_desk_north_%d" % i, colour=(look.BEECH, look.PINE, look.OAK)[i],
                                      knee=knee, screens=screens))
    for s, out, colour in ((5.1, 0.54, (40, 60, 110)), (6.75, 0.72, (110, 40, 40))):
        x, y, _ = wall.at(s, 0, out)
        world.add(f.swivel_chair("lab_chair_%02x" % colour[0], colour), x, y, wall.yaw() + 6)
    shelf = f.bookshelf("lab_shelf_low", 1.2, 1.25, 0.4, look.PINE, 3)
    for s in (0.62, 1.84):
        world.add(shelf if s < 1 else f.bookshelf("lab_shelf_low_2", 1.2, 1.35, 0.4, look.WALNUT, 3),
                  3.4, DEPTH - s, 90)
    for s in (0.62, 1.84):
        world.add(f.cupboard("lab_sideboard", 1.2, 1.1, 0.4, (150, 160, 170), 3), 3.4, DEPTH - s, -90)
    world.add(f.plant("lab_plant", 1.6), 11.5, 9.5)


def _east(world, wall):
    for i, (s, height, colour) in enumerate(((2.0, 2.0, look.OAK), (2.95, 2.1, look.WALNUT),
                                             (3.9, 1.8, look.OAK), (4.85, 2.0, look.BEECH))):
        world.against(wall, s, f.bookshelf("lab_shelf_%d" % i, height=height, colour=colour))
    world.against(wall, 6.9, f.desk("lab_desk_east", 1.8, 0.75, look.OAK, False, (0, 2)))
    world.against(wall, 8.3, f.appliance("lab_copier", 0.65, 0.6, 1.05, (205, 205, 200), look.drawers,
                                         (200, 202, 205), 3))
    world.against(wall, 9.35, f.cartons("lab_cartons", 2))


def _south(world, wall):
    for i, (s, knee, screens) in enumerate(((4.4, True, (1,)), (6.0, False, (0, 2)), (7.6, True, (0, 1)),
                                            (9.2, True, (2,)))):
        world.against(wall, s, f.desk("lab_desk_south_%d" % i, knee=knee, screens=screens,
                                      colour=(look.OAK, (190, 190, 186), look.BEECH, look.WALNUT)[i]))
    for s, turn, colour in ((4.4, -8, (30, 100, 80)), (7.65, 5, (30, 100, 80)), (9.2, 12, (60, 60, 62))):
        x, y, _ = wall.at(s, 0, 0.54)
        world.add(f.swivel_chair("lab_chair_%d" % int(s), colour), x, y, wall.yaw() + turn)
    for s, colour in ((0.4, look.STEEL), (0.9, (90, 110, 90)), (1.4, look.STEEL)):
        world.against(wall, s, f.file_cabinet("lab_files_%d" % int(10 * s), colour=colour))
    world.add(f.cupboard("lab_tool_cupboard", 1.4, 1.5, 0.5, (60, 84, 120), 3), 8.95, 1.72, 90)
    world.add(f.bookshelf("lab_shelf_tools", 1.4, 1.55, 0.4, look.STEEL, 4), 8.93, 1.72, -90)


def _west(world, wall):
    for i, s in enumerate((7.2, 7.7, 8.2)):
        world.against(wall, s, f.file_cabinet("lab_files_west_%d" % i, height=(1.32, 1.05, 1.32)[i],
                                              colour=((150, 140, 110), look.STEEL, (70, 74, 80))[i]))
    world.against(wall, 2.6, f.counter_block("lab_bench", 2.2, 0.6, 0.86, (176, 168, 150), look.drawers))
    world.add(f.bin_("lab_bin", (60, 110, 140)), 0.35, 3.95)


def _middle(world):
    x, y = 6.6, 5.1
    world.add(f.study_table("lab_table"), x, y)
    for dx, colour in ((-0.78, look.OAK), (0.02, look.WALNUT), (0.8, look.OAK)):
        chair = f.wooden_chair("lab_wooden_chair_%02x" % colour[0], colour)
        world.add(chair, x + dx, y + 0.66, 4)
        world.add(chair, x + dx + 0.03, y - 0.66, 176)
    world.add(f.pillar("lab_pillar"), 9.75, 5.0)
    world.add(f.stool("lab_stool", (160, 70, 40)), 8.35, 5.9, 20)
