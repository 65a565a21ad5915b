"""The look of the figures: colours, axes, decimation, and figures as inline SVG.

Figures are made with the object-oriented interface alone: no pyplot, no global state, so that reports can be made
in several threads. The colours are those of Okabe and Ito (2008), which readers with colour-vision deficiency can
tell apart.
"""

from __future__ import annotations

import io
import re
from html import escape
from itertools import pairwise
from threading import Lock
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import same_color, to_rgba
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"
INK, RULE, MUTED = "#1f2d3d", "#ccd5de", "#7a8896"
"""Colours of text and points, of rules and grids, and of things in the background."""

CYCLE = (BLUE, VERMILLION, GREEN, PURPLE, ORANGE, SKY)
MARKERS = ("o", "s", "^", "D", "v", "P")
COMPONENT_COLOURS = {"X": GREEN, "Y": BLUE, "N": VERMILLION, "K": PURPLE}

PANEL = (3.45, 2.35)
"""Width and height in inch of a figure that shares a row with others."""

CROWD, CROWD_DPI = 120, 160
"""More marks than this in one artist are drawn as an image inside the SVG, with this resolution."""

_VARIABLE_COLOURS = {INK: "var(--ink)", RULE: "var(--rule)", MUTED: "var(--muted)"}
_COLOUR = re.compile("|".join(_VARIABLE_COLOURS), re.IGNORECASE)
_HEADER = re.compile(r"^.*?<svg [^>]*?viewBox=\"(?P<box>[^\"]+)\"[^>]*>", re.DOTALL)
_NOTHING = re.compile(r"\s*<g id=\"patch_\d+\">\s*<path d=\"[^\"]*\" style=\"fill: none\"/>\s*</g>")

# the SVG writer takes its settings from matplotlib's global ones
_WRITER = Lock()


class Sheet:
    """One figure with one pair of axes, used again for each panel: making ticks anew is what takes time.

    Parameters
    ----------
    size : (float, float)
        Width and height in inch.
    margins : (float, float, float, float)
        Left, right, bottom and top margin in inch.
    """

    def __init__(
        self,
        size: tuple[float, float] = PANEL,
        margins: tuple[float, float, float, float] = (0.66, 0.1, 0.46, 0.12),
    ) -> None:
        width, height = size
        left, right, bottom, top = margins
        self.figure = Figure(figsize=size, facecolor="none")
        across, up = width - left - right, height - bottom - top
        self.axes = self.figure.add_axes((left / width, bottom / height, across / width, up / height))
        style_axes(self.axes)
        # labels stand in line from panel to panel, whatever the width of the tick labels
        self.axes.xaxis.set_label_coords(0.5, -(bottom - 0.2) / up)
        self.axes.yaxis.set_label_coords(-(left - 0.13) / across, 0.5)

    def fresh(self) -> Axes:
        """The axes without what was drawn before."""
        ax = self.axes
        legend = ax.get_legend()
        if legend is not None:
            legend.remove()
        for artist in (*ax.lines, *ax.collections, *ax.patches, *ax.texts, *ax.images):
            artist.remove()
        ax.containers.clear()
        ax.set_xlabel("")
        ax.set_ylabel("")
        ax.relim()
        ax.autoscale()
        return ax

    def svg(self, name: str, text: str) -> str:
        """The figure as inline SVG; see :func:`inline_svg`."""
        return inline_svg(self.figure, name, text)


def new_axes(size: tuple[float, float] = PANEL, **more: Any) -> Axes:
    """Axes of a new figure in the style of the reports."""
    return Sheet(size, **more).axes


def style_axes(ax: Axes) -> None:
    """Set spines, ticks, grid and label sizes of `ax`."""
    ax.set_facecolor("none")
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        ax.spines[side].set_color(RULE)
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(MaxNLocator(5))
        axis.label.set(fontsize=9, color=INK)
        axis.get_offset_text().set(fontsize=7.5, color=INK)
    # the grid marks the ticks already
    ax.tick_params(labelsize=8, labelcolor=INK, left=False, bottom=False)
    ax.grid(True, color=RULE, linewidth=0.5)
    ax.set_axisbelow(True)


