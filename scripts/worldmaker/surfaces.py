# SPDX-License-Identifier: GPL-3.0-or-later
"""Painters: each fills a view with something one finds in a building."""

from .canvas import Noise, scaled

OAK, BEECH, WALNUT, PINE = (176, 130, 82), (205, 165, 115), (98, 66, 44), (222, 190, 140)
STEEL, DARK, WHITE = (120, 124, 130), (38, 40, 44), (235, 235, 230)
WORDS = ("ROBOT MAP VISION HOME LOOP PATH SCAN LASER MIRROR NODE EDGE COMPASS SIFT WARP SNAPSHOT ANT "
         "BEE FIELD SPACE LIGHT CAMERA SERVO DRIVE GRAPH PLACE SEARCH ROUTE MOTION").split()
NOTES = (WHITE, (240, 225, 130), (200, 225, 240), (235, 190, 190))
BRIGHT = ((200, 40, 40), (40, 90, 180), (235, 190, 40), (50, 140, 70), (230, 120, 40), (120, 60, 140),
          (30, 150, 160), (170, 120, 60), (40, 40, 45))


def plain(view, _rng, colour):
    view.fill(colour)


def wood(view, rng, colour):
    view.fill(colour)
    for y in range(view.height):
        view.rect(0, y, view.width, y + 1, scaled(colour, 0.94 + 0.03 * rng.integer(0, 4)))
    for _ in range(view.width * view.height // 250 + 2):
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        view.rect(x, y, x + rng.integer(6, 40), y + 1, scaled(colour, rng.pick((0.8, 0.87, 1.08))))


def metal(view, rng, colour):
    view.fill(colour)
    view.shade(Noise(rng, view.width, view.height, 24), 0.88, 1.1)
    for _ in range(view.width * view.height // 900):
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        view.line(x, y, x + rng.integer(-6, 6), y + rng.integer(-3, 8), scaled(colour, 0.8))


def fabric(view, rng, colour):
    view.fill(colour)
    for _ in range(view.width * view.height // 60):
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        view.rect(x, y, x + 2, y + 1, scaled(colour, rng.uniform(0.75, 1.2)))
    if rng.chance(0.5):
        for x in range(rng.integer(2, 8), view.width, rng.integer(9, 16)):
            view.rect(x, 0, x + 2, view.height, scaled(colour, 0.7))


def lines_of_text(view, rng, x0, y0, x1, y1, colour, pitch=4):
    y = y0
    while y < y1 - 1:
        x = x0
        end = x1 if rng.chance(0.8) else rng.uniform(x0 + (x1 - x0) * 0.3, x1)
        while x < end:
            word = rng.integer(2, 9)
            view.rect(x, y, min(end, x + word), y + max(1, pitch // 2), colour)
            x += word + 2
        y += pitch


def _landscape(view, rng):
    top, low = rng.colour(90, 230), rng.colour(120, 240)
    for y in range(view.height):
        t = min(1.0, 1.7 * y / view.height)
        view.rect(0, y, view.width, y + 1, [a + (b - a) * t for a, b in zip(top, low)])
    if rng.chance(0.6):
        r = view.height * rng.uniform(0.05, 0.12)
        view.ellipse(view.width * rng.uniform(0.2, 0.8), view.height * 0.25, r, r, (250, 235, 170))
    for layer in range(3):
        colour, ridge = rng.colour(20, 150), view.height * (0.45 + 0.15 * layer)
        step = rng.uniform(-0.4, 0.4)
        for x in range(view.width):
            step = 0.97 * step + rng.uniform(-0.25, 0.25)
            ridge = min(view.height * 0.92, max(view.height * 0.25, ridge + step))
            view.rect(x, ridge, x + 1, view.height, colour)


def _geometry(view, rng):
    view.fill(rng.pick(BRIGHT))
    for _ in range(rng.integer(8, 16)):
        x, y = rng.uniform(0, view.width), rng.uniform(0, view.height)
        a, b = rng.uniform(4, view.width / 3), rng.uniform(4, view.height / 3)
        colour = rng.near(rng.pick(BRIGHT), 20)
        if rng.chance(0.5):
            view.rect(x - a / 2, y - b / 2, x + a / 2, y + b / 2, colour)
        else:
            view.ellipse(x, y, a / 2, a / 2, colour)


def _paper(view, rng):
    view.fill(rng.pick((WHITE, (240, 235, 210), (215, 228, 240))))
    head, w, h = rng.pick(BRIGHT), view.width, view.height
    view.rect(0, 0, w, h * 0.17, head)
    view.label(3, h * 0.04, w - 6, h * 0.12, rng.pick(WORDS), WHITE)
    for column in range(2):
        x0, x1 = w * (0.06 + 0.47 * column), w * (0.47 + 0.47 * column)
        y = h * 0.22
        while y < h * 0.9:
            tall = h * rng.uniform(0.1, 0.24)
            if rng.chance(0.45):
                _plot(view.view(x0, y, x1 - x0, min(tall, h * 0.95 - y)), rng)
            else:
                lines_of_text(view, rng, x0, y, x1, min(y + tall, h * 0.95), (70, 70, 75))
            y += tall + 4


def _plot(view, rng):
    view.fill(rng.near((225, 225, 225), 20))
    for _ in range(rng.integer(1, 3)):
        colour, y = rng.pick(BRIGHT), view.height * rng.uniform(0.2, 0.8)
        if rng.chance(0.4):
            for x in range(3, view.width - 3, 6):
                view.rect(x, view.height * rng.uniform(0.15, 0.9), x + 4, view.height - 2, colour)
        for x in range(2, view.width - 2):
            y = min(view.height - 3, max(2, y + rng.uniform(-2, 2)))
            view.rect(x, y, x + 1, y + 2, colour)
    view.frame(0, 0, view.width, view.height, (60, 60, 60))


def poster(view, rng):
    kind = rng.integer(0, 3)
    if kind == 0:
        _landscape(view, rng)
    elif kind == 1:
        _geometry(view, rng)
    else:
        _paper(view, rng)
    if kind < 2:
        view.rect(0, view.height * 0.86, view.width, view.height, rng.pick((DARK, WHITE)))
        view.label(4, view.height * 0.88, view.width - 8, view.height * 0.1, rng.pick(WORDS),
                   rng.pick(BRIGHT[:5]))
    view.frame(0, 0, view.width, view.height, rng.pick((DARK, WHITE, OAK, STEEL)), 2)


def papers(view, rng, board=(170, 125, 80)):
    """A pin board."""
    view.fill(board)
    view.speckle(rng, 0.03, (scaled(board, 0.85), scaled(board, 1.12)))
    for _ in range(view.width * view.height // 900):
        w, h = rng.integer(14, 34), rng.integer(14, 40)
        x, y = rng.integer(2, max(3, view.width - w)), rng.integer(2, max(3, view.height - h))
        view.rect(x, y, x + w, y + h, rng.pick(NOTES))
        if rng.chance(0.3):
            _plot(view.view(x + 2, y + 2, w - 4, h - 4), rng)
        else:
            lines_of_text(view, rng, x + 2, y + 4, x + w - 2, y + h - 2, (60, 60, 70), 3)
        view.rect(x + w // 2, y, x + w // 2 + 2, y + 2, rng.pick(BRIGHT))
    view.frame(0, 0, view.width, view.height, OAK, 3)


def whiteboard(view, rng):
    view.fill((242, 243, 245))
    pens = ((30, 40, 150), (180, 30, 30), (20, 120, 60), (30, 30, 30))
    for _ in range(view.width // 10):
        x, y = rng.uniform(4, view.width * 0.8), rng.uniform(6, view.height * 0.7)
        pen, kind = rng.pick(pens), rng.integer(0, 3)
        if kind == 0:
            view.text(x, y, rng.pick(WORDS), pen, rng.integer(1, 2))
        elif kind == 1:
            lines_of_text(view, rng, x, y, x + rng.uniform(30, 70), y + rng.uniform(8, 24), pen, 5)
        elif kind == 2:
            for _ in range(4):
                x2, y2 = x + rng.uniform(-25, 30), y + rng.uniform(-15, 25)
                view.line(x, y, x2, y2, pen)
                view.ellipse(x2, y2, 2, 2, pen)
                x, y = x2, y2
        else:
            view.frame(x, y, x + rng.uniform(14, 40), y + rng.uniform(10, 24), pen)
    view.ellipse(view.width * 0.55, view.height * 0.5, view.width * 0.07, view.height * 0.1, (228, 230, 236))
    view.frame(0, 0, view.width, view.height, (150, 152, 156), 3)


def books(view, rng, back=(50, 38, 28)):
    """One shelf of spines."""
    view.fill(back)
    x = rng.integer(0, 3)
    while x < view.width - 2:
        if rng.chance(0.06):
            x += rng.integer(5, 18)
            continue
        wide, tall = rng.integer(3, 9), view.height * rng.uniform(0.62, 0.97)
        colour, top = rng.near(rng.pick(BRIGHT), 35), view.height - tall
        view.rect(x, top, min(view.width, x + wide), view.height, colour)
        if rng.chance(0.7):
            y = top + tall * rng.uniform(0.1, 0.5)
            view.rect(x, y, min(view.width, x + wide), y + tall * rng.uniform(0.06, 0.25),
                      rng.pick((WHITE, (240, 210, 90), DARK)))
        view.rect(x + wide - 1, top, min(view.width, x + wide), view.height, scaled(colour, 0.55))
        x += wide


def goods(view, rng):
    """A vending machine."""
    view.fill((30, 36, 70))
    w, h = view.width, view.height
    for i in range(5):
        y = h * (0.1 + 0.14 * i)
        books(view.view(w * 0.08, y, w * 0.62, h * 0.12), rng, (200, 200, 205))
    view.rect(w * 0.76, h * 0.3, w * 0.92, h * 0.5, STEEL)
    for i in range(6):
        view.rect(w * (0.78 + 0.07 * (i % 2)), h * (0.32 + 0.05 * (i // 2)),
                  w * (0.82 + 0.07 * (i % 2)), h * (0.35 + 0.05 * (i // 2)), WHITE)
    view.rect(w * 0.1, h * 0.84, w * 0.68, h * 0.93, DARK)


def screen(view, rng):
    view.fill(rng.pick(((25, 60, 110), (20, 22, 26), (60, 110, 90), (90, 60, 100))))
    for _ in range(rng.integer(2, 4)):
        w, h = view.width * rng.uniform(0.3, 0.65), view.height * rng.uniform(0.3, 0.7)
        x, y = rng.uniform(2, view.width - w), rng.uniform(2, view.height - h)
        dark = rng.chance(0.4)
        view.rect(x, y, x + w, y + h, DARK if dark else (238, 238, 240))
        view.rect(x, y, x + w, y + 4, rng.pick(BRIGHT))
        if rng.chance(0.3):
            _plot(view.view(x + 2, y + 6, w - 4, h - 8), rng)
        else:
            lines_of_text(view, rng, x + 3, y + 7, x + w - 3, y + h - 2,
                          rng.pick(((120, 220, 140), (230, 200, 120))) if dark else (60, 60, 80))
    view.frame(0, 0, view.width, view.height, (18, 18, 20), 3)


def drawers(view, rng, colour, count=4):
    metal(view, rng, colour)
    for i in range(count):
        y0, y1 = view.height * i / count, view.height * (i + 1) / count
        view.frame(1, y0 + 1, view.width - 1, y1 - 1, scaled(colour, 0.55))
        middle = view.width / 2
        view.rect(middle - 8, y0 + 6, middle + 8, y0 + 9, scaled(colour, 0.4))
        if rng.chance(0.7):
            x = rng.uniform(3, view.width * 0.5)
            view.rect(x, y0 + 12, x + 16, y0 + 20, WHITE)
            lines_of_text(view, rng, x + 2, y0 + 14, x + 14, y0 + 19, DARK, 3)
        if rng.chance(0.3):
            view.ellipse(rng.uniform(8, view.width - 8), (y0 + y1) / 2 + 4, 4, 4, rng.pick(BRIGHT))


def leaves(view, rng, colour, count=2):
    """Cupboard doors."""
    wood(view, rng, colour)
    for i in range(count):
        x0, x1 = view.width * i / count, view.width * (i + 1) / count
        view.frame(x0 + 1, 1, x1 - 1, view.height - 1, scaled(colour, 0.6))
        view.frame(x0 + 6, 6, x1 - 6, view.height - 6, scaled(colour, 0.8))
        knob = x1 - 9 if i % 2 == 0 else x0 + 5
        view.rect(knob, view.height * 0.45, knob + 3, view.height * 0.55, STEEL)
    if rng.chance(0.5):
        w = view.width * rng.uniform(0.15, 0.3)
        x, y = rng.uniform(4, view.width - w - 4), rng.uniform(4, view.height * 0.4)
        poster(view.view(x, y, w, min(w * 1.3, view.height - y - 2)), rng)


def clutter(view, rng, colour):
    """A table top with papers on it."""
    wood(view, rng, colour)
    for _ in range(view.width * view.height // 1500):
        w, h = rng.integer(12, 26), rng.integer(12, 28)
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        view.rect(x, y, x + w, y + h, rng.near(rng.pick(BRIGHT + (WHITE, WHITE, WHITE, WHITE)), 15))
        lines_of_text(view, rng, x + 2, y + 3, x + w - 2, y + h - 2, (80, 80, 90))


def carton(view, rng):
    colour = rng.near((172, 128, 84), 18)
    wood(view, rng, colour)
    view.rect(view.width * 0.44, 0, view.width * 0.56, view.height, (205, 180, 140))
    if rng.chance(0.7):
        view.label(4, view.height * 0.3, view.width - 8, view.height * 0.25, rng.pick(WORDS), DARK)
    if rng.chance(0.6):
        x = rng.uniform(2, view.width * 0.5)
        view.rect(x, view.height * 0.6, x + view.width * 0.35, view.height * 0.88, WHITE)
        lines_of_text(view, rng, x + 2, view.height * 0.64, x + view.width * 0.33,
                      view.height * 0.86, DARK, 3)


def outdoors(view, rng):
    """A window: sky, houses and trees behind a frame, and perhaps a blind."""
    for y in range(view.height):
        t = y / view.height
        view.rect(0, y, view.width, y + 1, (150 + 80 * t, 190 + 45 * t, 235))
    base = view.height * rng.uniform(0.55, 0.75)
    x = -10
    while x < view.width:
        w, h = rng.integer(20, 60), view.height * rng.uniform(0.15, 0.45)
        wall = rng.near(rng.pick(((180, 120, 100), (200, 190, 170), (140, 140, 150))), 20)
        view.rect(x, base - h, x + w, base, wall)
        for wx in range(x + 4, x + w - 5, 9):
            for wy in range(int(base - h) + 5, int(base) - 6, 11):
                view.rect(wx, wy, wx + 5, wy + 7, rng.pick(((70, 80, 100), (220, 215, 160))))
        x += w + rng.integer(0, 25)
    view.rect(0, base, view.width, view.height, (95, 140, 70))
    for _ in range(view.width // 14):
        r = rng.uniform(5, 14)
        view.ellipse(rng.uniform(0, view.width), base + rng.uniform(-8, 12), r, r,
                     rng.near((60, 110, 50), 22))
    if rng.chance(0.6):
        for y in range(0, int(view.height * rng.uniform(0.15, 0.45)), 4):
            view.rect(0, y, view.width, y + 3, (228, 222, 205))
    for x in (0, view.width // 2 - 2, view.width - 4):
        view.rect(x, 0, x + 4, view.height, (242, 242, 240))
    view.frame(0, 0, view.width, view.height, (236, 236, 232), 5)


def curtain(view, rng, colour):
    for x in range(view.width):
        fold = 0.75 + 0.08 * (abs((x * 3) % 26 - 13) // 3)
        view.rect(x, 0, x + 1, view.height, scaled(colour, fold))
    for _ in range(view.width * view.height // 300):
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        view.ellipse(x, y, 2, 2, scaled(colour, 0.6))


def door(view, rng, colour, sign):
    wood(view, rng, colour)
    w, h = view.width, view.height
    view.frame(0, 0, w, h, scaled(colour, 0.45), 3)
    view.rect(0, h * 0.88, w, h, STEEL)
    view.rect(w * 0.82, h * 0.5, w * 0.94, h * 0.52, (210, 210, 205))
    view.rect(w * 0.86, h * 0.5, w * 0.9, h * 0.56, (190, 190, 185))
    if sign:
        view.rect(w * 0.2, h * 0.18, w * 0.8, h * 0.27, WHITE)
        view.label(w * 0.23, h * 0.2, w * 0.56, h * 0.06, sign, DARK)


def plaster(view, rng, colour, low=0.86, high=1.06, skirting=(90, 80, 72)):
    """Wall paint with uneven shade, stains, scratches, a skirting and a cable duct."""
    view.fill(colour)
    for _ in range(view.width // 60):
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        view.ellipse(x, y, rng.uniform(3, 16), rng.uniform(2, 9), scaled(colour, rng.uniform(0.86, 1.05)))
    for _ in range(view.width // 30):
        x, y = rng.integer(0, view.width), rng.integer(view.height // 2, view.height)
        view.line(x, y, x + rng.integer(-20, 20), y + rng.integer(-3, 3),
                  scaled(colour, rng.uniform(0.6, 0.85)))
    view.shade(Noise(rng, view.width, view.height, 90, 3), low, high, 7)
    if skirting:
        view.rect(0, view.height - 8, view.width, view.height, skirting)


def fittings(view, rng, pixels_per_metre, ducts=True):
    """Sockets, switches, cables and holes on a wall."""
    m = pixels_per_metre
    if ducts:
        y = view.height - int(rng.uniform(0.9, 1.15) * m)
        view.rect(0, y, view.width, y + 6, (214, 214, 208))
        view.rect(0, y + 6, view.width, y + 7, (150, 150, 145))
    for _ in range(max(1, int(view.width / m * 0.7))):
        x, y = rng.uniform(0, view.width), view.height - rng.pick((0.35, 1.05, 1.05)) * m
        view.rect(x, y, x + 7, y + 7, (240, 240, 236))
        view.rect(x + 2, y + 2, x + 5, y + 5, (60, 60, 60))
        if rng.chance(0.5):
            x2 = x + rng.uniform(-60, 60)
            view.line(x + 3, y + 5, x2, view.height - 12, rng.pick((DARK, (180, 170, 60), STEEL)))
    for _ in range(int(view.width / m)):
        x = rng.uniform(0, view.width)
        view.ellipse(x, view.height * rng.uniform(0.1, 0.6), 1, 1, DARK)


def lino(view, rng, colour, tile, joints=0.9):
    """A floor of tiles that are not quite alike, with wear; tile in pixels."""
    view.fill(colour)
    for y in range(0, view.height, tile):
        for x in range(0, view.width, tile):
            shade = scaled(colour, 0.93 + 0.025 * rng.integer(0, 5))
            view.rect(x, y, x + tile, y + tile, shade)
            view.rect(x, y, x + tile, y + 1, scaled(shade, joints))
            view.rect(x, y, x + 1, y + tile, scaled(shade, joints))
    view.shade(Noise(rng, view.width, view.height, 120, 3), 0.84, 1.1, 6)
    for _ in range(view.width * view.height // 2600):
        x, y = rng.integer(0, view.width), rng.integer(0, view.height)
        if rng.chance(0.5):
            view.ellipse(x, y, rng.uniform(1, 7), rng.uniform(1, 5), scaled(colour, rng.uniform(0.7, 1.15)))
        else:
            view.line(x, y, x + rng.integer(-16, 16), y + rng.integer(-16, 16), scaled(colour, 0.7))


def ceiling(view, rng, colour, tile):
    lino(view, rng, colour, tile, 0.8)
    for _ in range(view.width // 60):
        x, y = rng.integer(0, view.width // tile) * tile, rng.integer(0, view.height // tile) * tile
        for bar in range(3, tile - 3, 4):
            view.rect(x + 3, y + bar, x + tile - 3, y + bar + 2, (110, 110, 112))


def rug(view, rng):
    a, b, c = rng.pick(BRIGHT), rng.pick(BRIGHT), rng.pick(BRIGHT)
    view.fill(a)
    for inset, colour in ((4, b), (9, a), (14, c), (17, a)):
        view.rect(inset, inset, view.width - inset, view.height - inset, colour)
    for _ in range(view.width * view.height // 500):
        x, y = rng.integer(20, view.width - 20), rng.integer(20, view.height - 20)
        view.ellipse(x, y, rng.uniform(2, 7), rng.uniform(2, 7), rng.pick((b, c, WHITE)))
    view.speckle(rng, 0.03, (scaled(a, 0.8), scaled(b, 0.8)))
