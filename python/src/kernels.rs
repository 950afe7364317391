//! Verified kernels: formulas on scalars and arrays.

use pyo3::prelude::*;

/// Formulas of the paper and of the star, each checked by the project's suite (docs/equations.md). Arguments are scalars or arrays, which
/// are broadcast as in numpy. An argument outside its domain raises `twofold.Error`.
#[pymodule(submodule)]
pub mod kernels {
    use std::f64::consts::{PI, TAU};

    use pyo3::prelude::*;
    use twofold::Error;
    use twofold::lorentz_violation::PrincipalCoefficients;
    use twofold::observables::bound::{self, SpinAxisDrift};
    use twofold::observables::eta;
    use twofold::observables::pulsar::width::pulse_width as width;
    use twofold::star::spheroid_shape::SpheroidShape;
    use twofold::star::uniform_spheroid::UniformSpheroid;
    use twofold::{dynamics, star};

    use crate::arrays::{Numbers, broadcast};

    fn finite(name: &'static str, value: f64) -> Result<f64, Error> {
        Error::ensure(value.is_finite(), name, value, "a finite number").map(|()| value)
    }

    /// A result that is a finite double.
    fn result(name: &'static str, value: f64) -> Result<f64, Error> {
        Error::ensure(value.is_finite(), name, value, "finite; use other arguments").map(|()| value)
    }

    fn positive(name: &'static str, value: f64) -> Result<(), Error> {
        Error::ensure(value > 0.0 && value.is_finite(), name, value, "a finite number above zero")
    }

    /// An angle between two directions.
    fn between(name: &'static str, value: f64) -> Result<(), Error> {
        Error::ensure((0.0..=PI).contains(&value), name, value, "from 0 to pi")
    }

