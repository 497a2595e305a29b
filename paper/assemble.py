#!/usr/bin/python3
"""assemble.py RESULTS WORK: writes what report.tex inputs (numbers, tables, chapters, sweeps) to WORK.

Every number comes out of RESULTS: tables of `alea reproduce` (RESULTS/PAPER/*.csv with title and note in *.txt) and rows
of `alea sweep export` (RESULTS/sweeps/*.csv).
"""

import csv
import math
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PAPERS = ("die", "checkerboard", "markerless")
SWEEPS = {
    "range_noise": "Errors against the scanner's range noise, other causes in proportion.",
    "die_edge": "Errors against the edge of the die.",
    "range": "Errors against the range.",
    "effective_range": "Displacement on a ring of 10 m about the die, step 0.3 mrad; vertical lines: ranges that the paper "
                       "calls effective.",
    "squareness": "Errors against the facets' tilts: all facets, opposite facets parallel, the upper facet alone.",
    "leak": "What frame rules leak of a die's tilts without noise.",
    "angular_step": "Errors against the angular step.",
    "separation": "Errors against the angle between the stations; tilt prior 0.4 deg where one facet is shared.",
    "edge_radius": "Errors against the radius of the die's edges, for several trims ($-1$: estimated).",
    "warp": "Errors against the bow of the facets, weights by noise and by area.",
    "detector": "Errors by the way in which the facets' points are found.",
    "fit_domain": "Errors by the domains of selection and fit.",
    "frame_rule": "Errors by frame rule, for free and parallelepipedal dice and two separations.",
    "estimator": "Estimators of the die beside six spheres and four planes.",
    "pip_reader": "Pips read rightly, and wrongly accepted, against the range.",
    "kernel": "Wrong decisions in three kernels against how degenerate the facets are.",
}


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def latex(text):
    out = ""
    for c in text.replace("<=", "\u2264").replace(">=", "\u2265"):
        out += {"\\": r"\textbackslash{}", "<": "$<$", ">": "$>$", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
                "\u00b0": r"\textdegree{}", "\u2264": r"$\le$", "\u2265": r"$\ge$"}.get(c, "\\" + c if c in "#$%&_{}" else c)
    return out


def significant(value, digits=3):
    """A number with so many significant digits; very small ones as a power of ten."""
    if not math.isfinite(value):
        raise ValueError("a number is missing")
    if value == 0:
        return "0"
    exponent = math.floor(math.log10(abs(value)) + 1e-9)
    if exponent < -4 or exponent > 5:
        return f"${value / 10 ** exponent:.1f}\\cdot 10^{{{exponent}}}$"
    return f"{value:.{max(0, digits - 1 - exponent)}f}"


def ours_of(row):
    if not row["ours_median"]:
        return ""
    median, low, high = (float(row[f"ours_{name}"]) for name in ("median", "low", "high"))
    if low == high:
        return significant(median)
    return f"{significant(median)} [{significant(low)}, {significant(high)}]"


def write_table(source, work, paper):
    """A table of a reproduction as a longtable; title and note are the first lines of its text file."""
    rows = rows_of(source)
    lines = source.with_suffix(".txt").read_text().splitlines()
    title, note = lines[0], lines[1] if len(lines) > 1 else ""
    if title.startswith("Table "):
        title = "The paper's " + title
    longest = max(len(row["row"]) for row in rows)
    first = 0.06 if longest < 8 else 0.15 if longest < 20 else 0.27
    # Share of the line and text of each column; one without any text is left out.
    columns = [(first, "", lambda row: latex(row["row"])),
               (0.24, "quantity", lambda row: latex(row["column"] + (f" ({row['unit']})" if row["unit"] else ""))),
               (0.09, "printed", lambda row: latex(row["printed"])),
               (0.21, "ours [central 95\\,\\%]", ours_of),
               (0.13, "verdict", lambda row: latex(row["verdict"].replace("-", ""))),
               (0.19, "note", lambda row: latex(row["note"]))]
    columns = [column for column in columns if any(column[2](row) for row in rows)]
    spare = (1 - 0.015 * len(columns)) / sum(width for width, _, _ in columns)
    widths = "".join(f">{{\\raggedright\\arraybackslash}}p{{{width * spare:.4f}\\linewidth}}" for width, _, _ in columns)
    head = " & ".join(title for _, title, _ in columns) + "\\\\ \\midrule"
    out = [f"{{\\footnotesize\\setlength{{\\tabcolsep}}{{3pt}}\\begin{{longtable}}{{@{{}}{widths}@{{}}}}",
           f"\\caption{{{latex(title)}. {latex(note)}}}\\label{{tab:{paper}-{source.stem}}}\\\\", "\\toprule",
           head + " \\endfirsthead", "\\toprule", head + " \\endhead", "\\bottomrule \\endfoot"]
    out += [" & ".join(text(row) for _, _, text in columns) + "\\\\" for row in rows]
    out.append("\\end{longtable}}")
    (work / "tables").mkdir(exist_ok=True)
    (work / "tables" / f"{paper}-{source.stem}.tex").write_text("\n".join(out) + "\n")


