"""The gallery of reproduced papers: one module a paper, printed value beside ours.

To add a paper, add one module ``paper_<name>.py`` with a ``PAPER`` (see :class:`~towtank.reproduce.case.Paper`).
"""

from .case import Case, Paper, half_digit
from .gallery import gallery, papers

__all__ = ["Case", "Paper", "gallery", "half_digit", "papers"]