    /// The width `W` (rad) of the pulse of a cone of semi-open angle `rho` about an axis at the colatitude `theta`, seen from `theta_o` (rad), Eq. (56): zero without a pulse, two pi inside the cone.
    #[pyfunction]
    fn pulse_width<'py>(
        py: Python<'py>,
        rho: Numbers,
        theta: Numbers,
        theta_o: Numbers,
    ) -> PyResult<Bound<'py, PyAny>> {
        broadcast(py, [rho, theta, theta_o], |[rho, theta, theta_o]| {
            Error::ensure(rho > 0.0 && rho < PI, "rho (rad)", rho, "above zero and below pi")?;
            between("theta (rad)", theta)?;
            between("theta_o (rad)", theta_o)?;
            Ok(width(rho, theta, theta_o).angle())
        })
    }

    /// The anisotropic energy `C (s^XX n_X^2 + s^YY n_Y^2 + s^ZZ n_Z^2)` of an axis at `alpha`, `beta` (rad) in the principal frame, Eq. (21), in units of `C`.
    #[pyfunction]
    fn anisotropic_potential<'py>(
        py: Python<'py>,
        s_xx: Numbers,
        s_yy: Numbers,
        s_zz: Numbers,
        alpha: Numbers,
        beta: Numbers,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [s_xx, s_yy, s_zz, alpha, beta];
        broadcast(py, given, |[xx, yy, zz, alpha, beta]| {
            let given = [("s_xx", xx), ("s_yy", yy), ("s_zz", zz), ("alpha (rad)", alpha), ("beta (rad)", beta)];
            given.into_iter().try_for_each(|(name, value)| finite(name, value).map(drop))?;
            let s = PrincipalCoefficients::new([xx, yy, zz]);
            result("the energy", dynamics::potential::anisotropic_potential_in_angles(1.0, &s, alpha, beta))
        })
    }

    /// `C` (J) of a uniform spheroid of mass (kg), mean radius (m) and oblateness `epsilon = I^zz / I^xx - 1`, Eq. (12).
    #[pyfunction]
    fn constant_c<'py>(
        py: Python<'py>,
        mass: Numbers,
        radius: Numbers,
        oblateness: Numbers,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [mass, radius, oblateness];
        broadcast(py, given, |[mass, radius, oblateness]| {
            positive("mass (kg)", mass)?;
            positive("radius (m)", radius)?;
            let star = UniformSpheroid::from_mass(mass, radius, SpheroidShape::from_oblateness(oblateness)?)?;
            result("C (J)", star.c() * twofold::units::si::GRAVITATIONAL_CONSTANT)
        })
    }

    /// `I^zz / C` (s^2) of an oblate star of density (kg/m^3) and oblateness, Eq. (43), estimated.
    #[pyfunction]
    fn inertia_over_c<'py>(py: Python<'py>, density: Numbers, oblateness: Numbers) -> PyResult<Bound<'py, PyAny>> {
        broadcast(py, [density, oblateness], |[density, oblateness]| {
            positive("density (kg/m^3)", density)?;
            Error::ensure(oblateness > 0.0 && oblateness < 1.0, "oblateness", oblateness, "above zero and below 1")?;
            let density = density * twofold::units::si::GRAVITATIONAL_CONSTANT;
            result("I^zz / C (s^2)", star::estimates::inertia_over_c_estimate(density, oblateness))
        })
    }

    /// `I^zz / C = 4 / Omega^2` (s^2) of a fluid star that rotates at `spin` (rad/s).
    #[pyfunction]
    fn fluid_inertia_over_c<'py>(py: Python<'py>, spin: Numbers) -> PyResult<Bound<'py, PyAny>> {
        broadcast(py, [spin], |[spin]| {
            Error::ensure(spin != 0.0 && spin.is_finite(), "spin (rad/s)", spin, "a finite number other than zero")?;
            result("I^zz / C (s^2)", bound::fluid_inertia_over_c(spin))
        })
    }

    /// The change of the angle `lambda` (rad) between the spin axis and the line of sight for a change `width_change` of the pulse width, Eq. (42).
    #[pyfunction]
    fn lambda_change<'py>(
        py: Python<'py>,
        lambda_: Numbers,
        chi: Numbers,
        width: Numbers,
        width_change: Numbers,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [lambda_, chi, width, width_change];
        broadcast(py, given, |[lambda, chi, width, change]| {
            between("lambda_ (rad)", lambda)?;
            between("chi (rad)", chi)?;
            Error::ensure((0.0..=TAU).contains(&width), "width (rad)", width, "from 0 to 2 pi")?;
            finite("width_change (rad)", change)?;
            bound::lambda_change(lambda, chi, width, change)
        })
    }

    /// The bound on `|2 s^ZZ - s^XX - s^YY|` from a change of `cos lambda` over an `interval` (s), Eq. (41), for `I^zz / C` (s^2), a spin (rad/s) and a factor `eta`.
    #[pyfunction]
    fn combination_bound<'py>(
        py: Python<'py>,
        inertia_over_c: Numbers,
        spin: Numbers,
        interval: Numbers,
        cos_lambda_change: Numbers,
        eta: Numbers,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [inertia_over_c, spin, interval, cos_lambda_change, eta];
        broadcast(py, given, |[polar_inertia_over_c, spin, interval, cos_lambda_change, eta]| {
            positive("inertia_over_c (s^2)", polar_inertia_over_c)?;
            finite("spin (rad/s)", spin)?;
            positive("interval (s)", interval)?;
            let cosines = (-2.0..=2.0).contains(&cos_lambda_change);
            Error::ensure(cosines, "cos_lambda_change", cos_lambda_change, "from -2 to 2")?;
            positive("eta", eta)?;
            let drift = SpinAxisDrift { polar_inertia_over_c, spin, interval, cos_lambda_change };
            result("the bound", drift.combination_bound(eta)?)
        })
    }

    /// The `eta` that belongs to the root mean square of `d cos(lambda) / dt` over directions of the line of sight and azimuths of the axis (`eta` itself has no mean), for the asymmetry ratio `(s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)` and an axis at `beta` (rad).
    #[pyfunction]
    fn root_mean_square_eta<'py>(
        py: Python<'py>,
        asymmetry_ratio: Numbers,
        beta: Numbers,
    ) -> PyResult<Bound<'py, PyAny>> {
        let given = [asymmetry_ratio, beta];
        broadcast(py, given, |[asymmetry_ratio, beta]| {
            finite("asymmetry_ratio", asymmetry_ratio)?;
            between("beta (rad)", beta)?;
            eta::root_mean_square_eta(asymmetry_ratio, beta)
        })
    }
}
