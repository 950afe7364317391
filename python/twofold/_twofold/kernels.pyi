"""
Formulas of the paper and of the star, each checked by the project's suite (docs/equations.md). Arguments are scalars or arrays, which
are broadcast as in numpy. An argument outside its domain raises `twofold.Error`.
"""

from numpy.typing import ArrayLike
from typing import Any

__all__ = ["anisotropic_potential", "combination_bound", "constant_c", "fluid_inertia_over_c", "inertia_over_c", "lambda_change", "pulse_width", "root_mean_square_eta"]

def anisotropic_potential(s_xx: ArrayLike, s_yy: ArrayLike, s_zz: ArrayLike, alpha: ArrayLike, beta: ArrayLike) -> Any:
    """
    The anisotropic energy `C (s^XX n_X^2 + s^YY n_Y^2 + s^ZZ n_Z^2)` of an axis at `alpha`, `beta` (rad) in the principal frame, Eq. (21), in units of `C`.
    """

def combination_bound(inertia_over_c: ArrayLike, spin: ArrayLike, interval: ArrayLike, cos_lambda_change: ArrayLike, eta: ArrayLike) -> Any:
    """
    The bound on `|2 s^ZZ - s^XX - s^YY|` from a change of `cos lambda` over an `interval` (s), Eq. (41), for `I^zz / C` (s^2), a spin (rad/s) and a factor `eta`.
    """

def constant_c(mass: ArrayLike, radius: ArrayLike, oblateness: ArrayLike) -> Any:
    """
    `C` (J) of a uniform spheroid of mass (kg), mean radius (m) and oblateness `epsilon = I^zz / I^xx - 1`, Eq. (12).
    """

def fluid_inertia_over_c(spin: ArrayLike) -> Any:
    """
    `I^zz / C = 4 / Omega^2` (s^2) of a fluid star that rotates at `spin` (rad/s).
    """

def inertia_over_c(density: ArrayLike, oblateness: ArrayLike) -> Any:
    """
    `I^zz / C` (s^2) of an oblate star of density (kg/m^3) and oblateness, Eq. (43), estimated.
    """

def lambda_change(lambda_: ArrayLike, chi: ArrayLike, width: ArrayLike, width_change: ArrayLike) -> Any:
    """
    The change of the angle `lambda` (rad) between the spin axis and the line of sight for a change `width_change` of the pulse width, Eq. (42).
    """

def pulse_width(rho: ArrayLike, theta: ArrayLike, theta_o: ArrayLike) -> Any:
    """
    The width `W` (rad) of the pulse of a cone of semi-open angle `rho` about an axis at the colatitude `theta`, seen from `theta_o` (rad), Eq. (56): zero without a pulse, two pi inside the cone.
    """

def root_mean_square_eta(asymmetry_ratio: ArrayLike, beta: ArrayLike) -> Any:
    """
    The `eta` that belongs to the root mean square of `d cos(lambda) / dt` over directions of the line of sight and azimuths of the axis (`eta` itself has no mean), for the asymmetry ratio `(s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)` and an axis at `beta` (rad).
    """
