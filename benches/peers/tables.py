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
    """Whole renders: seconds and ratios. A ratio above 1 means that glimray is faster."""
    rows = []
    for r in records:
        peer, ours = r["peer_seconds"], r["glimray_seconds"]
        ratios = [a / b for a, b in zip(peer, ours)]
        rows.append(
            [r["render"], r["what"], r["peer"], f"{median(peer):.3f}", f"{median(ours):.3f}", spread(ratios), r.get("rmse", "")]
        )
    return table(["scene", "seconds", "peer", "peer's", "glimray's", "ratio (range)", "RMSE in levels"], rows)


def rates(records):
    """Millions of rays per second, a row for each peer and set."""
    rows = [
        [r["scene"], r["set"], r["threads"], r["peer"], f"{r['mrays_per_s']:.2f}", f"{r['hits']:,}", f"{r['sum_t']:.2f}"]
        for r in records
    ]
    return table(["scene", "rays", "threads", "peer", "Mrays/s", "hits", "sum of t"], rows)


def rates_beside(records):
    """A row for each set and number of threads, a column for each peer; glimray's ratio to the fastest at the end."""
    peers = list(dict.fromkeys(r["peer"] for r in records))
    cells = {}
    for r in records:
        cells.setdefault((r["scene"], r["set"], r["threads"]), {})[r["peer"]] = r
    rows = []
    for key, found in sorted(cells.items()):
        rates_found = {peer: r["mrays_per_s"] for peer, r in found.items()}
        ours = rates_found.pop("glimray", None)
        best = max(rates_found.values(), default=None)
        ratio = f"{ours / best:.2f}" if ours and best else ""
        hits = [r["hits"] for r in found.values()]
        agreement = (max(hits) - min(hits)) / max(1, max(hits))
        values = [f"{found[peer]['mrays_per_s']:.2f}" if peer in found else "" for peer in peers]
        rows.append([*key, *values, ratio, f"{agreement:.1e}"])
    return table(["scene", "rays", "threads", *peers, "glimray / fastest peer", "spread of hits"], rows)
