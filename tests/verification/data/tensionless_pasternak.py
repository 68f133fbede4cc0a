#!/usr/bin/python3
"""Beams on tensionless Pasternak bases, small displacements: exact solutions piece by piece, 20 digits.

  tensionless_pasternak.py        prints the rows of tests/verification/tensionless_pasternak_test.cpp

EI = 1/4, K = 1, w positive downwards. Where the beam touches, EI w'''' - G w'' + K w = q. Beside it the surface g of
the ground follows K g = G g'' and leaves the beam tangentially. Needs python3-mpmath; shares no code with the solver.
"""
import mpmath as mp

mp.mp.dps = 30
EI, K = mp.mpf(1) / 4, mp.mpf(1)


def roots(G):
    """Roots of EI r^4 - G r^2 + K, as r^2."""
    part = mp.sqrt(mp.mpc(G * G - 4 * EI * K))
    return [mp.sqrt((G + part) / (2 * EI)), mp.sqrt((G - part) / (2 * EI))]


def exponentials(G, x, order, signs=(1, -1)):
    """Derivative of the four solutions exp(r x) at x, as real functions where roots are complex."""
    out = []
    for sign in signs:
        a, b = roots(G)
        if abs(mp.im(a)) > 0:
            value = (sign * a) ** order * mp.exp(sign * a * x)
            out += [mp.re(value), mp.im(value)]
        else:
            out += [mp.re((sign * r) ** order * mp.exp(sign * r * x)) for r in (a, b)]
    return out


def powers(x, order):
    return [mp.ff(n, order) * mp.mpf(x) ** (n - order) if n >= order else mp.mpf(0) for n in range(4)]


def solve_linear(rows):
    """rows: list of (coefficients, right side)."""
    A = mp.matrix([r[0] for r in rows])
    return list(mp.lu_solve(A, mp.matrix([r[1] for r in rows])))


def dot(a, b):
    return mp.fsum(x * y for x, y in zip(a, b))


def point_load(G):
    """Weightless infinite beam under a unit force: half the contact length, w(0), M(0)."""
    k = mp.sqrt(K / G)

    def at(c):
        rows = [(exponentials(G, 0, 1), 0), (exponentials(G, 0, 3), mp.mpf(1) / (2 * EI)),
                (exponentials(G, c, 2), 0), (exponentials(G, c, 3), 0)]
        a = solve_linear(rows)
        return a, dot(a, exponentials(G, c, 1)) + k * dot(a, exponentials(G, c, 0))

    c = mp.findroot(lambda c: at(c)[1], (mp.mpf("0.3"), mp.mpf("1.6")), solver="anderson", tol=mp.mpf("1e-24"))
    a, _ = at(c)
    return c, dot(a, exponentials(G, 0, 0)), -EI * dot(a, exponentials(G, 0, 2))


