"""Settings of every test run."""

from __future__ import annotations

import os

# Two test processes with as many threads of linear algebra each wait for one another most of the time. Set before
# numpy is first imported; tests that start other processes hand it on.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
os.environ.setdefault("OMP_NUM_THREADS", "1")
