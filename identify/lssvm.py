"""Least-squares support vector machine as a scikit-learn regressor."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Literal

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import _check_sample_weight, check_is_fitted, validate_data

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .lssvm_choice import Criterion, LSSVMChoice, checked_gammas, choose_gamma_sigma
from .lssvm_curve import LSSVMCurve, fit_lssvm_curve, is_uniform
from .lssvm_dual import DualFit, dual_spectrum, solve_dual
from .lssvm_kernels import GaussianKernel, Kernel, PolynomialKernel, SigmaConvention, squared_length
from .lssvm_linear import BIAS
from .lssvm_primal import LinearFeatures, PrimalFit, PrimalSystem, landmark_features
from .lssvm_spectrum import CentredSpectrum, groups_of_several
from .lssvm_weights import suykens_weights

Solver = Literal["auto", "dual", "primal", "fixed_size", "toeplitz"]
RELATIVE_GAMMAS = np.logspace(-6.0, 8.0, 29)
GAUSSIAN_GAMMAS = np.logspace(-1.0, 8.0, 10)
RELATIVE_SIGMAS = np.logspace(-1.5, 1.0, 10)
# A uniform record this long goes the Toeplitz way by itself; a dense problem larger than this needs to be asked for.
LONG_RECORD, LARGEST_DUAL = 500, 15_000


class LSSVMRegressor(RegressorMixin, BaseEstimator):
    """LS-SVM: min |w|^2 / 2 + gamma/2 sum v_i e_i^2 with y_i = w . phi(x_i) + b + e_i.

    Inputs are used as they are: scale columns of unlike units first (``StandardScaler``).

    Parameters
    ----------
    kernel : {"rbf", "poly", "linear"}
        exp(-|x - z|^2 / sigma^2), (x . z + offset)^degree, or x . z.
    gamma : float, optional
        Weight of the errors against the smoothness; chosen by `criterion` when omitted.
    sigma : float, optional
        Width of the ``rbf`` kernel; chosen when omitted.
    sigma_convention : {"sigma2", "2sigma2"}
        Kernel exp(-d^2/sigma^2), or exp(-d^2/(2 sigma^2)).
    degree, offset : int, float
        Of the ``poly`` kernel.
    gammas, sigmas : sequence of float, optional
        Candidates. Without them, gammas are 0.1 to 1e8 (``rbf``) or 1e-6 to 1e8 over the mean square of the centred
        features, and sigmas 0.03 to 10 times the root mean square distance between samples.
    criterion : {"loo", "gcv"}
        Exact leave-one-out error or generalised cross-validation. Samples with the same input are left out
        together by ``loo``: a repeated measurement does not vouch for itself.
    refine : bool
        Search between the candidates too.
    reweightings : int
        Robust reweightings; 1 is the procedure of Suykens et al. (2002). gamma and sigma are chosen anew after each.
    solver : {"auto", "dual", "primal", "fixed_size", "toeplitz"}
        ``dual``: dense system of all samples. ``primal``: linear kernel. ``fixed_size``: at most `n_landmarks`
        samples carry the function. ``toeplitz``: ``rbf`` kernel of one uniformly sampled column. ``auto`` takes
        ``primal`` for the linear kernel, ``toeplitz`` where it applies to 500 samples or more, ``dual`` otherwise.
    n_landmarks : int
        See ``fixed_size``.

    Attributes
    ----------
    gamma_, sigma_ : float
        sigma_ is nan for kernels without width.
    choice_ : LSSVMChoice or None
        How they were chosen; None when nothing was left to choose.
    solver_ : str
    intercept_ : float
        The bias b.
    dual_coef_ : ndarray, shape (n,)
        gamma v_i e_i of each sample.
    coef_ : ndarray, shape (n_features,)
        Coefficients (linear kernel only).
    coefficients_ : CoefficientTable
        The same and the bias, with their covariance by noise alone (linear kernel with solver ``primal``).
    loo_residuals_, leverage_ : ndarray, shape (n,)
        Exact residual of each sample by the fit of the others; diagonal of the hat matrix. Samples of no weight
        are not among the n.
    loo_rmse_ : float
        Root of the weighted mean square of `loo_residuals_`.
    effective_dof_ : float
        Trace of the hat matrix.
    noise_variance_ : float
        Variance of an error of weight 1: weighted residual sum of squares over n - effective_dof.
    row_weights_ : ndarray, shape (n,)
        Weights of the robust reweighting, 1 without it.
    solution_ : DualFit, PrimalFit or LSSVMCurve
    n_features_in_ : int
    feature_names_in_ : ndarray
        Only when X has column names.
    """

    def __init__(
        self,
        kernel: Literal["rbf", "poly", "linear"] = "rbf",
        *,
        gamma: float | None = None,
        sigma: float | None = None,
        sigma_convention: SigmaConvention = "sigma2",
        degree: int = 3,
        offset: float = 1.0,
        gammas: Sequence[float] | None = None,
        sigmas: Sequence[float] | None = None,
        criterion: Criterion = "loo",
        refine: bool = True,
        reweightings: int = 0,
        solver: Solver = "auto",
        n_landmarks: int = 300,
    ) -> None:
        self.kernel = kernel
        self.gamma = gamma
        self.sigma = sigma
        self.sigma_convention = sigma_convention
        self.degree = degree
        self.offset = offset
        self.gammas = gammas
        self.sigmas = sigmas
        self.criterion = criterion
        self.refine = refine
        self.reweightings = reweightings
        self.solver = solver
        self.n_landmarks = n_landmarks

    def fit(self, X: Any, y: Any, sample_weight: Any = None, groups: Any = None) -> LSSVMRegressor:
        """Fit to X (n, p) and y (n,).

        Parameters
        ----------
        X : array_like, shape (n, p)
        y : array_like, shape (n,)
        sample_weight : array_like, shape (n,), optional
            Weight of each sample's squared error (inverse variance); a whole number counts as repetitions.
        groups : array_like, shape (n,), optional
            Run of each sample: gamma and sigma are chosen by leaving out whole runs.

        Raises
        ------
        FitError
            If the inputs do not vary, a parameter is out of range, or the solver does not fit the kernel.
        """
        X, y = validate_data(self, X, y, dtype=np.float64, y_numeric=True, ensure_min_samples=2)
        weights = _check_sample_weight(sample_weight, X, dtype=np.float64)
        if (weights < 0.0).any():
            raise FitError("a sample weight is negative", cure="use weights of 0 or more")
        kept = weights > 0.0
        labels = None if groups is None else np.asarray(groups)
        if labels is not None and labels.shape != y.shape:
            raise FitError(f"{labels.size} group labels for {y.size} rows", cure="give one a row")
        x, y, weights = X[kept], np.asarray(y, dtype=float)[kept], weights[kept]
        labels = None if labels is None else labels[kept]
        self._check(x)
        self.solver_ = self._solver_for(x, labels)
        if self.solver_ == "toeplitz":
            self._fit_curve(x, y, weights)
        else:
            self._fit_samples(x, y, weights, labels)
        return self

    def predict(self, X: Any, return_std: bool = False) -> Any:
        """Function at X (m, p), shape (m,); with its standard deviation when `return_std`.

        The standard deviation is that of the posterior of a Gaussian process with covariance gamma s^2 k, a free
        constant and independent errors of variance s^2 / v_i, s^2 = `noise_variance_`. Its intervals hold the
        smoothing bias on average over the samples (Wahba 1983, Nychka 1988), not at each point, and take gamma and
        sigma for known: chosen ones cost intervals of the function some percent of coverage (92 % of nominal 95 %
        on 100 samples).
        """
        x = self._checked(X)
        value = self.solution_(x[:, 0]) if isinstance(self.solution_, LSSVMCurve) else self._function.value(x)
        return (value, np.sqrt(self.noise_variance_ * self._unit_variance(x))) if return_std else value

    def predict_interval(
        self, X: Any, confidence: float = 0.95, observation: bool = True
    ) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limit at X (m, p), each of shape (m,).

        Parameters
        ----------
        X : array_like, shape (m, p)
        confidence : float
        observation : bool
            Interval of a new observation of weight 1; of the function when false.
        """
        from scipy.stats import t as student

        x = self._checked(X)
        unit = self._unit_variance(x) + (1.0 if observation else 0.0)
        dof = max(self.leverage_.size - self.effective_dof_, 1.0)
        half = student.ppf(0.5 + 0.5 * confidence, dof) * np.sqrt(self.noise_variance_ * unit)
        value = self.predict(X)
        return value - half, value + half

    def gradient(self, X: Any) -> np.ndarray:
        """First derivatives of the function at X (m, p), shape (m, p)."""
        x = self._checked(X)
        if isinstance(self.solution_, LSSVMCurve):
            return self.solution_(x, 1)
        return self._function.gradient(x)

    def hessian(self, X: Any) -> np.ndarray:
        """Second derivatives of the function at X (m, p), shape (m, p, p)."""
        x = self._checked(X)
        if isinstance(self.solution_, LSSVMCurve):
            return self.solution_(x, 2)[:, :, None]
        return self._function.hessian(x)

    def _checked(self, X: Any) -> np.ndarray:
        check_is_fitted(self)
        return np.asarray(validate_data(self, X, dtype=np.float64, reset=False))

    def _unit_variance(self, x: np.ndarray) -> np.ndarray:
        if isinstance(self.solution_, LSSVMCurve):
            curve = self.solution_
            return curve.solution.unit_variance((x[:, 0] - curve.time[0]) / curve.step)
        return self.solution_.unit_variance(x)

    def _check(self, x: np.ndarray) -> None:
        if self.kernel not in ("rbf", "poly", "linear"):
            raise FitError(f"there is no kernel '{self.kernel}'", cure="use rbf, poly or linear")
        if self.criterion not in ("loo", "gcv"):
            raise FitError(f"there is no criterion '{self.criterion}'", cure="use loo or gcv")
        if self.reweightings < 0:
            raise FitError(f"{self.reweightings} reweightings cannot be done", cure="use 0 or more")
        if len(x) < 2:
            raise FitError("fewer than two samples have weight", cure="give at least two")
        flat = np.ptp(x, axis=0) == 0.0
        if flat.all() or (flat.any() and self.kernel == "linear"):
            named = getattr(self, "feature_names_in_", [f"x{j}" for j in range(x.shape[1])])
            column = named[int(np.argmax(flat))]
            raise FitError(f"column '{column}' does not vary: it cannot be told from the bias", cure="drop it")

    def _solver_for(self, x: np.ndarray, labels: np.ndarray | None) -> str:
        uniform = self.kernel == "rbf" and x.shape[1] == 1 and labels is None and is_uniform(x[:, 0])
        if self.solver == "auto":
            if self.kernel == "linear":
                return "primal"
            if uniform and len(x) >= LONG_RECORD:
                return "toeplitz"
            if len(x) > LARGEST_DUAL:
                raise FitError(
                    f"{len(x)} samples make a dense system of {8e-9 * len(x) ** 2:.1f} GB",
                    cure="use solver='fixed_size', or solver='dual' if that is wanted",
                )
            return "dual"
        fits = {
            "dual": True,
            "primal": self.kernel == "linear",
            "fixed_size": self.kernel != "linear" and self.n_landmarks >= 1,
            "toeplitz": uniform,
        }
        if self.solver not in fits:
            raise FitError(
                f"there is no solver '{self.solver}'", cure="use auto, dual, primal, fixed_size or toeplitz"
            )
        if not fits[self.solver]:
            reason = {
                "primal": "needs the linear kernel",
                "fixed_size": "needs the rbf or poly kernel and at least one landmark",
                "toeplitz": "needs the rbf kernel, one uniformly sampled increasing column, and no groups",
            }[self.solver]
            raise FitError(f"solver '{self.solver}' {reason}", cure="use solver='auto'")
        return self.solver

    def _fit_curve(self, x: np.ndarray, y: np.ndarray, weights: np.ndarray) -> None:
        curve = fit_lssvm_curve(
            x[:, 0],
            y,
            gamma=self.gamma,
            sigma=self.sigma,
            gammas=self.gammas,
            sigmas=self.sigmas,
            convention=self.sigma_convention,
            criterion=self.criterion,
            refine=self.refine,
            weights=None if np.all(weights == 1.0) else weights,
            reweightings=self.reweightings,
        )
        self.solution_: DualFit | PrimalFit | LSSVMCurve = curve
        self.gamma_, self.sigma_, self.choice_ = curve.gamma, curve.sigma, curve.choice
        self.row_weights_, self.intercept_ = curve.row_weights, curve.bias
        self._learn(y, curve.weights, curve.fitted, curve.solution.open)

    def _fit_samples(self, x: np.ndarray, y: np.ndarray, weights: np.ndarray, labels: np.ndarray | None) -> None:
        codes = np.unique(x, axis=0, return_inverse=True)[1].reshape(-1) if labels is None else labels
        members = groups_of_several(codes, len(y))
        own = np.ones(len(y))
        for left in range(self.reweightings, -1, -1):
            settled = weights * own
            self.gamma_, self.sigma_, self.choice_ = self._chosen(x, y, settled, members)
            kernel = self._kernel(self.sigma_)
            solution: DualFit | PrimalFit
            if self.solver_ == "dual":
                solution = solve_dual(kernel, x, y, settled, self.gamma_)
            else:
                solution = self._primal(kernel, x, settled).solve(y, self.gamma_)
            if left:
                own = suykens_weights((y - solution.fitted) * np.sqrt(weights))
        self.row_weights_, self.solution_, self._function = own, solution, solution.function
        self.intercept_ = self._function.bias
        self._learn(y, settled, solution.fitted, solution.open)
        if self.kernel == "linear":
            self._name_coefficients(x, y)

    def _chosen(
        self, x: np.ndarray, y: np.ndarray, weights: np.ndarray, members: list[np.ndarray]
    ) -> tuple[float, float, LSSVMChoice | None]:
        sigmas = self._sigma_candidates(x, weights)
        spectrum = self._spectrum_maker(x, weights)
        if self.gamma is not None:
            gammas = checked_gammas([self.gamma])
        elif self.gammas is not None:
            gammas = checked_gammas(self.gammas)
        elif self.kernel == "rbf":
            gammas = GAUSSIAN_GAMMAS
        else:
            gammas = RELATIVE_GAMMAS / (float(spectrum(math.nan).squares.sum()) / float(weights.sum()))
        if gammas.size * len(sigmas) == 1:
            return float(gammas[0]), float(sigmas[0]), None
        rooted = y * np.sqrt(weights)
        choice = choose_gamma_sigma(
            lambda sigma, candidates: spectrum(sigma).scores(rooted, candidates, self.criterion, members),
            gammas,
            sigmas,
            refine=self.refine,
        )
        return choice.gamma, choice.sigma, choice

    def _spectrum_maker(self, x: np.ndarray, weights: np.ndarray) -> Callable[[float], CentredSpectrum]:
        last: list[tuple[float, CentredSpectrum]] = []

        def spectrum(sigma: float) -> CentredSpectrum:
            # A kernel without width has one spectrum, and the search stays at one sigma for some steps.
            if not last or not (last[0][0] == sigma or self.kernel != "rbf"):
                kernel = self._kernel(sigma)
                made = (
                    dual_spectrum(kernel, x, weights)
                    if self.solver_ == "dual"
                    else self._primal(kernel, x, weights).spectrum
                )
                last[:] = [(sigma, made)]
            return last[0][1]

        return spectrum

    def _sigma_candidates(self, x: np.ndarray, weights: np.ndarray) -> np.ndarray:
        if self.kernel != "rbf":
            return np.array([math.nan])
        if self.sigma is not None or self.sigmas is not None:
            values = np.array([self.sigma] if self.sigma is not None else self.sigmas, dtype=float)
        else:
            mean = weights @ x / weights.sum()
            values = RELATIVE_SIGMAS * math.sqrt(
                2.0 * float(weights @ ((x - mean) ** 2).sum(axis=1) / weights.sum())
            )
        for value in values:
            squared_length(float(value), self.sigma_convention)
        return values

    def _kernel(self, sigma: float) -> Kernel:
        if self.kernel == "rbf":
            return GaussianKernel(squared_length(sigma, self.sigma_convention))
        return PolynomialKernel(1, 0.0) if self.kernel == "linear" else PolynomialKernel(self.degree, self.offset)

    def _primal(self, kernel: Kernel, x: np.ndarray, weights: np.ndarray) -> PrimalSystem:
        if self.solver_ == "primal":
            return PrimalSystem(LinearFeatures(x.shape[1]), x, weights)
        return PrimalSystem(*landmark_features(kernel, x, self.n_landmarks), weights)

    def _learn(self, y: np.ndarray, weights: np.ndarray, fitted: np.ndarray, open_: np.ndarray) -> None:
        missed = y - fitted
        self.dual_coef_ = self.gamma_ * weights * missed
        self.leverage_ = 1.0 - open_
        self.effective_dof_ = float(self.leverage_.sum())
        self.loo_residuals_ = missed / open_
        self.loo_rmse_ = math.sqrt(float(weights @ self.loo_residuals_**2) / float(weights.sum()))
        self.noise_variance_ = float(weights @ missed**2) / max(y.size - self.effective_dof_, 1e-12)

    def _name_coefficients(self, x: np.ndarray, y: np.ndarray) -> None:
        if not isinstance(self.solution_, PrimalFit):
            self.coef_ = x.T @ self._function.coef
            return
        fit = self.solution_
        self.coef_ = fit.coef.copy()
        named = getattr(self, "feature_names_in_", [f"x{j}" for j in range(x.shape[1])])
        through = -fit.scatter @ fit.mean
        unit = np.block([[fit.scatter, through[:, None]], [through, 1.0 / fit.total - fit.mean @ through]])
        self.coefficients_ = CoefficientTable(
            names=(*map(str, named), BIAS),
            params=np.append(fit.coef, fit.function.bias),
            cov=self.noise_variance_ * unit,
            t_dof=np.full(x.shape[1] + 1, max(y.size - self.effective_dof_, 1.0)),
            confidence=0.95,
        )
