"""Linear statics and linearised buckling of plane frames of straight members under loads at nodes, exactly.

Members have the stiffness of a beam with constant axial force (stability functions); the number of buckling loads below a load
factor is the number of negative pivots of the joints' stiffness and, of each member, the number of its own buckling loads with
its ends held (Wittrick and Williams, Int. J. Mech. Sci. 12, 1970). Axial forces are those of the linear solution times the
load factor.
"""
import math


class Frame:
    """Joints' unknowns and members of a model (lines, nodal point loads, rigid supports along the global axes)."""

    def __init__(self, model):
        self.model = model
        self.nodes = {node["id"]: (node["x"], node["y"]) for node in model["nodes"]}
        sections = {section["id"]: section for section in model["sections"]}
        turned = {m[e] for m in model["members"] for e in ("start", "end") if not m.get("release", {}).get(e)}
        fixed = {(s["node"], c) for s in model["supports"] for c in s["fixed"]}
        self.index = {}
        for node in self.nodes:
            for component in ("x", "y", "rotation"):
                free = (node, component) not in fixed and (component != "rotation" or node in turned)
                if free:
                    self.index[node, component] = len(self.index)
        self.members = [Member(m, self.nodes, sections[m["section"]]) for m in model["members"]]
        self.solve()

    def assemble(self, factor):
        size = len(self.index)
        matrix = [[0.0] * size for _ in range(size)]
        for member in self.members:
            ids = self.places(member)
            stiffness = member.stiffness(-factor * member.force)
            for i, row in zip(ids, stiffness):
                for j, value in zip(ids, row):
                    if i is not None and j is not None:
                        matrix[i][j] += value
        return matrix

    def places(self, member):
        return [self.index.get((node, c)) for node in (member.start, member.end) for c in ("x", "y", "rotation")]

    def solve(self):
        """Displacements and axial forces under the loads of factor 1."""
        right = [0.0] * len(self.index)
        for load in self.model["loads"]:
            for component, value in zip(("x", "y"), load["force"]):
                place = self.index.get((load["at"]["node"], component))
                if place is not None:
                    right[place] += value
        for member in self.members:
            member.force = 0.0
        self.displacement = solve_symmetric(self.assemble(0.0), right)
        for member in self.members:
            u = [0.0 if i is None else self.displacement[i] for i in self.places(member)]
            stretch = (u[3] - u[0]) * member.c + (u[4] - u[1]) * member.s
            member.force = member.ea / member.length * stretch
            turn = ((u[4] - u[1]) * member.c - (u[3] - u[0]) * member.s) / member.length
            member.turn = abs(turn)
            ends = [] if any(member.released) else [u[2], u[5]]
            member.bend = max([abs(rotation - turn) for rotation in ends] + [0.0])

    def is_straight(self):
        """Whether no member bends under the loads and none that is compressed turns: then the path goes straight to a bifurcation."""
        strain = max(abs(m.force) / m.ea for m in self.members)
        turns = [m.turn for m in self.members if abs(m.force) > 1e-9 * strain * m.ea]
        return max([m.bend for m in self.members] + turns) < 1e-9 * strain

    def losses(self, factor):
        """Number of buckling loads between 0 and the factor."""
        return negative_pivots(self.assemble(factor)) + sum(m.own_loads(-factor * m.force) for m in self.members)

    def first_load(self, bound=1e12):
        """Lowest buckling load factor; infinite where there is none below the bound."""
        low, high = 0.0, 1e-9
        while self.losses(high) == 0:
            low, high = high, 2 * high
            if high > bound:
                return math.inf
        while high - low > 1e-10 * high:
            middle = (low + high) / 2
            low, high = (low, middle) if self.losses(middle) else (middle, high)
        return high

    def euler(self, member):
        """Load factor at which a rod with hinges at both ends reaches Euler's load; infinite in tension."""
        if member.released != (True, True) or member.force >= 0:
            return math.inf
        return math.pi ** 2 * member.ei / member.length ** 2 / -member.force


