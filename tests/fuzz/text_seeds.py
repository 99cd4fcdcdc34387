"""Seeds of scene files, suites and commands."""

import json

from seed_files import write


def commands():
    camera = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1]
    write("command", "read-set", json.dumps({"do": "set", "pane": 0, "key": "mode", "value": "biased"}))
    write("command", "read-parameter", json.dumps({"do": "parameter", "pane": 1, "name": "x", "value": 0.5}))
    write("command", "read-camera", json.dumps({"do": "camera", "to_world": camera, "yfov": 0.7}))
    write("command", "read-resolution", json.dumps({"do": "resolution", "width": 640, "height": 360}))
    write("command", "read-look", json.dumps({"do": "look", "on": True, "panes": [0, 1]}))
    write("command", "read-table", json.dumps({"do": "table", "name": "cornell-box-all"}))
    write("command", "unknown", json.dumps({"do": "open", "file": "/etc/passwd"}))
    write("command", "scaled-camera", json.dumps({"do": "camera", "to_world": [2] + camera[1:]}))
    write("command", "deep", "[" * 2000)
    write("command", "bytes", bytes(range(256)))


# ---- scene files ----------------------------------------------------------------------------------


def scene_files():
    base = 'base = "cornell-box"\n'
    clay = base + '[[material]]\nname = "clay"\nkind = "oren_nayar"\ncolor = [0.7, 0.4, 0.2]\n'
    write("scene_file", "read-base.toml", base)
    write("scene_file", "read-kinds.toml", clay + "".join(
        f'[[material]]\nname = "{kind}"\nkind = "{kind}"\n'
        for kind in ("mirror", "power_lobe", "phong", "conductor", "disney", "plastic", "wax", "dielectric"))
        + '[[material]]\nname = "m"\nkind = "mixture"\nfirst = "clay"\nsecond = "mirror"\n'
        + '[[assign]]\nmaterial = "White"\nto = "m"\n[[assign]]\nmesh = "*Block"\nto = "wax"\n')
    write("scene_file", "read-lights.toml", base
          + '[[light]]\nkind = "ambient"\nradiance = 0.1\n[[light]]\nattenuation = [1.0, 0.5, 0.25]\n'
          + '[[light]]\nkind = "spot"\ndirection = [0.0, -1.0, 0.0]\n[camera]\nposition = [0.0, 1.0, 5.0]\n'
          + '[environment]\nradiance = 0.5\n[background]\nradiance = 0.0\n')
    write("scene_file", "read-settings.toml", clay + "[camera]\nyfov = 30.0\n\0material.clay.sigma=0.2&camera.yfov=60")
    write("scene_file", "read-shapes.toml", clay + '[[shape]]\nkind = "torus"\nminor = 0.5\nmaterial = "clay"\n'
          + 'instances = [{ scale = 2, material = "clay" }, { rotate = [0, 1, 0, 30], emission = 2 }]\n'
          + '[[shape]]\nkind = "plane"\nsize = 100\n[[assign]]\nmesh = "*Block"\nnormals = 30\n')
    write("scene_file", "mesh-of-nothing.toml", clay + '[[shape]]\nfile = "none.obj"\nnormals = "flat"\n')
    write("scene_file", "unknown-setting.toml", clay + "\0material.clay.sgma=0.2")
    write("scene_file", "setting-of-nothing.toml", clay + "\0&=&..")
    write("scene_file", "itself.toml", 'base = "x.scene.toml"\n')
    write("scene_file", "folder.toml", 'base = "."\n')
    write("scene_file", "control.toml", 'base = "a\\u0000b\\nc"\n')
    write("scene_file", "endless-numbers.toml", clay + "sigma = nan\n")
    write("scene_file", "part-of-itself.toml",
          base + '[[material]]\nname = "m"\nkind = "mixture"\nfirst = "m"\nsecond = "m"\n')
    write("scene_file", "table-of-a-device.toml",
          base + '[[material]]\nname = "m"\nkind = "table"\nfile = "/dev/null"\n')
    write("scene_file", "bytes.toml", bytes(range(1, 256)))


# ---- Strands --------------------------------------------------------------------------------------