def is_table(path):
    with open(path) as file:
        return file.readline().startswith("row,column,unit,printed,")


def place(results, work, paper, text):
    """The text with its tables and figures, then those that it does not place. A table behind a figure is not set."""
    tables = [path for path in sorted((results / paper).glob("*.csv"))
              if is_table(path) and not path.stem.startswith("figure")]
    figures = sorted(path for path in (results / paper).iterdir()
                     if path.suffix == ".pdf" or path.suffix == ".png" and not path.with_suffix(".pdf").exists())
    for table in tables:
        write_table(table, work, paper)
    out = []
    for line in text.splitlines():
        if line.startswith(f"\\aleatable{{{paper}}}"):
            name = line.split("{")[2].rstrip("}")
            tables = [table for table in tables if table.stem != name]
            line = f"\\input{{tables/{paper}-{name}}}"
        elif line.startswith(f"\\aleafig{{{paper}}}"):
            name, caption = line.split("{", 2)[2].split("}{", 1)
            source = next((figure for figure in figures if figure.stem == name), results / paper / f"{name}.pdf")
            figures = [figure for figure in figures if figure.stem != name]
            line = f"\\aleafigure{{{source}}}{{{caption[:-1]}}}{{fig:{paper}-{name}}}"
        out.append(line)
    out += [f"\\input{{tables/{paper}-{table.stem}}}" for table in tables]
    out += [f"\\aleafigure{{{figure}}}{{{latex(figure.stem.replace('_', ' '))}}}{{fig:{paper}-{figure.stem}}}"
            for figure in figures]
    return "\n".join(out) + "\n\\clearpage\n"


def rms(values):
    return math.sqrt(sum(v * v for v in values) / len(values))


def over_bound(rows, **wanted):
    """RMS rotation over RMS bound of the registered rows with these values."""
    chosen = [row for row in rows if row["verdict"] == "registered" and
              all(row[name] == value for name, value in wanted.items())]
    return (rms([float(row["rotation_error_rad"]) for row in chosen]) /
            rms([float(row["bound_rotation_rad"]) for row in chosen]))


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2]


def crossing(rows, limit, **wanted):
    """Where the bound on the ring crosses the limit: linear between the ranges in logarithms."""
    bound = {float(row["range_m"]): float(row["bound_ring10_m"]) for row in rows
             if all(row[name] == value for name, value in wanted.items())}
    ranges = sorted(bound)
    for near, far in zip(ranges, ranges[1:]):
        if bound[near] <= limit < bound[far]:
            share = math.log(limit / bound[near]) / math.log(bound[far] / bound[near])
            return near * (far / near) ** share
    return math.nan


def sweep_numbers(sweeps):
    numbers = {}
    read = lambda name: rows_of(sweeps / f"{name}.csv")
    leak = [row for row in read("leak") if row["tilt_deg"] == "0.5"]
    for name, macro in (("fix_z", "LeakFixZHalf"), ("closed_form", "LeakClosedFormHalf")):
        numbers[macro] = significant(math.degrees(median(
            [float(row["rotation_error_rad"]) for row in leak if row["estimator"] == name])))
    domain = read("fit_domain")
    numbers["DomainCrossed"] = significant(
        over_bound(domain, estimator="closed_form", domain="ray", fit="orthogonal"), 2)
    numbers["DomainConsistent"] = significant(
        over_bound(domain, estimator="closed_form", domain="ray", fit="along_ray"), 2)
    radius = read("edge_radius")
    for trim, macro in (("0", "RadiusUntrimmed"), ("-1", "RadiusTrimmed")):
        numbers[macro] = significant(
            over_bound(radius, estimator="closed_form", edge_radius_mm="20", trim_mm=trim), 2)
    ranges = read("effective_range")
    for estimator, shape in (("closed_form", "Free"), ("known_shape", "Known")):
        for edge, size in (("0.5", "Large"), ("0.3", "Small")):
            numbers[f"Range{shape}{size}"] = significant(
                crossing(ranges, 2.5e-3, estimator=estimator, edge_m=edge))
    return numbers


