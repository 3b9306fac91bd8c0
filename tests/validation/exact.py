# SPDX-FileCopyrightText: 2026 The wellknit authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Exact steady pressures around wells. Pressures in bar, lengths in m, permeability in mD, viscosity 1 cP, rates in
m3/d."""
import numpy as np

from meshes import rate_unit

BORE_PRESSURE = 100.0


class VerticalWells:
    """Fully penetrating vertical wells in a slab: p = p_bore + sum of a_w ln(r_w / bore). Rate of well w: a_w 2 pi
    sum(k h).

    drawdown: for one well the a_w is 1. For several, `rates` gives the a_w and the pressure in each bore follows:
    100 + sum over others of a_v ln(d / bore); what another well's pressure varies across a bore, bore / d, is left
    out. `images`
    are positions that have the strength of the well with their number."""

    def __init__(self, positions, bore, conductivity, strengths=(1.0,), images=()):
        """conductivity: sum of k h, mD m. images: (x, y, number of the well)."""
        self.bore = bore
        sources = [(*p, a) for p, a in zip(positions, strengths)]
        sources += [(x, y, strengths[n]) for x, y, n in images]
        self.sources = np.array(sources)
        self.rates = [a * rate_unit(conductivity, 1.0) for a in strengths]
        self.bore_pressures = []
        for n, (x, y) in enumerate(positions):
            others = np.delete(self.sources, n, axis=0)
            distance = np.hypot(others[:, 0] - x, others[:, 1] - y)
            self.bore_pressures.append(BORE_PRESSURE + float((others[:, 2] * np.log(distance / bore)).sum()))

    def pressure(self, points):
        r = np.hypot(points[:, None, 0] - self.sources[:, 0], points[:, None, 1] - self.sources[:, 1])
        return BORE_PRESSURE + (self.sources[:, 2] * np.log(r / self.bore)).sum(axis=1)

    def gradient(self, points):
        d = points[:, None, :2] - self.sources[:, :2]
        plan = (self.sources[:, 2, None] * d / (d ** 2).sum(axis=2)[..., None]).sum(axis=1)
        return np.column_stack([plan, np.zeros(len(points))])


class LineWell:
    """A straight well of uniform pressure in a slab with closed top and base and a diagonal permeability.

    Coordinates scaled by sqrt(k / k_axis) make the rock isotropic. There the well is a row of line sources whose
    strengths give the
    same pressure in the middle of each, at the effective radius of the bore's elliptic section, half the sum of its
    half-axes
    (as in Peaceman1983); images in top and base close these. The field is harmonic whatever the number of images;
    that number
    decides how closed top and base are."""

    def __init__(self, ends, bore, permeability, slab, drawdown=10.0, segments=80, images=60):
        """ends: [2, 3]; permeability: three numbers; slab: depth of top and base."""
        k = np.asarray(permeability, float)
        self.mean = k.prod() ** (1 / 3)
        self.scale = np.sqrt(self.mean / k)
        a, b = (np.asarray(e, float) for e in ends)
        self.top, self.base = (z * self.scale[2] for z in slab)
        share = 0.5 * (1 - np.cos(np.pi * np.arange(segments + 1) / segments))  # finer towards the ends
        nodes = (a + share[:, None] * (b - a)) * self.scale
        self.starts, self.stops = nodes[:-1], nodes[1:]
        self.images = images
        self.drawdown = drawdown
        radius, aside = self._effective_radius((b - a) / np.linalg.norm(b - a), bore)
        middles = 0.5 * (self.starts + self.stops) + radius * aside
        influence = self._influence(middles, self.starts, self.stops, range(-images, images + 1))
        self.strength = np.linalg.solve(influence, np.ones(segments))
        length = np.linalg.norm(self.stops - self.starts, axis=1)
        # A strength s per length gives s / (4 pi k) times the integral of 1 / r.
        self.rates = [drawdown * rate_unit(2 * self.mean, 1.0) * float((self.strength * length).sum())]
        self.bore_pressures = [BORE_PRESSURE]

    def _effective_radius(self, direction, bore):
        """Of the bore in scaled coordinates, and a level direction across it."""
        helper = np.array([0.0, 0.0, 1.0]) if abs(direction[2]) < 0.9 else np.array([1.0, 0.0, 0.0])
        u = np.cross(direction, helper)
        u /= np.linalg.norm(u)
        v = np.cross(direction, u)
        along = direction * self.scale
        along /= np.linalg.norm(along)
        section = np.stack([u * self.scale, v * self.scale], 1)
        section -= np.outer(along, along @ section)
        aside = np.cross(along, helper)
        return bore * np.linalg.svd(section, compute_uv=False).sum() / 2, aside / np.linalg.norm(aside)

    def _influence(self, points, starts, stops, images):
        """Integrals of 1 / r over the sources and over their images of these numbers: [points, sources]."""
        out = np.zeros((len(points), len(starts)))
        period = 2 * (self.base - self.top)
        length = np.linalg.norm(stops - starts, axis=1)
        for m in images:
            for is_mirrored in (False, True):
                a, b = starts.copy(), stops.copy()
                if is_mirrored:
                    a[:, 2], b[:, 2] = 2 * self.top - a[:, 2], 2 * self.top - b[:, 2]
                a[:, 2] += m * period
                b[:, 2] += m * period
                r = np.linalg.norm(points[:, None] - a, axis=2) + np.linalg.norm(points[:, None] - b, axis=2)
                out += np.log((r + length) / (r - length))
        return out

    def pressure(self, points):
        """Every 1,000 points at a time. Far images have 8 sources in place of all."""
        near = [m for m in range(-self.images, self.images + 1) if abs(m) <= 4]
        far = [m for m in range(-self.images, self.images + 1) if abs(m) > 4]
        part = len(self.starts) // 8
        length = np.linalg.norm(self.stops - self.starts, axis=1)
        joined = (self.strength * length).reshape(8, part).sum(axis=1) / length.reshape(8, part).sum(axis=1)
        scaled = points * self.scale
        out = np.empty(len(points))
        for n in range(0, len(scaled), 1000):
            block = scaled[n:n + 1000]
            out[n:n + 1000] = self._influence(block, self.starts, self.stops, near) @ self.strength
            out[n:n + 1000] += self._influence(block, self.starts[::part], self.stops[part - 1::part], far) @ joined
        return BORE_PRESSURE + self.drawdown * (1 - out)


class PlanWell:
    """A vertical well in rock of one tensor whose axes dip: p = ln(rho / rho_w) in plan, the line sink of
    docs/algorithms/flow.md, at all depths. Nothing is closed: on layers that dip the pressure is held too."""

    def __init__(self, place, bore, permeability, height):
        """permeability: the 2 x 2 block of the tensor in plan, mD."""
        value, axes = np.linalg.eigh(np.asarray(permeability, float))
        self.place, self.axes = np.asarray(place, float), axes[:, ::-1]  # the larger first
        self.ratio = np.sqrt(value[1] / value[0])
        self.focal = bore ** 2 * (self.ratio - 1 / self.ratio)
        self.bore = bore * (np.sqrt(self.ratio) + 1 / np.sqrt(self.ratio)) / 2
        self.rates = [rate_unit(np.sqrt(value.prod()), height)]
        self.bore_pressures = [BORE_PRESSURE]

    def pressure(self, points):
        x, y = ((points[:, :2] - self.place) @ self.axes).T
        z = x / np.sqrt(self.ratio) + 1j * y * np.sqrt(self.ratio)
        root = np.sqrt(z ** 2 + self.focal)
        root = np.where((root * z.conj()).real < 0, -root, root)
        return BORE_PRESSURE + np.log(np.abs(z + root) / 2 / self.bore)


class Linear:
    """p = p0 + g x."""

    def __init__(self, start, gradient):
        self.start, self.slope = start, np.asarray(gradient, float)

    def pressure(self, points):
        return self.start + points @ self.slope

    def gradient(self, points):
        return np.broadcast_to(self.slope, points.shape)
