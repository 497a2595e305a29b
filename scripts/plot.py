#!/usr/bin/python3
"""plot.py DIR: draws a picture (PNG and PDF) from every CSV file in DIR that it knows: figure data of `alea
reproduce`, rows of `alea sweep export` named after their sweep.

One function for each kind of figure; the numbers come from the program alone. Needs Debian's
python3-matplotlib (scripts/setup figures), which serves /usr/bin/python3.
"""

import csv
import pathlib
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as error:
    sys.exit(f"plot: {error}; run scripts/setup figures and use /usr/bin/python3")

MASTER, SLAVE = "#1b6ca8", "#d1495b"
AXIS_COLOURS = {"X": "#d1495b", "Y": "#3a7d44", "Z": "#1b6ca8"}


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def save(figure, path):
    for suffix in (".png", ".pdf"):
        # The tight box of a 3-D panel forgets its last axis label: hence the margin.
        figure.savefig(path.with_suffix(suffix), dpi=150, bbox_inches="tight", pad_inches=0.3)
    plt.close(figure)


def groups(rows, name):
    """Rows by the value of a column, in the order of first appearance."""
    found = {}
    for row in rows:
        found.setdefault(row[name], []).append(row)
    return found


def plot_extraction(rows, path):
    """Figure 5: the cloud, its planes, the die among them, as the scanner sees them."""
    x, y, z = (column(rows, name) for name in ("x_m", "y_m", "z_m"))
    region = column(rows, "region").astype(int)
    facet = column(rows, "facet").astype(int)
    near = facet > 0
    figure, panels = plt.subplots(1, 3, figsize=(15, 4.6), subplot_kw={"projection": "3d"})
    thin = slice(None, None, max(1, len(x) // 25000))
    panels[0].scatter(x[thin], y[thin], z[thin], c=column(rows, "intensity")[thin], s=0.3, cmap="gray",
                      rasterized=True)
    panels[0].set_title("(a) cloud, by intensity")
    in_plane = region >= 0
    panels[1].scatter(x[in_plane][thin], y[in_plane][thin], z[in_plane][thin], c=region[in_plane][thin] % 20,
                      s=0.3, cmap="tab20", rasterized=True)
    panels[1].set_title(f"(b) planes: {region.max() + 1}")
    panels[2].scatter(x[near], y[near], z[near], c=facet[near], s=1.0, cmap="Set1", vmin=1, vmax=9)
    panels[2].set_title(f"(c) die: {near.sum()} points on three facets" if near.any() else "(c) no die found")
    for panel in panels:
        panel.set_xlabel("x (m)")
        panel.set_ylabel("y (m)")
        panel.set_zlabel("z (m)")
        panel.view_init(elev=28, azim=-50)
    for panel in panels[:2]:
        panel.set_box_aspect((np.ptp(x), np.ptp(y), np.ptp(z)))
        panel.set_zticks([0, 1, 2, 3])
    if near.any():
        panels[2].set_box_aspect((np.ptp(x[near]), np.ptp(y[near]), np.ptp(z[near])))
    save(figure, path)


def plot_pips(rows, path):
    """Figure 6: the stages of the pip chain, one row for each facet."""
    facets = groups(rows, "pips")
    stages = list(groups(rows, "stage"))
    figure, panels = plt.subplots(len(facets), len(stages), figsize=(2.6 * len(stages), 2.6 * len(facets)),
                                  squeeze=False)
    for line, (pips, of_facet) in zip(panels, facets.items()):
        for panel, stage in zip(line, stages):
            cells = [row for row in of_facet if row["stage"] == stage]
            image = np.full((1 + max(int(c["row"]) for c in cells), 1 + max(int(c["column"]) for c in cells)), np.nan)
            for cell in cells:
                image[int(cell["row"]), int(cell["column"])] = float(cell["value"])
            panel.imshow(image, origin="lower", cmap="tab10" if stage == "clusters" else "gray", interpolation="nearest")
            panel.set_xticks([])
            panel.set_yticks([])
            counted = int(np.nanmax(image)) if stage == "clusters" and np.isfinite(image).any() else 0
            plural = "pip" if counted == 1 else "pips"
            panel.set_title(f"{stage}: {counted} {plural}" if stage == "clusters" else stage, fontsize=9)
        line[0].set_ylabel(f"facet {pips}")
    save(figure, path)


def ends(row):
    return [np.array([float(row[f"{axis}{end}_m"]) for axis in "xyz"]) for end in "01"]


def draw_arrows(panel, rows, names=True):
    for row in rows:
        start, end = ends(row)
        if row["kind"] == "edge":
            panel.plot(*zip(start, end), color="0.7", lw=0.8)
            continue
        colour = AXIS_COLOURS[row["letter"]]
        panel.plot(*zip(start, end), color=colour, lw=2, ls="--" if row["kind"].startswith("U") else "-")
        if names:
            panel.text(*(start + 1.12 * (end - start)), row["letter"], color=colour, fontsize=9, ha="center")
    if not names:
        return
    for kind, of_kind in groups([row for row in rows if row["kind"] != "edge"], "kind").items():
        # Beside the corner, away from its three axes.
        start = ends(of_kind[0])[0]
        away = start - 0.3 * np.mean([ends(row)[1] - start for row in of_kind], axis=0)
        panel.text(*away, kind.split()[0] if kind[0] in "UV" else kind, fontsize=9, ha="center", va="top")


def equal_axes(panel, rows, zoom=1.0):
    points = np.array([[float(row[f"{axis}{end}_m"]) for axis in "xyz"] for row in rows for end in "01"])
    low, high = points.min(axis=0), points.max(axis=0)
    half = 0.55 * (high - low).max()
    for k, set_limits in enumerate((panel.set_xlim, panel.set_ylim, panel.set_zlim)):
        set_limits((low[k] + high[k]) / 2 - half, (low[k] + high[k]) / 2 + half)
    panel.set_box_aspect((1, 1, 1), zoom=zoom)


def plot_axes(rows, path):
    """Figures 7 and 9: axes of the two frames, one panel each."""
    panels_of = groups(rows, "panel")
    figure, panels = plt.subplots(1, len(panels_of), figsize=(6.5 * len(panels_of), 6),
                                  subplot_kw={"projection": "3d"}, squeeze=False)
    for panel, (name, of_panel) in zip(panels[0], panels_of.items()):
        if name == "b":  # the edges that the equations began with, for comparison
            draw_arrows(panel, [dict(row, kind="edge") for row in panels_of["a"]])
        draw_arrows(panel, of_panel)
        equal_axes(panel, of_panel)
        panel.set_title({"a": "(a) edges at both corners of a die with tilts of 5 deg sd",
                         "b": "(b) after equations 1 to 3 (grey: the edges)"}.get(name, name))
        panel.set_xlabel("x (m)")
        panel.set_ylabel("y (m)")
        panel.set_zlabel("z (m)")
    save(figure, path)


def plot_frames(rows, path):
    """Figure 8: the 24 frames of a die."""
    figure = plt.figure(figsize=(15, 10.5))
    for number, (name, of_panel) in enumerate(groups(rows, "panel").items(), 1):
        panel = figure.add_subplot(4, 6, number, projection="3d")
        draw_arrows(panel, of_panel, names=False)
        equal_axes(panel, of_panel, zoom=1.35)
        panel.set_axis_off()
        panel.set_title(name, fontsize=8)
    figure.subplots_adjust(left=0, right=1, bottom=0.05, top=0.97, wspace=0, hspace=0.1)
    handles = [plt.Line2D([], [], color=colour, lw=2, label=letter) for letter, colour in AXIS_COLOURS.items()]
    figure.legend(handles=handles, loc="lower center", ncol=3)
    save(figure, path)


def plot_calibration(rows, path):
    """Figure 10: RMSE of the planes against the length, one panel for each dataset."""
    datasets = groups(rows, "dataset")
    figure, panels = plt.subplots(1, len(datasets), figsize=(4.2 * len(datasets), 3.8))
    for panel, (dataset, of_dataset) in zip(np.atleast_1d(panels), datasets.items()):
        for method, of_method in groups(of_dataset, "method").items():
            for planes, curve in groups(of_method, "planes").items():
                edge, rmse = column(curve, "edge_m"), column(curve, "rmse_mm")
                colour = MASTER if method == "closed form" else SLAVE
                panel.plot(edge, rmse, color=colour, ls="-" if planes == "check planes" else "--",
                           label=f"{method}, {planes}")
                best = np.argmin(rmse)
                panel.plot(edge[best], rmse[best], "o", color=colour, ms=4)
        panel.set_title(f"dataset {dataset}")
        panel.set_xlabel("edge (m)")
        panel.set_ylabel("RMS of the planes' union RMSE (mm)")
        panel.grid(alpha=0.3)
    np.atleast_1d(panels)[0].legend(fontsize=7)
    figure.tight_layout()
    save(figure, path)


def plot_registered(rows, path):
    """Table 7: a cabinet seen from above, both scans, before and after the calibration."""
    datasets = groups(rows, "dataset")
    figure, panels = plt.subplots(2, len(datasets), figsize=(3.4 * len(datasets), 9), squeeze=False)
    for column_number, (dataset, of_dataset) in enumerate(datasets.items()):
        for panel, state in zip(panels[:, column_number], ("before", "after")):
            for scan, colour in (("master", MASTER), ("slave", SLAVE)):
                points = [row for row in of_dataset if row["state"] == state and row["scan"] == scan]
                panel.plot(column(points, "x_m"), column(points, "y_m"), ".", color=colour, ms=2, label=scan,
                           rasterized=True)
            panel.set_aspect("equal")
            panel.set_title(f"{dataset}, {state} the calibration", fontsize=10)
            panel.set_xlabel("x (m)")
            panel.set_ylabel("y (m)")
            panel.grid(alpha=0.3)
    panels[0][0].legend(markerscale=5)
    figure.tight_layout()
    save(figure, path)


def number(row, name):
    return float(row[name]) if row.get(name) else np.nan


def registered(rows):
    return [row for row in rows if row["verdict"] == "registered"]


def rms_with_interval(values):
    """Root mean square and its 95 % interval from the spread of the squares."""
    squares = np.square(values)
    mean, half = squares.mean(), 1.96 * squares.std() / np.sqrt(max(1, len(squares)))
    return np.sqrt(mean), np.sqrt(max(0.0, mean - half)), np.sqrt(mean + half)


def axis_columns(rows):
    """The axes of a sweep: the columns between the estimator and the first error."""
    names = list(rows[0])
    return names[names.index("estimator") + 1:names.index("rotation_error_rad")]


def series_of(rows, axis, measure, scale):
    """x, RMS, low, high over the numeric values of an axis."""
    found = {}
    for row in registered(rows):
        if np.isfinite(number(row, measure)):
            found.setdefault(float(row[axis]), []).append(scale * number(row, measure))
    xs = sorted(x for x in found if len(found[x]) > 1)
    return np.array(xs), np.array([rms_with_interval(found[x]) for x in xs]).reshape(len(xs), 3)


COLOURS = ["#1b6ca8", "#d1495b", "#3a7d44", "#edae49", "#6a4c93", "#e07a1f", "#8d5524", "#444444", "#e377c2",
           "#7f9c3b", "#2a2a72"]
AXIS_TITLES = {"range_noise_mm": "range noise (mm)", "edge_m": "edge of the die (m)", "range_m": "range (m)",
               "tilt_deg": "facet tilts, sd (deg)", "step_mrad": "angular step (mrad)",
               "separation_deg": "station separation (deg)", "edge_radius_mm": "edge radius (mm)",
               "bow_mm": "bow of the facets (mm)", "trim_mm": "trim (mm)", "extraction": "facets found by",
               "angle_rad": "nearness to parallel or coplanar (rad)"}
DEGREE = 180 / np.pi
MEASURES = [("rotation_error_rad", "bound_rotation_rad", DEGREE, "rotation error, RMS (deg)"),
            ("translation_error_m", "bound_translation_m", 1e3, "translation error at the die, RMS (mm)"),
            ("check_error_m", "bound_check_m", 1e3, "offset at check planes, RMS (mm)")]


def draw_bounds(panel, rows, axis, name, scale, done):
    """The bound of these rows as a line, once for each different one."""
    xs = sorted({float(row[axis]) for row in rows if np.isfinite(number(row, name))})
    ys = []
    for x in xs:
        ys.append(scale * next(number(row, name) for row in rows
                               if float(row[axis]) == x and np.isfinite(number(row, name))))
    key = tuple(np.round(ys, 12))
    if xs and key not in done:
        done.add(key)
        panel.plot(xs, ys, color="0.35", ls=[":", "--", "-.", (0, (1, 3))][(len(done) - 1) % 4], lw=1.2,
                   label=f"bound of {rows[0]['estimator'].replace('_', ' ')}", zorder=1)


LINEAR_AXES = ("separation_deg", "edge_radius_mm", "bow_mm")


def set_scale(panel, axis, rows):
    """Logarithmic, about zero linear, or linear."""
    values = sorted({float(row[axis]) for row in rows})
    if axis in LINEAR_AXES:
        return
    if values[0] > 0:
        panel.set_xscale("log")
    else:
        panel.set_xscale("symlog", linthresh=values[1])
    panel.set_xticks(values, [f"{value:g}" for value in values])
    panel.tick_params(axis="x", which="minor", bottom=False, labelbottom=False)


def legend_below(figure, panel, columns=4):
    handles, labels = panel.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=columns, fontsize=8)


def part_title(axis, value):
    return "trim estimated" if (axis, value) == ("trim_mm", "-1") else f"{AXIS_TITLES.get(axis, axis)} {value}"


def plot_error_curves(rows, path):
    """Errors against a numeric axis: RMS with 95 % intervals for each estimator, the bound as a line. Further axes
    of the sweep share the panels in rows."""
    axis, others = axis_columns(rows)[0], axis_columns(rows)[1:]
    parts = {}
    for row in rows:
        parts.setdefault(", ".join(part_title(o, row[o]) for o in others), []).append(row)
    figure, panels = plt.subplots(len(parts), 3, figsize=(14, 3.9 * len(parts)), squeeze=False)
    for line, (part, of_part) in zip(panels, parts.items()):
        for panel, (measure, bound, scale, title) in zip(line, MEASURES):
            done = set()
            for k, (name, of_name) in enumerate(groups(of_part, "estimator").items()):
                x, rms = series_of(of_name, axis, measure, scale)
                if len(x):
                    # Estimators that agree lie on each other: hollow markers of falling size show them all.
                    panel.errorbar(x, rms[:, 0], [rms[:, 0] - rms[:, 1], rms[:, 2] - rms[:, 0]],
                                   fmt="os^Dv<>p*"[k % 9] + "-", ms=max(3, 8 - 1.2 * k), mfc="none", lw=1, capsize=2,
                                   color=COLOURS[k % len(COLOURS)], label=name.replace("_", " "))
                draw_bounds(panel, of_name, axis, bound, scale, done)
            set_scale(panel, axis, of_part)
            panel.set_yscale("log")
            panel.set_xlabel(AXIS_TITLES.get(axis, axis))
            panel.set_ylabel(title)
            panel.grid(alpha=0.3)
            if part:
                panel.set_title(part, fontsize=9)
    figure.tight_layout()
    legend_below(figure, panels[0][0], 6)
    save(figure, path)


def plot_error_bars(rows, path):
    """Errors by the values of the axes that are words: RMS with 95 % intervals, the bound as a dash."""
    axes = axis_columns(rows)
    figure, panels = plt.subplots(1, 3, figsize=(15, 4.4))
    names = list(groups(rows, "estimator"))
    cells = {}
    for row in rows:
        cells.setdefault("\n".join(row[axis].replace("_", " ") for axis in axes), []).append(row)
    for panel, (measure, bound, scale, title) in zip(panels, MEASURES):
        for c, of_cell in enumerate(cells.values()):
            for k, (name, of_name) in enumerate(groups(of_cell, "estimator").items()):
                at = c + 0.8 * ((k + 0.5) / len(names) - 0.5)
                values = [scale * number(row, measure) for row in registered(of_name)]
                if len(values) > 1:
                    rms, low, high = rms_with_interval(values)
                    panel.errorbar([at], [rms], [[rms - low], [high - rms]], fmt="o", ms=4, capsize=2,
                                   color=COLOURS[names.index(name) % len(COLOURS)],
                                   label=name.replace("_", " ") if c == 0 else None)
                limit = scale * number(of_name[0], bound)
                if np.isfinite(limit):
                    panel.plot([at - 0.3 / len(names), at + 0.3 / len(names)], [limit, limit], color="0.3", lw=1.6,
                               label="bound" if c == 0 and k == 0 else None)
        panel.set_yscale("log")
        panel.set_xticks(range(len(cells)), list(cells), fontsize=7)
        panel.set_ylabel(title)
        panel.grid(alpha=0.3, axis="y", which="both")
    figure.tight_layout()
    legend_below(figure, panels[0], 6)
    save(figure, path)


def plot_leak(rows, path):
    """What rules leak of a die's tilts: median rotation with its central 95 %, nothing else being wrong."""
    figure, panel = plt.subplots(figsize=(7, 4.8))
    for k, (name, of_name) in enumerate(groups(rows, "estimator").items()):
        found = groups(registered(of_name), "tilt_deg")
        x = np.array([float(tilt) for tilt in found])
        y = np.array([np.percentile([DEGREE * number(row, "rotation_error_rad") for row in of_tilt], [50, 2.5, 97.5])
                      for of_tilt in found.values()])
        panel.plot(x, y[:, 0], "o-", ms=4, color=COLOURS[k], label=name.replace("_", " "))
        panel.fill_between(x, y[:, 1], y[:, 2], color=COLOURS[k], alpha=0.08)
    set_scale(panel, "tilt_deg", rows)
    panel.set_yscale("log")
    panel.set_xlabel(AXIS_TITLES["tilt_deg"])
    panel.set_ylabel("rotation error: median and central 95 % (deg)")
    panel.grid(alpha=0.3)
    figure.tight_layout()
    legend_below(figure, panel)
    save(figure, path)


def share_with_interval(hits, n):
    """Wilson's 95 % interval of a share."""
    z, p = 1.96, hits / n
    centre = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * np.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return p, min(p, centre - half), max(p, centre + half)


def draw_shares(panel, rows, axis, name, **style):
    """Share of rows in which a column is 1, with its interval, along a numeric axis."""
    found = groups(rows, axis)
    x = np.array([float(value) for value in found])
    y = np.array([share_with_interval(sum(number(row, name) for row in of), len(of)) for of in found.values()])
    order = np.argsort(x)
    panel.errorbar(x[order], y[order, 0], [(y[:, 0] - y[:, 1])[order], (y[:, 2] - y[:, 0])[order]], ms=3.5, lw=1,
                   capsize=2, **style)


def plot_readings(rows, path):
    """Pips read rightly (full) and wrongly accepted (hollow) against the range."""
    parts = groups(rows, "noise_over_contrast")
    figure, panels = plt.subplots(1, len(parts), figsize=(6 * len(parts), 4.2), sharey=True, squeeze=False)
    for panel, (noise, of_noise) in zip(panels[0], parts.items()):
        for k, (name, of_name) in enumerate(groups(of_noise, "estimator").items()):
            draw_shares(panel, of_name, "range_m", "right", fmt="o-", color=COLOURS[k],
                        label=name.replace("_", " ") + ", right")
            draw_shares(panel, of_name, "range_m", "wrong", fmt="s--", mfc="none", color=COLOURS[k],
                        label="wrong and accepted")
        set_scale(panel, "range_m", of_noise)
        panel.set_title(f"intensity noise over contrast {noise}", fontsize=9)
        panel.set_xlabel(AXIS_TITLES["range_m"])
        panel.grid(alpha=0.3)
    panels[0][0].set_ylabel("share of trials")
    figure.tight_layout()
    legend_below(figure, panels[0][0])
    save(figure, path)


def plot_kernels(rows, path):
    """Wrong decisions of three kernels against how degenerate the die is, one row of panels for each kind of die."""
    decisions = [("wrong_orientation", "orientation wrong"), ("wrong_chirality", "chirality wrong"),
                 ("wrong_adjacency", "adjacency wrong"), ("wrong_closure", "closure wrong"),
                 ("corner_on_planes", "corner on its planes")]
    dice = groups(rows, "die")
    figure, panels = plt.subplots(len(dice), len(decisions), figsize=(17, 3.2 * len(dice)), sharex=True, sharey=True,
                                  squeeze=False)
    for line, (die, of_die) in zip(panels, dice.items()):
        for panel, (name, title) in zip(line, decisions):
            for k, (kernel, of_kernel) in enumerate(groups(of_die, "estimator").items()):
                draw_shares(panel, of_kernel, "angle_rad", name, fmt="os^"[k] + ("-", ":", "--")[k], color=COLOURS[k],
                            label=kernel)
            panel.set_xscale("log")
            panel.set_title(f"{die.replace('_', ' ')}: {title}", fontsize=9)
            panel.grid(alpha=0.3)
        line[0].set_ylabel("share of trials")
    for panel in panels[-1]:
        panel.set_xlabel("nearness (rad)")
    figure.tight_layout()
    legend_below(figure, panels[0][0])
    save(figure, path)


def plot_rings(rows, path):
    """Effective range: displacement on a ring of 10 m against the range, the bound as a line, the ranges that the
    paper claims as vertical lines (it names no accuracy)."""
    figure, panel = plt.subplots(figsize=(7.2, 4.8))
    claims = {claim["edge_m"]: float(claim["range_m"]) for claim in published_ranges()}
    for k, (edge, of_edge) in enumerate(groups(rows, "edge_m").items()):
        done = set()
        if edge in claims:
            panel.axvline(claims[edge], color=COLOURS[k], lw=0.8, ls=(0, (6, 3)), label=f"paper: {edge} m die")
        for (name, of_name), marker in zip(groups(of_edge, "estimator").items(), "os^v"):
            x, rms = series_of(of_name, "range_m", "ring10_error_m", 1e3)
            if len(x):
                panel.errorbar(x, rms[:, 0], [rms[:, 0] - rms[:, 1], rms[:, 2] - rms[:, 0]], fmt=marker, ms=4,
                               capsize=2, color=COLOURS[k], label=f"{name.replace('_', ' ')}, {edge} m die")
            draw_bounds(panel, of_name, "range_m", "bound_ring10_m", 1e3, done)
    set_scale(panel, "range_m", rows)
    panel.set_yscale("log")
    panel.set_xlabel(AXIS_TITLES["range_m"])
    panel.set_ylabel("displacement on a ring of 10 m, RMS (mm)")
    panel.grid(alpha=0.3)
    figure.tight_layout()
    legend_below(figure, panel, 3)
    save(figure, path)


def published_ranges():
    source = pathlib.Path(__file__).resolve().parent.parent / "experiments/die/published/effective_range.csv"
    return rows_of(source)


KINDS = {
    "figure5": plot_extraction,
    "figure6": plot_pips,
    "figure7": plot_axes,
    "figure8": plot_frames,
    "figure9": plot_axes,
    "figure10": plot_calibration,
    "table7": plot_registered,
    "range_noise": plot_error_curves,
    "die_edge": plot_error_curves,
    "range": plot_error_curves,
    "effective_range": plot_rings,
    "squareness": plot_error_curves,
    "leak": plot_leak,
    "angular_step": plot_error_curves,
    "separation": plot_error_curves,
    "edge_radius": plot_error_curves,
    "warp": plot_error_curves,
    "detector": plot_error_bars,
    "fit_domain": plot_error_bars,
    "frame_rule": plot_error_bars,
    "estimator": plot_error_curves,
    "pip_reader": plot_readings,
    "kernel": plot_kernels,
}


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: plot.py DIR")
    folder = pathlib.Path(sys.argv[1])
    drawn = 0
    for name, plot in KINDS.items():
        source = folder / f"{name}.csv"
        if source.exists():
            plot(rows_of(source), folder / name)
            drawn += 1
    if drawn == 0:
        sys.exit(f"plot: no figure data in {folder}")


if __name__ == "__main__":
    main()