def verdict_numbers(folder, prefix):
    cells = [row["verdict"] for path in sorted(folder.glob("*.csv")) if is_table(path) for row in rows_of(path)]
    judged = [v for v in cells if v in ("agrees", "differs", "undecidable")]
    return {f"{prefix}Cells": len(judged), f"{prefix}Agree": judged.count("agrees"),
            f"{prefix}Differ": judged.count("differs"), f"{prefix}Undecidable": judged.count("undecidable")}


def checkerboard_numbers(folder):
    if not folder.is_dir():
        return {}
    def shares(figure, success, **wanted):
        """Success in percent over the points of a figure with these values; shifts up to `up_to`."""
        up_to = wanted.pop("up_to", 150)
        return [100 * float(row[success]) for row in rows_of(folder / f"{figure}_data.csv")
                if int(row["shift_percent"]) <= up_to and all(row[name] == value for name, value in wanted.items())]
    percent = lambda values: f"{min(values):.0f}"
    at = lambda shift, rotation: {"shift_percent": shift, "rotation_deg": rotation}
    return {**verdict_numbers(folder, "Check"),
            "CheckPairs": rows_of(folder / "figure8_data.csv")[0]["pairs"],
            "CheckColouredNinety": percent(shares("figure8", "strict", method="coloured", **at("90", "0"))),
            "CheckIndependentNinety": percent(shares("figure6_variants", "strict", target="independent", **at("90", "0"))),
            "CheckPointOutline": percent(shares("figure8_variants", "strict", method="point_to_point", **at("60", "30"))),
            "CheckWallSixty": percent(shares("figure8_variants", "symmetric", method="coloured", target="white_wall",
                                             **at("60", "0"))),
            "CheckPlaneFirst": percent(shares("figure6_variants", "strict", method="plane_then_coloured",
                                              rotation_deg="30", up_to=60)),
            "CheckLikelihoodLeast": percent(shares("figure8_variants", "symmetric", method="likelihood"))}


def die_numbers(die):
    numbers = verdict_numbers(die, "Die")
    errata = [row for row in rows_of(die / "errata.csv") if row["unit"] == "mm"]
    worst = max(errata, key=lambda row: float(row["ours_median"]))
    corrected = max(float(row["ours_median"]) for row in errata if "corrected" in row["row"])
    numbers["DieErrataWorst"] = significant(float(worst["ours_median"]) / 1e3) + "\\,m"
    numbers["DieErrataCorrected"] = significant(corrected) + "\\,mm"
    return numbers