class Member:
    """A straight member: geometry, section, hinges; under the loads of factor 1 its axial force (tension positive), the
    rotation of its chord and the largest one of its ends against that."""

    def __init__(self, member, nodes, section):
        self.name = member["id"]
        self.start, self.end = member["start"], member["end"]
        dx, dy = (nodes[self.end][i] - nodes[self.start][i] for i in (0, 1))
        self.length = math.hypot(dx, dy)
        self.c, self.s = dx / self.length, dy / self.length
        self.ea, self.ei = section["EA"], section["EI"]
        release = member.get("release", {})
        self.released = (bool(release.get("start")), bool(release.get("end")))
        self.force = self.turn = self.bend = 0.0

    def stiffness(self, compression):
        """6 x 6 stiffness in global axes (x, y, rotation of both ends) under an axial compression."""
        axial = [self.c, self.s, 0.0, -self.c, -self.s, 0.0]
        across = [-self.s / self.length, self.c / self.length]  # chord's rotation by (-across) at the start, across at the end
        chord = [-across[0], -across[1], 0.0, across[0], across[1], 0.0]
        ends = [[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]]
        ends = [[a - b for a, b in zip(end, chord)] for end in ends]  # rotations of the ends against the chord
        near, far = self.end_stiffness(compression)
        matrix = outer(axial, axial, self.ea / self.length)
        add(matrix, outer(chord, chord, -compression * self.length))
        add(matrix, outer(ends[0], ends[0], near[0]))
        add(matrix, outer(ends[1], ends[1], near[1]))
        add(matrix, outer(ends[0], ends[1], far))
        add(matrix, outer(ends[1], ends[0], far))
        return matrix

    def end_stiffness(self, compression):
        """Moments by end rotations against the chord: ((start, end), carry-over)."""
        unit = self.ei / self.length
        near, far = (unit * x for x in stability_functions(compression * self.length / unit))
        if self.released == (False, False):
            return (near, near), far
        if self.released == (True, True):
            return (0.0, 0.0), 0.0
        left = near - far * far / near
        return ((0.0, left), 0.0) if self.released[0] else ((left, 0.0), 0.0)

    def own_loads(self, compression):
        """Number of the member's own buckling loads, with its ends held where they are not hinged, below a compression."""
        if compression <= 0:
            return 0
        u = self.length * math.sqrt(compression / self.ei)
        hinges = sum(self.released)
        if hinges == 2:
            return math.ceil(u / math.pi) - 1
        if hinges == 1:
            return roots_of_tangent(u)
        return math.ceil(u / (2 * math.pi)) - 1 + roots_of_tangent(u / 2)


def stability_functions(q):
    """Near and far end stiffness, times EI / L, for q = P L^2 / EI (compression positive)."""
    if abs(q) < 1e-3:
        return 4 - 2 * q / 15 - 11 * q * q / 6300, 2 + q / 30 + 13 * q * q / 12600
    u = math.sqrt(abs(q))
    if q > 0:
        s, c = math.sin(u), math.cos(u)
        d = 2 - 2 * c - u * s
        return u * (s - u * c) / d, u * (u - s) / d
    if u > 300:
        return u * (u - 1) / (u - 2), u / (u - 2)
    s, c = math.sinh(u), math.cosh(u)
    d = 2 - 2 * c + u * s
    return u * (u * c - s) / d, u * (s - u) / d


def roots_of_tangent(u):
    """Number of positive roots of tan x = x below u; the n-th lies between n pi and (n + 1/2) pi."""
    last = math.floor(u / math.pi)
    if last == 0:
        return 0
    rest = u - math.pi * last
    return last - 1 + (rest >= math.pi / 2 or math.tan(rest) > u)


def outer(a, b, scale):
    return [[scale * x * y for y in b] for x in a]


def add(matrix, other):
    for row, values in zip(matrix, other):
        for j, value in enumerate(values):
            row[j] += value


def eliminate(matrix, right=None):
    """Pivots of the symmetric elimination; the right side is carried along. Both arguments are changed."""
    size = len(matrix)
    pivots = []
    for k in range(size):
        pivot = matrix[k][k] or 1e-300
        pivots.append(pivot)
        for i in range(k + 1, size):
            factor = matrix[i][k] / pivot
            if factor:
                row, top = matrix[i], matrix[k]
                for j in range(k, size):
                    row[j] -= factor * top[j]
                if right is not None:
                    right[i] -= factor * right[k]
    return pivots


def negative_pivots(matrix):
    return sum(pivot < 0 for pivot in eliminate(matrix))


def solve_symmetric(matrix, right):
    largest = max(abs(x) for row in matrix for x in row)
    pivots = eliminate(matrix, right)
    if min(pivots) < 1e-13 * largest:
        raise ValueError("the frame is a mechanism")
    x = [0.0] * len(right)
    for i in reversed(range(len(right))):
        x[i] = (right[i] - sum(matrix[i][j] * x[j] for j in range(i + 1, len(right)))) / pivots[i]
    return x
