import time, numpy as np
from dataclasses import replace
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.ships import named_ship
from towtank.simulate.sail import sail, sail_events
from towtank.simulate import many_draws as M

v = named_ship("kvlcc2")
v = replace(v, rate=float(sail_events(v, turning(35)).rates[0]))
rng = np.random.default_rng(1)
D = 3000
vals = v.hull.values * (1 + 0.01 * rng.standard_normal((D, len(v.hull))))
import towtank.simulate.sail as S

orig = M.sail_draws
acc = [0.0]


def timed(*a):
    t = time.process_time()
    orig(*a)
    acc[0] += time.process_time() - t


M.sail_draws = timed
for prog, tol in ((turning(35), 1e-2), (turning(35), 1e-3), (zigzag(10, overshoots=2), 1e-3)):
    best = 9e9
    bk = 9e9
    for _ in range(6):
        acc[0] = 0
        t = time.process_time()
        e = sail_events(v, prog, vals, tolerance=tol)
        dt = time.process_time() - t
        best = min(best, dt)
        bk = min(bk, acc[0])
    print(
        prog.name,
        tol,
        "steps",
        e.steps.mean(),
        "all",
        D / best,
        "kernel only",
        D / bk,
        "ns/step",
        bk / e.steps.sum() * 1e9,
    )
