#!/usr/bin/python3
"""Buckling loads of a pinned column between two tensionless Pasternak media that touch it without pressure.

  column_between_layers.py        prints the rows of PinnedColumn in tests/verification/tensionless_pasternak_test.cpp

Length 1, EI = 1, K = 3000. Each medium's surface is a string of linear elements above the column, found by changes of
the active set; the column has sine waves. The load is that of the mode whose own contact gives it; errors fall with
the square of the grid, which is extrapolated. Needs python3-scipy; shares no code with the solver.
"""
import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as la
from scipy.linalg import eigh

K, WAVES = 3000.0, 60


def surface(w, T, active):
    """Active nodes of the smallest surface above w."""
    for _ in range(200):
        g = np.where(active, w, 0.0)
        free = ~active
        if free.any():
            g[free] = la.spsolve(T[free][:, free].tocsc(), -T[free][:, active] @ w[active])
        force = T @ g
        now = np.where(active, force > 0, g < w)
        if (now == active).all():
            return active
        active = now
    raise ArithmeticError("active set")


def active_of(w, G, endless):
    """From coarse grids to fine ones."""
    active = None
    stride = 64
    while stride >= 1:
        part = w[::stride]
        start = part > 0 if active is None else np.repeat(active, 2)[:part.size]
        active = surface(part, string(part.size - 1, G, endless), start)
        stride //= 2
    return active


def string(n, G, endless):
    h = 1.0 / n
    main = np.full(n + 1, 2 * G / h + 2 * K * h / 3)
    main[[0, -1]] = G / h + K * h / 3 + (np.sqrt(K * G) if endless else 0)
    off = np.full(n, -G / h + K * h / 6)
    return sp.diags([off, main, off], [-1, 0, 1]).tocsr()


def stiffness(active, T, waves):
    """Quadratic form of one medium by the amplitudes of the waves."""
    g = np.where(active[:, None], waves, 0.0)
    free = ~active
    if free.any() and active.any():
        g[free] = la.spsolve(T[free][:, free].tocsc(), -(T[free][:, active] @ waves[active]))
    return g.T @ (T @ g)


def load(G, endless, n):
    x = np.linspace(0, 1, n + 1)
    k = np.pi * np.arange(1, WAVES + 1)
    waves = np.sin(np.outer(x, k))
    T = string(n, G, endless)
    q = np.zeros(WAVES)
    q[1] = 1.0
    last = 0.0
    for _ in range(100):
        w = waves @ q
        total = np.diag(k ** 4 / 2)
        for side in (1, -1):
            total += stiffness(active_of(side * w, G, endless), T, waves)
        values, vectors = eigh(total, np.diag(k ** 2 / 2))
        at = np.argmax(np.abs(vectors.T @ np.diag(k ** 2 / 2) @ q))
        q = vectors[:, at] * np.sign(vectors[:, at] @ q)
        if abs(values[at] - last) < 1e-12 * last:
            return values[at]
        last = values[at]
    raise ArithmeticError("mode")


if __name__ == "__main__":
    for G, endless in ((1.0, False), (5.0, False), (20.0, False), (20.0, True), (50.0, True)):
        coarse, fine = load(G, endless, 2048), load(G, endless, 4096)
        print(G, endless, f"{fine + (fine - coarse) / 3:.8f}", f"{coarse:.6f} {fine:.6f}")