def markerless_numbers(folder):
    if not folder.is_dir():
        return {}
    def value(table, row, column):
        """The one number of a table's row and column."""
        for line in rows_of(folder / f"{table}.csv"):
            if line["row"] == row and line["column"] == column:
                return float(line["ours_median"])
        raise KeyError(f"{folder / table}.csv: {row}, {column}")
    def total(table, column):
        return sum(float(line["ours_median"]) for line in rows_of(folder / f"{table}.csv") if line["column"] == column)
    percent = lambda value: f"{100 * value:.0f}"
    audit = rows_of(folder / "audit.csv")
    numbers = {**verdict_numbers(folder, "Mark"),
               "MarkClosedPairs": f"{sum(float(r['ours_median']) for r in audit if r['column'].startswith('pairs that close')):.0f}",
               "MarkLargestFall": significant(max(float(r["ours_median"]) for r in audit
                                                  if r["column"].startswith("fall of the counts"))),
               "MarkOmegaPrinted": significant(value("audit", "equation 4", "largest error of omega as printed")),
               "MarkGridRatio": significant(value("table1", "grid over all points", "ratio of RMSE at the truth"), 2),
               "MarkAreaRmse": significant(value("success", "RMSE of all points", "area under ROC"), 2),
               "MarkAreaOverlap": significant(value("success", "overlap", "area under ROC"), 2),
               "MarkAreaClosure": significant(value("success", "forward-backward closure", "area under ROC"), 2),
               "MarkAreaConflict": significant(value("success", "free-space conflict ratio", "area under ROC"), 2),
               "MarkAreaMargin": significant(value("success", "margin", "area under ROC"), 2),
               "MarkRight": f"{total('robust', 'right'):.0f}", "MarkRefused": f"{total('robust', 'refused'):.0f}",
               "MarkWrong": f"{total('robust', 'wrong'):.0f}"}
    near = "0.05 m, paper's ICP from 3 deg, 0.23 m"
    numbers["MarkNearRotation"] = significant(value("grids", near, "rotation error"), 2)
    numbers["MarkNearTranslation"] = significant(value("grids", near, "translation error"), 2)
    for column, name in (("RMSE", "Rmse"), ("rotation error", "Rotation"), ("translation error", "Translation")):
        numbers[f"MarkGrid{name}"] = significant(value("grids", "widest over finest grid, near the truth", column), 2)
    for twin, table, name in (("bell_tower", "table3", "Tower"), ("lighthouse", "table4", "Lighthouse")):
        pairs = sorted(rows_of(folder / f"{twin}_pairs.csv"), key=lambda pair: float(pair["rmse_m"]))
        for pair, which in ((pairs[0], "Lowest"), (pairs[-1], "Highest")):
            numbers[f"Mark{name}{which}"] = f"{pair['fixed']}--{pair['moving']}"
        numbers[f"Mark{name}Harris"] = percent(
            value("keypoints", twin.replace("_", " "), "Harris keypoints are suitable: share of true poses"))
        numbers[f"Mark{name}True"] = percent(value(table, "all pairs", "true poses (1 deg, 0.1 m)"))
        numbers[f"Mark{name}Below"] = percent(
            value(table, "all pairs", "RMSE of the estimate below RMSE of the truth"))
    return numbers


def program_numbers(results):
    project = (HERE.parent / "CMakeLists.txt").read_text()
    version = project.split("project(alea VERSION ")[1].split()[0]
    commit = subprocess.run(["git", "-C", HERE, "describe", "--always", "--dirty", "--match=nothing"],
                            capture_output=True, text=True).stdout.strip() or "unknown"
    full = (results / "sweeps" / "full").is_dir()
    return {"AleaVersion": version, "AleaCommit": commit,
            "AleaSize": "full size" if full else "small size: few trials, so wide intervals"}


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: assemble.py RESULTS WORK")
    results, work = map(pathlib.Path, sys.argv[1:])
    sweeps = results / "sweeps"
    numbers = {**program_numbers(results), **die_numbers(results / "die"),
               **checkerboard_numbers(results / "checkerboard"), **markerless_numbers(results / "markerless"),
               **sweep_numbers(sweeps)}
    (work / "numbers.tex").write_text("".join(f"\\newcommand{{\\{name}}}{{{value}}}\n" for name, value in numbers.items()))
    chapters = ""
    for paper in PAPERS:
        text = HERE / "chapters" / f"{paper}.tex"
        if text.exists() and (results / paper).is_dir():
            (work / f"{paper}.tex").write_text(place(results, work, paper, text.read_text()))
            chapters += f"\\input{{{paper}}}\n"
    (work / "chapters.tex").write_text(chapters)
    found = "".join(f"\\aleafigure{{{sweeps}/{name}.pdf}}{{{caption} Points: root mean square with its 95\\,\\% interval "
                    f"unless the axis says otherwise.}}{{fig:sweep-{name}}}\n"
                    for name, caption in SWEEPS.items() if (sweeps / f"{name}.pdf").exists())
    (work / "sweeps.tex").write_text("\\section{Sweeps}\nEach point is made of simulated scans; every estimator sees the same "
                                     "trials, so differences between estimators are surer than their intervals show.\n"
                                     + found)
    shutil.copy(HERE / "report.tex", work / "report.tex")


if __name__ == "__main__":
    try:
        main()
    except (OSError, KeyError, ValueError, ZeroDivisionError, subprocess.CalledProcessError) as error:
        sys.exit(f"assemble: {error!r}: the results are incomplete; run scripts/reproduce again")