def heavy(G, force, start):
    """Infinite beam of unit weight under a force: lift-off and touch-down beside it, w(0), and the largest uplift."""
    k = mp.sqrt(K / G)
    q = mp.mpf(1)

    def at(c1, c2):
        n = 10  # four in the middle, four of the free part, two beyond
        def row(middle=None, free=None, beyond=None):
            out = [mp.mpf(0)] * n
            for at_, values in ((0, middle), (4, free), (8, beyond)):
                for i, value in enumerate(values or []):
                    out[at_ + i] = value
            return out
        rows = [(row(exponentials(G, 0, 1)), 0), (row(exponentials(G, 0, 3)), force / (2 * EI))]
        for order in range(4):
            weight = q / EI * c1 ** (4 - order) / mp.factorial(4 - order)
            level = q / K if order == 0 else 0
            minus = [-v for v in powers(c1, order)]
            rows.append((row(exponentials(G, c1, order), minus), weight - level))
            weight = q / EI * c2 ** (4 - order) / mp.factorial(4 - order)
            minus = [-v for v in powers(c2, order)]
            rows.append((row(None, minus, exponentials(G, c2 - start, order, (-1,))), weight - level))
        return solve_linear(rows)

    def state(c1, c2):
        a = at(c1, c2)
        m, f, b = a[:4], a[4:8], a[8:]
        w1 = q / K + dot(m, exponentials(G, c1, 0))
        s1 = dot(m, exponentials(G, c1, 1))
        w2 = q / K + dot(b, exponentials(G, c2 - start, 0, (-1,)))
        s2 = dot(b, exponentials(G, c2 - start, 1, (-1,)))
        return a, w1, s1, w2, s2

    def equations(c1, c2):
        _, w1, s1, w2, s2 = state(c1, c2)
        l = k * (c2 - c1)
        return (s1 - k * (w2 - w1 * mp.cosh(l)) / mp.sinh(l), s2 - k * (w2 * mp.cosh(l) - w1) / mp.sinh(l))

    def free(f, x, order):
        return dot(f, powers(x, order)) + q / EI * x ** (4 - order) / mp.factorial(4 - order)

    c1, c2 = mp.findroot(equations, (mp.mpf("1.3"), mp.mpf(start)))
    a, *_ = state(c1, c2)
    m, f = a[:4], a[4:8]
    top = mp.findroot(lambda x: free(f, x, 1), (c1 + c2) / 2 + mp.mpf("0.2"))
    return c1, c2, q / K + dot(m, exponentials(G, 0, 0)), -free(f, top, 0)


def finite(G, length, moment, force, endless):
    """Beam of unit weight with a moment that lifts its start and a force on its end: lift-off, w at both ends, and the
    force of the ground on the end, which is positive."""
    k = mp.sqrt(K / G)
    q = mp.mpf(1)

    def at(a):
        n = 8
        def row(free=None, touch=None):
            out = [mp.mpf(0)] * n
            for at_, values in ((0, free), (4, touch)):
                for i, value in enumerate(values or []):
                    out[at_ + i] = value
            return out
        rows = [(row(powers(0, 2)), moment / EI), (row(powers(0, 3)), 0)]
        for order in range(4):
            weight = q / EI * a ** (4 - order) / mp.factorial(4 - order)
            level = q / K if order == 0 else 0
            rows.append((row(powers(a, order), [-v for v in exponentials(G, a, order)]), level - weight))
        tip = G * k if endless else mp.mpf(0)
        last = [EI * x - G * y - tip * z for x, y, z in
                zip(*(exponentials(G, length, o) for o in (3, 1, 0)))]
        rows += [(row(None, exponentials(G, length, 2)), 0), (row(None, last), tip * q / K - force)]
        c = solve_linear(rows)
        w = q / K + dot(c[4:], exponentials(G, a, 0))
        rise = k * w * (1 if endless else mp.tanh(k * a))
        return c, dot(c[4:], exponentials(G, a, 1)) - rise

    a = mp.findroot(lambda a: at(a)[1], (mp.mpf("1.0"), mp.mpf("1.2")))
    c, _ = at(a)
    end = q / K + dot(c[4:], exponentials(G, length, 0))
    slope = dot(c[4:], exponentials(G, length, 1))
    return a, c[0], end, G * slope + (G * k * end if endless else 0)


if __name__ == "__main__":
    text = lambda values: ", ".join(mp.nstr(v, 15) for v in values)
    for G in ("0.01", "0.1", "0.5", "1.5"):
        print("point load", G, text(point_load(mp.mpf(G))))
    for G, force, start in (("0.1", 80, "4.0"), ("0.1", 200, "6.0"), ("0.3", 120, "5.0")):
        try:
            print("heavy", G, force, text(heavy(mp.mpf(G), mp.mpf(force), mp.mpf(start))))
        except Exception as error:
            print("heavy", G, force, error)
    for endless in (False, True):
        for G in ("0.1", "0.5"):
            print("moment", G, endless, text(finite(mp.mpf(G), mp.mpf(4), mp.mpf("-0.8"), mp.mpf("0.5"), endless)))