def small_legend(ax: Axes, **more: Any) -> None:
    """Legend without a frame, when something in the axes is labelled."""
    handles, labels = ax.get_legend_handles_labels()
    if handles:
        settings: dict[str, Any] = {"fontsize": 7.5, "frameon": False, "labelcolor": INK, "handlelength": 1.4}
        ax.legend(handles, labels, **(settings | more))


def _rasterise_crowds(figure: Figure) -> None:
    """Draw hundreds of marks as one image: as single shapes they make the page heavy and slow to build.

    An image cannot follow the page, so ink becomes a grey that is seen on light and on dark paper.
    """
    for ax in figure.axes:
        for line in ax.lines:
            if line.get_marker() not in ("None", None, "", " ") and np.size(line.get_xdata()) > CROWD:
                line.set_rasterized(True)
                if same_color(line.get_color(), INK):
                    line.set_color(MUTED)
        for collection in ax.collections:
            if len(collection.get_paths()) > CROWD or np.shape(collection.get_offsets())[0] > CROWD:
                collection.set_rasterized(True)
                if isinstance(collection, LineCollection) and np.allclose(
                    collection.get_edgecolor(), to_rgba(INK)
                ):
                    collection.set_color(MUTED)


def inline_svg(figure: Figure, name: str, text: str) -> str:
    """SVG of a figure to be put into a page.

    Parameters
    ----------
    figure : Figure
    name : str
        Unique in the page: the identifiers inside the drawing are made from it.
    text : str
        What the figure shows, for readers who do not see it.

    Returns
    -------
    str
        An ``svg`` element without fixed size; ink, rules and muted parts take the page's ``--ink``, ``--rule`` and
        ``--muted``, so that it follows a dark page.
    """
    _rasterise_crowds(figure)
    stream = io.BytesIO()
    settings: Any = {"svg.fonttype": "none", "svg.hashsalt": name}
    metadata = dict.fromkeys(("Creator", "Date", "Format", "Type"))
    with _WRITER, mpl.rc_context(settings):
        figure.savefig(stream, format="svg", metadata=metadata, dpi=CROWD_DPI)
    source = _NOTHING.sub("", stream.getvalue().decode())
    opening = f'<svg viewBox="\\g<box>" role="img" aria-label="{escape(text, quote=True)}">'
    source = _HEADER.sub(opening.replace("\n", " "), source, count=1).replace("xlink:href", "href")
    return _COLOUR.sub(lambda match: _VARIABLE_COLOURS[match.group().lower()], source).strip()


def spread_evenly(count: int, most: int) -> np.ndarray:
    """Positions of at most `most` of `count` things, spread evenly, first and last among them."""
    if count <= most:
        return np.arange(count)
    return np.unique(np.linspace(0, count - 1, most).round().astype(int))


def decimated(times: np.ndarray, values: np.ndarray, limit: int = 800) -> tuple[np.ndarray, np.ndarray]:
    """A series with at most `limit` points that keeps its envelope: smallest and largest value of each stretch.

    Parameters
    ----------
    times, values : ndarray, shape (n,)
    limit : int
        Even number of points.
    """
    count = len(values)
    if count <= limit:
        return times, values
    stretches = limit // 2
    edges = np.linspace(0, count, stretches + 1).astype(int)
    picked = []
    for start, stop in pairwise(edges.tolist()):
        part = values[start:stop]
        picked += sorted({start + int(np.argmin(part)), start + int(np.argmax(part))})
    return times[picked], values[picked]


def engineering_unit(unit: str, *series: np.ndarray) -> tuple[float, str]:
    """Factor and unit with a prefix (kN, MN m) that keep the numbers of an axis short."""
    largest = max((float(np.nanmax(np.abs(values), initial=0.0)) for values in series), default=0.0)
    for size, prefix in ((1e6, "M"), (1e3, "k")):
        if largest >= 2 * size:
            return 1.0 / size, prefix + unit
    return 1.0, unit
