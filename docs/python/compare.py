"""Compares two settings, and a filter written in numpy after one of them.

Run by ./lab python docs/python/compare.py, or cell by cell (# %%) in an editor or a notebook. Prints a
table and writes a figure: the error over time, and the images beside the reference.
"""

# %% What is compared
import sys
import time

import matplotlib

matplotlib.use("Agg")  # writes files; leave this out in a notebook
import matplotlib.pyplot as plt
import numpy as np
import restlab

SCENE = dict(scene="door-ajar", width=192, height=108)
SETTINGS = {
    "path + accumulate": dict(integrator="path", denoiser="accumulate"),
    "ReSTIR GI + accumulate": dict(integrator="restir_gi", denoiser="accumulate"),
}
FILTERED = "ReSTIR GI + accumulate"  # the filter stands after this one
FRAMES, SEEDS = 32, (1, 2, 3)
FIGURE = sys.argv[1] if len(sys.argv) > 1 else "compare.png"

reference = restlab.reference(**SCENE, spp=512, seed=1000)  # later calls go on from the user's cache


# %% A denoiser in numpy
def cross_bilateral(image, normal, depth, radius=2):
    """Averages pixels of 5x5 that show a like surface, and are not much brighter or darker."""
    height, width, _ = image.shape
    pad = [(radius, radius), (radius, radius), (0, 0)]
    bright = np.log1p(image.mean(axis=2, keepdims=True))
    images, normals, depths, brights = (np.pad(a, pad, mode="edge") for a in (image, normal, depth, bright))
    total, weights = np.zeros_like(image), np.zeros((height, width, 1), np.float32)
    for y in range(2 * radius + 1):
        for x in range(2 * radius + 1):
            at = np.s_[y : y + height, x : x + width]
            turn = np.clip((normals[at] * normal).sum(axis=2, keepdims=True), 0, 1) ** 32
            apart = np.abs(depths[at][..., :1] - depth[..., :1]) / (0.02 * depth[..., :1] + 1e-6)
            lit = np.abs(brights[at] - bright) / 0.5
            weight = turn * np.exp(-apart - lit)
            total += weight * images[at]
            weights += weight
    return np.where(weights > 0, total / np.maximum(weights, 1e-6), image).astype(np.float32)


# %% Frames, their times and errors
def measure(settings, filtered):
    """Errors by seed and frame, time so far in ms, the last image; filtered: the filter after it."""
    errors, times, image = [], [], None
    for seed in SEEDS:
        session = restlab.Session(**SCENE, **settings, seed=seed)
        session.frame()  # the first frame of a process reads what later ones find in memory
        session.reset(seed)
        row, spent, of_filter = [], [], 0.0
        for _ in range(FRAMES):
            session.frame()
            image = session.radiance()
            if filtered:
                normal, depth = session.aov("normalW"), session.aov("depth")
                start = time.perf_counter()
                image = cross_bilateral(image, normal, depth)
                of_filter = 1e3 * (time.perf_counter() - start)  # of this frame's image alone
            row.append(restlab.metrics(image, reference, ["mse", "relmse_e1e-2", "energy_ratio"]))
            spent.append(session.time_ms + of_filter)
        errors.append({name: [one[name] for one in row] for name in row[0]})
        times.append(spent)
    mean = {name: np.mean([run[name] for run in errors], axis=0) for name in errors[0]}
    return dict(mean=mean, runs=errors, time_ms=np.mean(times, axis=0), image=image)


measured = {name: measure(settings, False) for name, settings in SETTINGS.items()}
measured[FILTERED + ", numpy filter"] = measure(SETTINGS[FILTERED], True)

# %% A table
print(f"{SCENE['scene']}, {SCENE['width']}x{SCENE['height']}, {len(SEEDS)} seeds, reference {reference.spp} spp")
print(f"{'method':40} {'ms, ' + str(FRAMES) + ' frames':>14} {'relMSE, frame 1':>16} {'frame ' + str(FRAMES):>10} {'energy':>8}")
for name, of in measured.items():
    relmse = of["mean"]["relmse_e1e-2"]
    print(f"{name:40} {of['time_ms'][-1]:14.0f} {relmse[0]:16.4g} {relmse[-1]:10.4g} {of['mean']['energy_ratio'][-1]:8.4f}")


# %% A figure: the error over time, and images
def shown(image):
    """sRGB of radiance, at an exposure that leaves one pixel in a hundred clipped."""
    exposed = np.clip(image * (0.9 / np.quantile(reference.mean.max(axis=2), 0.99)), 0, 1)
    return np.where(exposed <= 0.0031308, 12.92 * exposed, 1.055 * exposed ** (1 / 2.4) - 0.055)


names = list(measured) + ["reference"]
figure = plt.figure(figsize=(13, 7), layout="constrained")
above, below = figure.subfigures(2, 1, height_ratios=(1.5, 1))
plot = above.subplots()
for name, of in measured.items():
    runs = np.array([run["relmse_e1e-2"] for run in of["runs"]])
    (line,) = plot.loglog(of["time_ms"], of["mean"]["relmse_e1e-2"], label=name)
    plot.fill_between(of["time_ms"], runs.min(axis=0), runs.max(axis=0), color=line.get_color(), alpha=0.2)
plot.set(xlabel="time since the history began (ms)", ylabel="relMSE (relmse_e1e-2)")
plot.set_title(f"{SCENE['scene']}: error over {FRAMES} frames; bands hold {len(SEEDS)} seeds")
plot.grid(True, which="both", alpha=0.3)
plot.legend()
for axes, name in zip(below.subplots(1, len(names)), names):
    image = reference.mean if name == "reference" else measured[name]["image"]
    axes.imshow(shown(image), interpolation="nearest")
    axes.set_title(name if name == "reference" else f"{name}\n" f"frame {FRAMES}", fontsize=8)
    axes.axis("off")
figure.savefig(FIGURE, dpi=100)
print(f"{FIGURE}: written")
