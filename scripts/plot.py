#!/usr/bin/python3
"""plot.py DIR: draws a picture (PNG and PDF) from every CSV file in DIR that it knows.

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


KINDS = {
    "figure5": plot_extraction,
    "figure6": plot_pips,
    "figure7": plot_axes,
    "figure8": plot_frames,
    "figure9": plot_axes,
    "figure10": plot_calibration,
    "table7": plot_registered,
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