def curves():
    def lines(*points):
        return "".join("{} {} {} {}\n".format(*p) for p in points)

    row = [(i, i * i * 0.1, 0, 0.1) for i in range(7)]
    # The first byte is the basis: linear, bezier, bspline, catmull-rom.
    write("curves", "read-linear.txt", b"\0" + (lines(*row[:2]) + "\n\n" + lines(*row[3:])).encode())
    write("curves", "read-bezier.txt", b"\1" + lines(*row).encode())
    write("curves", "read-bspline.txt", b"\2" + ("\n" + lines(*row)).replace("\n", " \t\r\n").encode())
    write("curves", "read-catmull-rom.txt", b"\3" + lines(*row).strip().encode())
    write("curves", "read-ball.txt", b"\0" + lines((1, 2, 3, 0.5), (1, 2, 3, 0.5)).encode())
    write("curves", "few.txt", b"\2" + lines(*row[:3]).encode())
    write("curves", "no-bezier.txt", b"\1" + lines(*row[:6]).encode())
    write("curves", "nan.txt", b"\0" + lines(row[0], ("nan", 0, 0, 1)).encode())
    write("curves", "no-radius.txt", b"\0" + lines(row[0], (1, 0, 0, 0)).encode())
    write("curves", "three-numbers.txt", b"\0" + b"0 0 0\n1 0 0\n")
    write("curves", "thin.txt", b"\0" + lines((1e8, 0, 0, 1), (1e8, 1, 0, 1)).encode())
    write("curves", "many-pieces.txt", b"\0" + lines((0, 0, 0, 1e-6), (1e9, 0, 0, 1e-6)).encode())
    write("curves", "negative-between.txt",
          b"\3" + lines((0, 0, 0, 9), (1, 0, 0, 0.1), (2, 0, 0, 0.1), (3, 0, 0, 9)).encode())
    write("curves", "nothing.txt", b"\0\n \n")
    write("curves", "bytes.txt", bytes(range(256)))


# ---- Suites ---------------------------------------------------------------------------------------


def suites():
    write("suite", "read-all.toml", """name = "all"
scenes = ["cornell-box", 'door-ajar']
[settings]
width = 32
height = 18
runs = 2
frames = 1
components = ["all", "indirect"]
accumulate = true
ages = [1, 2]
camera_path = "turn"
[reference]
spp = 4
[[camera_path]]
name = "turn"
kind = "orbit"
degrees_per_frame = 0.5
target = [0.0, 1, 0]
[[scene]]
scene = "quad-light"
camera = "0"
environment_scale = 2.5
optional = true
[[method]]
[[method]]
name = "gi"
integrator = "restir_gi"
mode = "biased"
confidence_cap = 10.0
""".replace('accumulate = true\nages = [1, 2]\ncamera_path = "turn"', 'camera_path = "turn"'))
    write("suite", "read-sweep.toml", """scenes = ["cornell-box"]
[sweep]
max_bounces = [2, 4]
"method.gi.confidence_cap" = [10.0, 20.0]
[[method]]
name = "gi"
integrator = "restir_gi"
""")
    write("suite", "read-accumulate.toml", """scenes = "cornell-box"
settings = { frames = 8, accumulate = true, ages = [1, 2], temporal = true }
method = [{}, { name = "b", integrator = "restir_gi", mode = "unbiased" }]
""")
    write("suite", "unknown-key.toml", "scenes = ['cornell-box']\nsceen = 1\n[[method]]\n")
    write("suite", "wrong-type.toml", "scenes = [1]\n[[method]]\n")
    write("suite", "no-toml.toml", "scenes = [\n")
    write("suite", "deep.toml", "a = " + "[" * 1000)
    write("suite", "deep-tables.toml", "[" + ".".join(["a"] * 1000) + "]\n")
    write("suite", "include-itself.toml", 'include = "suite.toml"\n')
    axes = "".join(f"{key} = [{', '.join(map(str, range(1, 101)))}]\n"
                   for key in ("max_bounces", "width", "height", "seed", "frames", "warmup_frames"))
    write("suite", "endless-sweep.toml", "scenes = ['cornell-box']\n[sweep]\n" + axes + "[[method]]\n")
    write("suite", "control.toml", b'scenes = ["a\\u001b[31m"]\n"\\u001b[31m\\nx" = 1\n[[method]]\n')
    write("suite", "bytes.toml", bytes(range(256)))


# ---- fields: an expression behind an e, a solid behind an s ----------------------------------------


def fields():
    write("field", "read-heart", "e(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3")
    write("field", "read-functions", "emax(abs(sin(5*x)*cos(5*y)) - exp(-z^2), min(sqrt(x^2 + 1), pi) - 1.2, -x/2)")
    write("field", "read-solid", "ssmooth_union(0.3, sphere(0.5), translate(0.5, 0, 0, rotate(0, 0, 1, 30, box(0.4, 0.3, 0.2))))")
    write("field", "read-bent", "stwist(40, difference(round(0.1, cylinder(2, 0.4)), shell(0.1, torus(0.5, 0.2))))")
    write("field", "read-waves", "sscale(2, displace(0.05, 12, smooth_difference(0.1, capsule(1, 0.4), sphere(0.3))))")
    write("field", "nothing", "e")
    write("field", "unbounded", "ey - 1/(x*z)")
    write("field", "deep", "e" + "(" * 900)
    write("field", "deep-solids", "s" + "scale(1," * 120)
    write("field", "read-powers", "e((((x^32)^32)^32)^32)^32")
    write("field", "constant", "e1 + 2*pi")
    write("field", "large", "e1e300*x + 1")
    write("field", "endless", "srepeat(1, 1, 1, sphere(0.2))")
    write("field", "bytes", bytes(range(256)))
