# SPDX-License-Identifier: GPL-3.0-or-later
"""Small stand-ins for outside data: a world with faults that a loader must live with, a laser log."""

import gzip
import math

from . import surfaces
from .canvas import Canvas, Rng

LICENCE = "<!-- SPDX-License-Identifier: GPL-3.0-or-later -->\n"
WALLS = ((3.05, 0, 0.1, 5.2), (-3.05, 0, 0.1, 5.2), (0, 2.55, 6, 0.1), (0, -2.55, 6, 0.1))
CRATES = ((2.2, 1.6, 0.4), (-2.1, -1.7, 1.1), (1.9, -1.8, 0.0))
CORNERS = ((1, -1, 0), (1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 1), (1, 1, 1), (-1, 1, 1), (-1, -1, 1))
FACES = ((3, 0, 4, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (7, 4, 5, 6))


def files():
    """Name below data/samples -> bytes."""
    crate = Canvas(96, 96)
    surfaces.carton(crate, Rng("sample_crate"))
    result = {"sample.sdf": _world().encode(), "sample.log.gz": gzip.compress(_log().encode(), 9, mtime=0),
              "models/sample_crate/materials/textures/sample_crate.png": crate.png()}
    for name, picture in (("sample_crate", "../materials/textures/sample_crate.png"),
                          ("sample_box", "../materials/textures/no_such_picture.png"), ("sample_broken", "")):
        document = _collada(picture)
        if name == "sample_broken":
            document = document[:len(document) // 2]
        result["models/%s/model.config" % name] = _config(name).encode()
        result["models/%s/model.sdf" % name] = _model(name).encode()
        result["models/%s/meshes/%s.dae" % (name, name)] = document.encode()
    return result


def _config(name):
    return ('<?xml version="1.0"?>\n%s<model>\n  <name>%s</name>\n  <version>1.0</version>\n'
            '  <sdf version="1.6">model.sdf</sdf>\n</model>\n' % (LICENCE, name))


def _model(name):
    mesh = "<mesh><uri>model://%s/meshes/%s.dae</uri></mesh>" % (name, name)
    box = "<pose>0 0 0.3 0 0 0</pose><geometry><box><size>0.6 0.6 0.6</size></box></geometry>"
    if name == "sample_broken":
        box = "<geometry>%s</geometry>" % mesh
    return ('<?xml version="1.0"?>\n%s<sdf version="1.6">\n  <model name="%s">\n    <static>true</static>\n'
            '    <link name="link">\n      <visual name="visual"><geometry>%s</geometry></visual>\n'
            '      <collision name="collision">%s</collision>\n    </link>\n  </model>\n</sdf>\n'
            % (LICENCE, name, mesh, box))


def _source(name, rows, axes):
    numbers = " ".join("%g" % value for row in rows for value in row)
    params = "".join('<param name="%s" type="float"/>' % axis for axis in axes)
    return ('<source id="%s"><float_array id="%s-array" count="%d">%s</float_array><technique_common>'
            '<accessor source="#%s-array" count="%d" stride="%d">%s</accessor></technique_common></source>\n'
            % (name, name, len(rows) * len(axes), numbers, name, len(rows), len(axes), params))


def _collada(picture):
    """A box of 0.6 m without bottom, in centimetres as many exporters write it."""
    places = [(30 * x, 30 * y, 60 * z) for x, y, z in CORNERS]
    normals = ((0, -1, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, 0, 1))
    triangles = []
    for n, face in enumerate(FACES):
        for corner in (0, 1, 2, 0, 2, 3):
            triangles += [face[corner], n, corner]
    return ("""<?xml version="1.0" encoding="utf-8"?>
%s<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_images><image id="skin"><init_from>%s</init_from></image></library_images>
<library_effects><effect id="paint"><profile_COMMON>
<newparam sid="surface"><surface type="2D"><init_from>skin</init_from></surface></newparam>
<newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>
<technique sid="common"><lambert><diffuse><texture texture="sampler" texcoord="UVMap"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="carton"><instance_effect url="#paint"/></material></library_materials>
<library_geometries><geometry id="box"><mesh>
""" % (LICENCE, picture)
            + _source("places", places, "XYZ") + _source("normals", normals, "XYZ")
            + _source("uvs", ((0, 0), (1, 0), (1, 1), (0, 1)), "ST")
            + """<vertices id="vertices"><input semantic="POSITION" source="#places"/></vertices>
<triangles material="carton" count="%d">
<input semantic="VERTEX" source="#vertices" offset="0"/>
<input semantic="NORMAL" source="#normals" offset="1"/>
<input semantic="TEXCOORD" source="#uvs" offset="2" set="0"/><p>%s</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="node"><instance_geometry url="#box">
<bind_material><technique_common><instance_material symbol="carton" target="#carton">
<bind_vertex_input semantic="UVMap" input_semantic="TEXCOORD" input_set="0"/>
</instance_material></technique_common></bind_material></instance_geometry></node></visual_scene>
</library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
""" % (len(triangles) // 9, " ".join(map(str, triangles))))


def _world():
    parts = []
    ground = "<geometry><plane><normal>0 0 1</normal><size>8 8</size></plane></geometry>"
    for i, (x, y, wide, deep) in enumerate(WALLS):
        shape = "<geometry><box><size>%g %g 2.5</size></box></geometry>" % (wide, deep)
        tone = "%g %g %g 1" % (0.55 + 0.1 * i, 0.7 - 0.1 * i, 0.5 + 0.05 * i)
        parts.append('      <link name="wall_%d"><pose>%g %g 1.25 0 0 0</pose>\n'
                     '        <visual name="visual">%s<material><ambient>%s</ambient>'
                     "<diffuse>%s</diffuse></material></visual>\n"
                     '        <collision name="collision">%s</collision></link>\n'
                     % (i, x, y, shape, tone, tone, shape))
    places = list(zip(("sample_crate", "sample_crate", "sample_box"), CRATES))
    places.append(("sample_broken", (-2.2, 1.7, 0.0)))
    includes = "".join('    <include><name>%s_%d</name><uri>model://%s</uri>'
                       "<pose>%g %g 0 0 0 %g</pose></include>\n" % (name, i, name, x, y, yaw)
                       for i, (name, (x, y, yaw)) in enumerate(places))
    return ('<?xml version="1.0"?>\n%s<!-- A room of 6 x 5 m. sample_box names a picture that is not there; '
            "sample_broken has a mesh that no reader takes. -->\n"
            '<sdf version="1.6">\n  <world name="sample">\n'
            "    <scene><ambient>0.4 0.4 0.4 1</ambient><background>0.6 0.7 0.8 1</background></scene>\n"
            '    <light name="lamp" type="point"><pose>0 0 2.3 0 0 0</pose><diffuse>0.8 0.8 0.75 1</diffuse>'
            "<attenuation><range>10</range><constant>0.3</constant><linear>0.05</linear>"
            "<quadratic>0.1</quadratic></attenuation></light>\n"
            '    <model name="ground">\n      <static>true</static>\n      <link name="link">\n'
            '        <visual name="visual">%s<material><diffuse>0.45 0.43 0.4 1</diffuse></material>'
            "</visual>\n"
            '        <collision name="collision">%s</collision>\n      </link>\n    </model>\n'
            '    <model name="walls">\n      <static>true</static>\n%s    </model>\n%s  </world>\n</sdf>\n'
            % (LICENCE, ground, ground, "".join(parts), includes))


def _segments():
    """The sample world's outlines as a laser sees them."""
    outline = [(3, 2.5), (-3, 2.5), (-3, -2.5), (3, -2.5)]
    segments = list(zip(outline, outline[1:] + outline[:1]))
    for x, y, yaw in CRATES:
        c, s = 0.3 * math.cos(yaw), 0.3 * math.sin(yaw)
        corners = [(x + a * c - b * s, y + a * s + b * c) for a, b, _ in CORNERS[:4]]
        segments += list(zip(corners, corners[1:] + corners[:1]))
    return segments


def _range(x, y, angle, segments):
    dx, dy, best = math.cos(angle), math.sin(angle), 81.83
    for (ax, ay), (bx, by) in segments:
        ex, ey = bx - ax, by - ay
        cross = dx * ey - dy * ex
        if abs(cross) > 1e-9:
            t = ((ax - x) * ey - (ay - y) * ex) / cross
            u = ((ax - x) * dy - (ay - y) * dx) / cross
            if t > 0 and 0 <= u <= 1:
                best = min(best, t)
    return best


def _log():
    """A drive round the sample room: 20 scans of 180 readings, one a degree from -89.5 to 89.5."""
    rng, segments = Rng("sample_log"), _segments()
    lines = ["# SPDX-License-Identifier: GPL-3.0-or-later",
             "# A simulated drive, made by scripts/make-worlds.",
             "PARAM robot_frontlaser_offset 0.0 nohost 0"]
    for i in range(20):
        angle, time = 2 * math.pi * i / 20, 0.5 * i
        x, y, heading = 1.1 * math.cos(angle), 0.8 * math.sin(angle), angle + math.pi / 2
        heading = math.atan2(math.sin(heading), math.cos(heading))
        drift = 0.002 * i
        pose = "%.4f %.4f %.4f" % (x + drift, y - drift, heading)
        ranges = [_range(x, y, heading + math.radians(k - 89.5), segments) + rng.uniform(-0.01, 0.01)
                  for k in range(180)]
        lines.append("ODOM %s 0.30 0.31 0.0 %.3f sim %.3f" % (pose, time, time))
        lines.append("FLASER 180 %s %.4f %.4f %.4f %s %.3f sim %.3f"
                     % (" ".join("%.2f" % r for r in ranges), x, y, heading, pose, time, time))
    return "\n".join(lines) + "\n"
