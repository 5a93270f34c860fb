"""Layered drawing of a graph without circles (Sugiyama, Tagawa and Toda 1981), in whole pixels.

Nodes stand in rows so that every arrow points to a lower row; an arrow over several rows passes
each of them in a gap of its own; rows are sorted by the barycentre of the neighbours.
Whole numbers keep the picture the same on every machine.
"""

GAP = 12         # between the boxes of a row
LANE = 6         # width of an arrow that passes a row
SPARE = 54       # of a row, for lanes
SWEEPS = 24


class Layout:
    def __init__(self):
        self.rows = []     # from the bottom; each a list of node names or (a, b, row) for a lane
        self.centre = {}   # x of each
        self.edges = []    # (a, b)


def assign_rows(nodes, below, width, limit):
    """Each node one row above all that it points to, higher where that row is full."""
    row_of, used = {}, []
    for node in nodes:
        row = 1 + max((row_of[b] for b in below[node]), default=-1)
        while row < len(used) and used[row] + GAP + width[node] > limit:
            row += 1
        while row >= len(used):
            used.append(-GAP)
        used[row] += GAP + width[node]
        row_of[node] = row
    return row_of, len(used)


def chain(edge, row_of):
    """The items that an edge passes, from above: its nodes and a lane in every row between."""
    a, b = edge
    return [a] + [(a, b, row) for row in range(row_of[a] - 1, row_of[b], -1)] + [b]


def neighbours(layout, row_of):
    up, down = {}, {}
    for edge in layout.edges:
        items = chain(edge, row_of)
        for high, low in zip(items, items[1:]):
            down.setdefault(high, []).append(low)
            up.setdefault(low, []).append(high)
    return up, down


def crossings(rows, down):
    total = 0
    for high, low in zip(rows[1:], rows):
        place = {item: i for i, item in enumerate(low)}
        ends = [sorted(place[other] for other in down.get(item, ())) for item in high]
        for i, first in enumerate(ends):
            for second in ends[i + 1:]:
                total += sum(x > y for x in first for y in second)
    return total


def sort_rows(layout, up, down):
    best, fewest = [list(row) for row in layout.rows], crossings(layout.rows, down)
    for sweep in range(SWEEPS):
        count = len(layout.rows)
        order = range(1, count) if sweep % 2 == 0 else range(count - 2, -1, -1)
        step, links = (-1, down) if sweep % 2 == 0 else (1, up)
        for r in order:
            place = {item: i for i, item in enumerate(layout.rows[r + step])}

            def key(pair):
                at = [place[other] for other in links.get(pair[1], ())]
                return 1000 * sum(at) // len(at) if at else 1000 * pair[0]

            layout.rows[r] = [item for _, item in sorted(enumerate(layout.rows[r]), key=key)]
        now = crossings(layout.rows, down)
        if now < fewest:
            best, fewest = [list(row) for row in layout.rows], now
    layout.rows = best


def swap_neighbours(layout, down):
    """Swaps neighbours of a row as long as that saves crossings."""
    fewest, saved = crossings(layout.rows, down), True
    while saved:
        saved = False
        for row in layout.rows:
            for i in range(len(row) - 1):
                row[i], row[i + 1] = row[i + 1], row[i]
                now = crossings(layout.rows, down)
                if now < fewest:
                    fewest, saved = now, True
                else:
                    row[i], row[i + 1] = row[i + 1], row[i]


def settle_row(row, wanted, width, limit):
    """Centres nearest to `wanted` in least squares, without overlap (pool adjacent violators)."""
    offsets, at = [], 0
    for i, item in enumerate(row):
        if i:
            at += (width(row[i - 1]) + width(item)) // 2 + GAP
        offsets.append(at)
    pools = []   # [sum, count]
    for item, offset in zip(row, offsets):
        pools.append([wanted[item] - offset, 1])
        while len(pools) > 1 and pools[-2][0] * pools[-1][1] > pools[-1][0] * pools[-2][1]:
            last = pools.pop()
            pools[-1] = [pools[-1][0] + last[0], pools[-1][1] + last[1]]
    least = width(row[0]) // 2
    most = limit - width(row[-1]) // 2 - offsets[-1]
    shifts = [min(max(total // count, least), most) for total, count in pools for _ in range(count)]
    return [offset + shift for offset, shift in zip(offsets, shifts)]


def settle(layout, up, down, size, limit):
    """Gives every item its centre: near to its neighbours, the whole in the middle of `limit`."""
    for row in layout.rows:
        at = 0
        for item in row:
            layout.centre[item] = at + size(item) // 2
            at += size(item) + GAP
    for sweep in range(SWEEPS):
        for row in layout.rows if sweep % 2 else layout.rows[::-1]:
            wanted = {}
            for item in row:
                near = up.get(item, []) + down.get(item, [])
                middle = [layout.centre[other] for other in near] or [layout.centre[item]]
                wanted[item] = sum(middle) // len(middle)
            layout.centre.update(zip(row, settle_row(row, wanted, size, limit)))
    left = min(layout.centre[row[0]] - size(row[0]) // 2 for row in layout.rows)
    right = max(layout.centre[row[-1]] + size(row[-1]) // 2 for row in layout.rows)
    for item in layout.centre:
        layout.centre[item] += (limit - right - left) // 2


def lay_out(nodes, edges, width, limit):
    """`nodes` so that every edge (a, b) leads to an earlier node; `width` in px of each; all within
    `limit` px as far as a row with its lanes allows."""
    layout = Layout()
    layout.edges = edges
    below = {node: [b for a, b in edges if a == node] for node in nodes}
    row_of, count = assign_rows(nodes, below, width, limit - SPARE)
    layout.rows = [[node for node in nodes if row_of[node] == r] for r in range(count)]
    for edge in edges:
        for lane in chain(edge, row_of)[1:-1]:
            layout.rows[lane[2]].append(lane)
    up, down = neighbours(layout, row_of)
    sort_rows(layout, up, down)
    swap_neighbours(layout, down)

    def size(item):
        return width[item] if item in width else LANE

    settle(layout, up, down, size, limit)
    return layout, row_of
