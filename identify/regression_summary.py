"""Text table of a least-squares fit, laid out as analysts know it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .linear_fit import LinearFit


def summary_text(fit: LinearFit) -> str:
    """Header, coefficients with intervals, and what limits them.

    Parameters
    ----------
    fit : LinearFit

    Returns
    -------
    str
        Lines of equal width without a trailing newline.
    """
    kind = fit.covariance + (f" ({fit.covariance_note})" if fit.covariance_note else "")
    left = [
        ("Rows", f"{fit.n}"),
        ("Terms", f"{len(fit.names)}"),
        ("Residual dof", f"{fit.dof}"),
        ("Residual std", f"{fit.scale**0.5:.5g}"),
        ("Covariance", kind),
    ]
    right = [
        ("R2" if fit.has_intercept else "R2 (uncentred)", f"{fit.r2:.6f}"),
        ("R2 adjusted", f"{fit.r2_adj:.6f}"),
        ("Log-likelihood", f"{fit.loglik:.3f}"),
        ("AICc", f"{fit.aicc:.3f}"),
        ("Condition number", f"{fit.condition_number:.4g}"),
    ]
    names = max(8, *(len(name) for name in fit.names))
    percent = f"{100 * fit.confidence:.4g} %"
    head = (
        f"{'term':<{names}} {'value':>13} {'std err':>12} {'t':>9} {'P>|t|':>7} "
        f"{'lower ' + percent:>13} {'upper ' + percent:>13} {'VIF':>9}"
    )
    width = len(head)
    half = width // 2
    lines = ["Least-squares fit".center(width), "=" * width]
    for (a, b), (c, d) in zip(left, right):
        first = f"{a + ':':<16}{b}"
        lines.append(f"{first:<{half}}{c + ':':<18}{d}")
    lines += ["-" * width, head, "-" * width]
    limits = fit.conf_int()
    for j, name in enumerate(fit.names):
        lines.append(
            f"{name:<{names}} {fit.params[j]:>13.6g} {fit.bse[j]:>12.4g} {fit.tvalues[j]:>9.2f} "
            f"{fit.pvalues[j]:>7.3f} {limits[j, 0]:>13.6g} {limits[j, 1]:>13.6g} {fit.vif[j]:>9.3g}"
        )
    lines.append("=" * width)
    for group in fit.inseparable():
        lines.append("Not separable by these data: " + ", ".join(n for n in fit.names if n in group))
    outliers = fit.outlying()
    if outliers:
        shown = ", ".join(str(label) for label in outliers[:8])
        more = f" and {len(outliers) - 8} more" if len(outliers) > 8 else ""
        lines.append(f"Outlying {'rows' if fit.groups is None else 'groups'}: {shown}{more}")
    return "\n".join(lines)
