"""Tables of results, as text and Markdown at once."""

from statistics import median


def table(head, rows):
    """A Markdown table with aligned columns."""
    rows = [head, *([str(cell) for cell in row] for row in rows)]
    widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |" for row in rows]
    lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(lines) + "\n"


def spread(values):
    """Median and range."""
    return f"{median(values):.2f} ({min(values):.2f}–{max(values):.2f})"


def renders(records):
    """Whole renders: seconds and ratios, of all records of a render together."""
    pairs, errors = {}, {}
    for r in records:
        key = r["render"], r["what"], r["peer"]
        pairs.setdefault(key, []).extend(zip(r["peer_seconds"], r["glimray_seconds"]))
        errors[key] = r.get("rmse", "")
    rows = []
    for key, found in pairs.items():
        seconds = [f"{median(values):.3f}" for values in zip(*found)]
        rows.append([*key, *seconds, spread([a / b for a, b in found]), errors[key]])
    return table(["scene", "seconds", "peer", "peer's", "glimray's", "ratio (range)", "RMSE in levels"], rows)


def rates(records):
    """Millions of rays per second, a row for each peer and set."""
    rows = [
        [
            *(r[key] for key in ("scene", "set", "threads", "peer")),
            f"{r['mrays_per_s']:.2f}",
            f"{r['hits']:,}",
            f"{r['sum_t']:.2f}",
        ]
        for r in records
    ]
    return table(["scene", "rays", "threads", "peer", "Mrays/s", "hits", "sum of t"], rows)


def rates_beside(records):
    """A row for each set and number of threads, a column for each peer; at the end glimray's ratio to the fastest.

    A peer that was measured several times counts with its median.
    """
    peers = list(dict.fromkeys(r["peer"] for r in records))
    cells = {}
    for r in records:
        row = cells.setdefault((r["scene"], r["set"], r["threads"]), {})
        row.setdefault(r["peer"], []).append(r["mrays_per_s"])
    hits = {}
    for r in records:
        hits.setdefault((r["scene"], r["set"]), []).append(r["hits"])
    rows = []
    for (scene, name, threads), found in sorted(cells.items()):
        rate = {peer: median(values) for peer, values in found.items()}
        best = max((value for peer, value in rate.items() if peer != "glimray"), default=0)
        ratio = f"{rate['glimray'] / best:.2f}" if best and "glimray" in rate else ""
        counts = hits[scene, name]
        differ = f"{(max(counts) - min(counts)) / max(counts):.0e}" if max(counts) > min(counts) else "0"
        columns = [f"{rate[peer]:.2f}" if peer in rate else "" for peer in peers]
        rows.append([scene, name, threads, *columns, ratio, differ])
    return table(["scene", "rays", "threads", *peers, "glimray / fastest", "hits differ by"], rows)
