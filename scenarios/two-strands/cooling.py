#!/usr/bin/env python3
"""Cools the strand `leaning` through its radius: set time and the pull of its end, worked apart from the twin.

    python3 cooling.py

Rings of equal width, explicit steps; h at the surface as it is, k and cp as materials/pla.toml has them.
"""

from math import pi, sqrt

D, RINGS, DT = 1.25e-3, 24, 5e-4
V, LENGTH, DWELL, REACH, JET, DRAUGHT = 2e-3, 0.04, 2.0, 0.025, 5.0, 0.1
AIR, START, ARREST, GLASS = 23.0, 210.0, 155.0, 60.0
MELT, EMISSIVITY, CTE = 1090.0, 0.92, 6.8e-5


def conductivity(c):
    return 0.1708 + 0.0002 * c


def capacity(c):
    return 974.0 + 5.09 * c


def transfer(surface, speed):
    """Churchill–Bernstein or Churchill–Chu, whichever is more, and radiation; W/(m² K)."""
    ts, ta = surface + 273.15, AIR + 273.15
    film = 0.5 * (ts + ta)
    r = (film / 273.15) ** 1.5
    mu, k = 1.716e-5 * r * 383.55 / (film + 110.4), 0.0241 * r * 467.15 / (film + 194)
    nu = mu * 287.05 * film / 101325
    pr, re = mu * 1007 / k, speed * D / nu
    forced = 0.3 + 0.62 * sqrt(re) * pr ** (1 / 3) / (1 + (0.4 / pr) ** (2 / 3)) ** 0.25 * (1 + (re / 282000) ** 0.625) ** 0.8
    ra = 9.80665 / film * max(ts - ta, 0) * D**3 * pr / nu**2
    free = (0.6 + 0.387 * ra ** (1 / 6) / (1 + (0.559 / pr) ** (9 / 16)) ** (8 / 27)) ** 2
    return max(forced, free) * k / D + EMISSIVITY * 5.670374e-8 * (ts**2 + ta**2) * (ts + ta)


def means():
    """Mean temperature of the section, °C, every step from the nozzle to the oldest age that matters."""
    width = D / 2 / RINGS
    areas = [pi * width**2 * (2 * i + 1) for i in range(RINGS)]
    t = [START] * RINGS
    mean = [START]
    for step in range(round((DWELL + LENGTH / V) / DT)):
        speed = JET if V * step * DT <= REACH else DRAUGHT
        inner = conductivity(t[-1]) / (width / 2)
        surface = t[-1]
        for _ in range(3):
            h = transfer(surface, speed)
            surface = (inner * t[-1] + h * AIR) / (inner + h)
        out = [2 * pi * width * (i + 1) * conductivity(0.5 * (t[i] + t[i + 1])) * (t[i] - t[i + 1]) / width for i in range(RINGS - 1)]
        out.append(pi * D * h * (surface - AIR))
        flow = [(out[i - 1] if i else 0) - out[i] for i in range(RINGS)]
        t = [x + DT * f / (MELT * capacity(x) * a) for x, f, a in zip(t, flow, areas)]
        mean.append(sum(x * a for x, a in zip(t, areas)) / (pi * D**2 / 4))
    return mean


def main():
    mean = means()
    k = next(k for k, t in enumerate(mean) if t < ARREST)
    set_s = DT * (k - (ARREST - mean[k]) / (mean[k - 1] - mean[k]))
    glass_s = DT * next(k for k, t in enumerate(mean) if t < GLASS)
    left = sum(min(t, GLASS) - AIR for t in mean[round(DWELL / DT) :]) * DT
    print(f"set after {set_s:.4f} s, {1e3 * V * set_s:.4f} mm; glass after {glass_s:.3f} s")
    print(f"still to lose {left:.1f} K s; end pulled back {CTE * V * left:.4g} m")


main()
