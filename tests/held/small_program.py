"""Linear algebra and linear programmes of a few unknowns, in double precision."""

PIVOT = 1e-9  # of the largest number of a row that was scaled to 1: smaller pivots are zero


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def norm(a):
    return dot(a, a) ** 0.5


def null_space(rows, size):
    """Orthonormal basis of the vectors v of length `size` with row.v = 0 for each row."""
    span = orthonormal(rows, size)
    basis = []
    for i in range(size):
        unit = [1.0 if j == i else 0.0 for j in range(size)]
        rest = without(unit, span + basis)
        rest = without(rest, span + basis)
        if norm(rest) > 1e-6:
            basis.append([x / norm(rest) for x in rest])
    return basis


def orthonormal(rows, size):
    """Orthonormal basis of the span of the rows; the largest remainder is taken first."""
    rests = [[x / norm(row) for x in row] for row in rows if norm(row) > 0]
    span = []
    while rests and len(span) < size:
        rests = [without(rest, span[-1:]) for rest in rests]
        largest = max(rests, key=norm)
        if norm(largest) < PIVOT:
            break
        largest = without(largest, span)
        span.append([x / norm(largest) for x in largest])
    return span


def without(vector, directions):
    """The vector less its parts along orthonormal directions."""
    for direction in directions:
        share = dot(vector, direction)
        vector = [x - share * d for x, d in zip(vector, direction)]
    return vector


def maximise(cost, matrix, right):
    """Largest cost.x with matrix x = right and x >= 0: ("optimal", value, x), ("infeasible",) or ("unbounded",).

    Simplex method on a dense table in two phases, with Bland's rule (no cycles).
    """
    count = len(cost)
    table = []
    for row, value in zip(matrix, right):
        scale = max([abs(x) for x in row] + [1e-300])
        sign = 1.0 if value >= 0 else -1.0
        table.append([sign * x / scale for x in row] + [sign * value / scale])
    for i, row in enumerate(table):
        row[count:count] = [1.0 if j == i else 0.0 for j in range(len(table))]
    basic = [count + i for i in range(len(table))]
    total = count + len(table)
    first = [0.0] * count + [-1.0] * len(table)
    run_simplex(table, basic, first, total)
    if sum(row[-1] for row, b in zip(table, basic) if b >= count) > 1e-9:
        return ("infeasible",)
    drive_out(table, basic, count)
    for row in table:
        row[count:total] = []
    if not run_simplex(table, basic, list(cost), count):
        return ("unbounded",)
    x = [0.0] * count
    for row, b in zip(table, basic):
        x[b] = row[-1]
    return ("optimal", dot(cost, x), x)


def drive_out(table, basic, count):
    """Takes artificial unknowns out of the basis; rows that depend on others are dropped."""
    for i in reversed(range(len(table))):
        if basic[i] < count:
            continue
        column = max(range(count), key=lambda j, row=table[i]: abs(row[j]))
        if abs(table[i][column]) > PIVOT:
            pivot(table, basic, i, column)
        else:
            del table[i], basic[i]


def run_simplex(table, basic, cost, count):
    """Pivots until the cost can't grow; False if it grows without bound."""
    while True:
        entering = None
        for j in range(count):
            gain = cost[j] - sum(cost[b] * row[j] for row, b in zip(table, basic))
            if gain > 1e-10 and j not in basic:
                entering = j
                break
        if entering is None:
            return True
        ratios = [(row[-1] / row[entering], basic[i], i) for i, row in enumerate(table) if row[entering] > PIVOT]
        if not ratios:
            return False
        least = min(ratios)[0]
        leaving = min((b, i) for ratio, b, i in ratios if ratio <= least + 1e-14)[1]
        pivot(table, basic, leaving, entering)


def pivot(table, basic, i, j):
    factor = table[i][j]
    table[i] = [x / factor for x in table[i]]
    for k, row in enumerate(table):
        if k != i and row[j] != 0.0:
            share = row[j]
            table[k] = [x - share * y for x, y in zip(row, table[i])]
    basic[i] = j
