//! The curve of `eta` against the inclination, and the rate of the spin axis from numerical motion.

use crate::prelude::*;

/// Asymmetry ratio `(s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)` of the paper's examples, -1/11.
pub const PAPER_ASYMMETRY: f64 = -1.0 / 11.0;

/// `eta` of Eq. (41) over directions to the observer and azimuths of the spin axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EtaStatistics {
    /// For the root mean square of `d cos lambda / dt`.
    pub root_mean_square: f64,
    /// Median.
    pub median: f64,
    /// Quantile at 84 %.
    pub quantile_84: f64,
    /// Quantile at 97.5 %.
    pub quantile_975: f64,
}

impl EtaStatistics {
    /// The statistics of a distribution.
    pub fn of(distribution: &EtaDistribution) -> Self {
        let quantile = |probability| distribution.quantile(probability).expect("a probability");
        Self {
            root_mean_square: distribution.root_mean_square(),
            median: quantile(0.5),
            quantile_84: quantile(0.84),
            quantile_975: quantile(0.975),
        }
    }
}

/// One inclination of the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EtaPoint {
    /// `beta_0` (rad).
    pub beta_0: f64,
    /// `1 / |cos beta_0|`, the paper's estimate.
    pub printed: f64,
    /// Root mean square over all times of a motion that starts at the inclination `beta_0`: the single number to use for
    /// `eta`.
    pub along_motion: f64,
    /// For an axis at the inclination `beta_0` while it is observed.
    pub at_inclination: EtaStatistics,
    /// For `beta_0` as the constant of Eq. (34); `None` if that gives no inclination.
    pub at_constant: Option<EtaStatistics>,
}

/// `eta` at the inclinations `beta_0` (rad, in (0, pi), except `pi/2`, where the estimate divides by zero) for a tensor with the
/// asymmetry ratio `r`, [`PAPER_ASYMMETRY`] for that of the paper. About 0.1 ms per point.
///
/// # Errors
/// [`Error::Domain`] for an inclination whose cosine is zero to 2.2e-16.
pub fn eta_curve(asymmetry_ratio: f64, inclinations: &[f64]) -> Result<Vec<EtaPoint>, Error> {
    let point = |&beta_0: &f64| {
        Ok(EtaPoint {
            beta_0,
            printed: eta_from_inclination(beta_0)?,
            along_motion: root_mean_square_along_motion(asymmetry_ratio, beta_0),
            at_inclination: EtaStatistics::of(&EtaDistribution::new(asymmetry_ratio, SpinAxis::AtInclination(beta_0))?),
            at_constant: EtaDistribution::new(asymmetry_ratio, SpinAxis::AtConstant(beta_0))
                .ok()
                .map(|distribution| EtaStatistics::of(&distribution)),
        })
    };
    inclinations.iter().map(point).collect()
}

/// Mean of `dn/dt` over about `duration`, from the numerical motion of a star that starts spinning about its axis at the
/// azimuth `alpha` and inclination `beta`, and the direction of `L` at the mean time. In units of `t_c`.
///
/// The mean has a smooth weight that vanishes with all derivatives at both ends, so that almost nothing remains of the nutation.
pub(crate) fn numerical_axis_rate(
    s: &PrincipalCoefficients<f64>,
    spin: f64,
    (alpha, beta): (f64, f64),
    duration: f64,
) -> Result<(Vector3<f64>, Vector3<f64>), Error> {
    const SAMPLES: usize = 400;
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let axis = symmetry_axis(alpha, beta);
    let initial = AxisState { axis, momentum: axis * (spheroid.inertia_zz * spin) };
    let motion = Problem::new(spheroid, s.tensor(), initial)?.taylor((0.0, duration), 1e-12)?;
    let (mut rate, mut direction, mut total) = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for i in 1..SAMPLES {
        let x = i as f64 / SAMPLES as f64;
        let weight = (-1.0 / (x * (1.0 - x))).exp();
        let state = motion.state(x * duration)?;
        rate += state.momentum.cross(&state.axis) * (weight / spheroid.inertia_xx);
        direction += state.momentum * weight;
        total += weight;
    }
    Ok((rate / total, direction.normalize()))
}

/// `n-hat . dl/dt` for a random spin axis `l` and a random direction `n-hat` to the observer at the angle `lambda` (rad) to it, with
/// `I^zz / C = Omega^z = 1`: one over `eta` for a tensor with `|2 s^ZZ - s^XX - s^YY| = 1`.
pub fn seen_rate(random: &mut Random, s: &Matrix3<f64>, lambda: f64) -> f64 {
    let axis = symmetry_axis(random.within(0.0, TAU), random.within(-1.0, 1.0).acos());
    let across = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let (sine, cosine) = random.within(0.0, TAU).sin_cos();
    let observer = axis * lambda.cos() + (across * cosine + axis.cross(&across) * sine) * lambda.sin();
    observer.dot(&secular_axis_rate(1.0, 1.0, s, &axis))
}

/// Twelve turns of a star with the given spin: enough for `numerical_axis_rate` to average out the nutation.
pub fn twelve_turns(spin: f64) -> f64 {
    12.0 * TAU / spin
}
