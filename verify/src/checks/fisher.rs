//! What the pulsar's period and width can tell of the star: rank of the Fisher matrix. Eqs. (44), (51), (52), (56), (57).
//!
//! The Fisher matrix of a signal with independent errors is `J^T J` with the Jacobian `J` of the signal by the parameters.
//! Singular values and null directions are taken of `J` itself, with columns of unit length: squaring would halve the digits.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{DMatrix, DVector, Vector3};
use num_dual::Dual64;
use twofold::Real;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::observables::Observer;
use twofold::observables::pulsar::direction::cosine_of_colatitude;
use twofold::observables::pulsar::period::{approximate_period, azimuth_offset_rate};
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::observables::pulsar::{Beam, Pulse, pulse_train};
use twofold::propagation::{AxisMotion, Motion, TaylorMotion, propagate};
use twofold::solutions::perturbation::{Constants, Kind as Precession, Perturbation, shifted_rates};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::derivation::Differentiable;
use crate::identity::{self, Identity};
use crate::paper_examples::{COEFFICIENTS, SPIN, paper_examples};
use crate::random::Point;

/// The checks of this subject.
pub fn checks() -> Vec<Check> {
    let mut checks = identity::checks::<NullDirection>().to_vec();
    checks.extend([
        Check {
            id: "fisher-rank-of-period-and-width",
            kind: Kind::Autodiff,
            equations: &[51, 52, 56, 57],
            statement: "P(t) and W(t) by the formulas leave exactly one combination of Omega^z, eps, a^(1), beta_0, chi, rho, theta_o and the phase of gamma undetermined",
            figure: "singular values of the Jacobian below 1e-12 of the largest, tp-I, 200 times over three turns of gamma",
            bound: Bound::Within(1.0, 1.0),
            reason: "rounding of the Jacobian is some 1e-15 times the square root of its 400 rows; the next singular value must be above 1e-6",
            measure: rank_of_formulas,
        },
        Check {
            id: "fisher-null-direction",
            kind: Kind::Autodiff,
            equations: &[51, 52, 56, 57],
            statement: "what is undetermined is eps against a^(1) alone, at d eps : d a^(1) = cos beta_0 : Omega^z; Omega^z itself follows from the rates, gamma' + alpha' cos beta_0",
            figure: "sine of the angle between the null vector of the Jacobian and that direction, tp-I",
            bound: Bound::AtMost(1e-10),
            reason: "rounding of the Jacobian, 1e-15 times some 20, over its second smallest singular value, 3e-3",
            measure: null_direction,
        },
        Check {
            id: "fisher-rank-of-exact-signal",
            kind: Kind::Autodiff,
            equations: &[25, 44, 57],
            statement: "the edges of the pulses of the numerical motion determine all: eps and C s / I^xx too, beside eleven more unknowns. The defect is of the perturbation formulas",
            figure: "smallest / largest singular value of the Jacobian of the pulse edges by 13 parameters, tp-I, 200 t_c",
            bound: Bound::AtLeast(1e-6),
            reason: "the Jacobian is right to some 1e-11 (duals through a motion of accuracy 1e-14, growing with time): a singular value below 1e-9 could be rounding",
            measure: rank_of_signal,
        },
        Check {
            id: "pulse-edge-derivatives",
            kind: Kind::Oracle,
            equations: &[44],
            statement: "derivatives of the pulse edges by duals and the implicit function theorem are those of moved pulse trains",
            figure: "largest difference from the central difference with steps of 1e-6 / largest derivative, by eps and by the combination of s, tp-I, 200 t_c",
            bound: Bound::AtMost(1e-6),
            reason: "an edge moves by 400 times the step: third derivatives give (400e-6)^2 = 1.6e-7; rounding of the edges, 1e-12 over the step, 1e-9 of the largest",
            measure: edge_derivatives,
        },
    ]);
    checks
}

struct NullDirection;

impl Identity for NullDirection {
    const ID: &'static str = "rates-blind-to-oblateness";
    const ROUNDED: (Kind, &'static str) = (Kind::Autodiff, "rates-blind-to-oblateness-autodiff");
    const EQUATIONS: &'static [u8] = &[31, 32, 57];
    const STATEMENT: &'static str = "the rates (57) of alpha and gamma do not change along d eps : d a^(1) = cos beta_0 : Omega^z, and Omega^z = gamma' + alpha' \
         cos beta_0";

    fn residuals<F: Differentiable>(p: &Point<F>) -> Vec<F> {
        let (spin, beta_0) = (p.rates.gamma, p.angles.beta);
        let (_, cos) = beta_0.sin_cos();
        let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = p.spheroid;
        let forced_rate = |inertia_zz: F, combination: F| constant_c * combination * cos / (inertia_zz * spin);
        // I^zz = (1 + eps) I^xx; the combination that makes a^(1) grow by Omega^z a unit while I^zz grows.
        let inertia_rate = inertia_xx * cos;
        let combination = p.s.combination();
        let combination_rate = spin * inertia_zz * spin / (constant_c * cos) + combination * inertia_rate / inertia_zz;
        let spheroid = RigidSpheroid {
            inertia_xx: F::fixed(inertia_xx),
            inertia_zz: F::first(inertia_zz, inertia_rate),
            constant_c: F::fixed(constant_c),
        };
        let s = PrincipalCoefficients {
            xx: F::fixed(p.s.xx),
            yy: F::fixed(p.s.yy),
            zz: F::first(p.s.zz, combination_rate / 2.0),
        };
        let constants = Constants {
            alpha_0: F::fixed(p.angles.alpha),
            beta_0: F::fixed(beta_0),
            amplitude: F::fixed(F::zero()),
            phase: F::fixed(F::zero()),
        };
        let moved = Perturbation::printed_unchecked(Precession::Twofold, &spheroid, &s, F::fixed(spin), &constants);
        let gamma_rate = F::fixed(spin) - moved.rate * F::fixed(cos);
        // gamma' as Eq. (57) prints it.
        let oblateness = inertia_zz / inertia_xx - F::one();
        let printed = cos * forced_rate(inertia_zz, combination) - oblateness * spin;
        vec![
            F::derivative(moved.rate),
            F::derivative(gamma_rate),
            F::derivative(moved.forced_rate) - spin,
            F::value(gamma_rate) - printed,
        ]
    }
}

/// `Omega^z, eps, a^(1), beta_0, chi, rho, theta_o`, phase of `gamma`.
const FORMULA_PARAMETERS: usize = 8;

fn formula_parameters() -> [f64; FORMULA_PARAMETERS] {
    let beta_0: f64 = 0.7;
    [SPIN, 0.1, COEFFICIENTS.combination() * beta_0.cos() / (1.1 * SPIN), beta_0, 0.5, 0.6, 0.8, FRAC_PI_2]
}

/// Period by Eqs. (51), (52) and width by Eq. (56), with the rates (57), at 200 times over three turns of gamma.
fn formulas<S: Real>(parameters: &[S; FORMULA_PARAMETERS]) -> Result<Vec<S>, twofold::Error> {
    let &[spin, oblateness, forced_rate, beta_0, chi, rho, theta_o, gamma_0] = parameters;
    let one = S::one();
    let spheroid = RigidSpheroid { inertia_xx: one, inertia_zz: one + oblateness, constant_c: one };
    let (_, cos) = beta_0.sin_cos();
    let combination = forced_rate * spheroid.inertia_zz * spin / cos;
    let s = PrincipalCoefficients { xx: S::zero(), yy: S::zero(), zz: combination / 2.0 };
    let rates = shifted_rates(&spheroid, &s, spin, beta_0)?;
    let step = (TAU * 3.0 / 200.0 / rates.gamma.re()).abs();
    let mut signal = Vec::new();
    for k in 0..200 {
        let gamma = gamma_0 + rates.gamma * (step * f64::from(k));
        let offset_rate = azimuth_offset_rate(beta_0, gamma, rates.gamma, chi, S::zero())?;
        signal.push(approximate_period(rates.alpha, offset_rate));
        let cosine = cosine_of_colatitude(beta_0, gamma, chi, S::zero());
        let theta = (one - cosine * cosine).sqrt().atan2(cosine);
        // Grazing pulses have a width whose derivative is without limit.
        match pulse_width(rho, theta, theta_o) {
            PulseWidth::Pulsed(width) if width.re() > 0.1 => signal.push(width),
            _ => {}
        }
    }
    Ok(signal)
}

/// The Jacobian by one dual number per parameter.
fn jacobian<const N: usize>(
    parameters: [f64; N],
    signal: impl Fn(&[Dual64; N]) -> Result<Vec<Dual64>, String>,
) -> Result<DMatrix<f64>, String> {
    let columns = (0..N)
        .map(|seeded| {
            let mut point = parameters.map(Dual64::from);
            point[seeded].eps = 1.0;
            let derivatives: Vec<f64> = signal(&point)?.iter().map(|value| value.eps).collect();
            Ok(DVector::from_vec(derivatives))
        })
        .collect::<Result<Vec<_>, String>>()?;
    Ok(DMatrix::from_columns(&columns))
}

/// A matrix with its columns scaled to unit length, decomposed.
struct ScaledSvd {
    /// Singular values, largest first.
    values: Vec<f64>,
    /// Right singular vectors as rows.
    vectors: DMatrix<f64>,
    /// Lengths of the columns.
    lengths: Vec<f64>,
}

fn scaled_svd(jacobian: &DMatrix<f64>) -> Result<ScaledSvd, String> {
    let lengths: Vec<f64> = jacobian.column_iter().map(|column| column.norm()).collect();
    if !lengths.iter().all(|length| length.is_finite() && *length > 0.0) {
        return Err(format!("lengths of the columns of the Jacobian: {lengths:?}"));
    }
    let mut scaled = jacobian.clone();
    for (mut column, length) in scaled.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let svd = scaled.svd(false, true);
    let vectors = svd.v_t.ok_or("no singular vectors")?;
    Ok(ScaledSvd { values: svd.singular_values.iter().copied().collect(), vectors, lengths })
}

fn formula_jacobian() -> Result<DMatrix<f64>, String> {
    jacobian(formula_parameters(), |p| formulas(p).map_err(|e| e.to_string()))
}

fn rank_of_formulas() -> Result<Measured, String> {
    let ScaledSvd { values, .. } = scaled_svd(&formula_jacobian()?)?;
    let detail = format!("singular values {}", listed(&values));
    let second_smallest = values[values.len() - 2] / values[0];
    if second_smallest.is_nan() || second_smallest < 1e-6 {
        return Err(format!("no clear rank: {detail}"));
    }
    let zero = values.iter().filter(|value| **value < 1e-12 * values[0]).count();
    Ok(Measured::new(zero as f64, detail))
}

fn null_direction() -> Result<Measured, String> {
    let ScaledSvd { values, vectors, lengths } = scaled_svd(&formula_jacobian()?)?;
    let null = vectors.row(values.len() - 1).transpose();
    let parameters = formula_parameters();
    let mut expected = DVector::zeros(FORMULA_PARAMETERS);
    // In scaled parameters, as the singular vectors are.
    expected[1] = parameters[3].cos() * lengths[1];
    expected[2] = parameters[0] * lengths[2];
    let expected = expected.normalize();
    let across = &null - &expected * expected.dot(&null);
    let detail = null.iter().zip(&lengths).map(|(component, length)| format!("{:.2e}", component / length));
    Ok(Measured::new(
        largest([across.norm()]),
        format!("null direction in the parameters' order {}", detail.collect::<Vec<_>>().join(", ")),
    ))
}

/// `Omega^z, eps, 2 s^ZZ - s^XX - s^YY, s^XX - s^YY`; `alpha, beta, gamma` and the rates of the first two at the start; `chi, rho`;
/// `theta_o, phi_o`. `C / I^xx` is one: only its product with s moves the star.
const SIGNAL_PARAMETERS: usize = 13;

const SPAN: (f64, f64) = (0.0, 200.0);

fn signal_parameters() -> Result<[f64; SIGNAL_PARAMETERS], String> {
    let start = paper_examples()[0].initial_values().map_err(|e| e.to_string())?;
    let (combination, asymmetry) = (COEFFICIENTS.combination(), COEFFICIENTS.asymmetry());
    let angles = [start.alpha, start.beta, 0.0, start.alpha_rate, start.beta_rate];
    let [alpha, beta, gamma, alpha_rate, beta_rate] = angles;
    Ok([SPIN, 0.1, combination, asymmetry, alpha, beta, gamma, alpha_rate, beta_rate, 0.5, 0.6, 0.8, 0.0])
}

struct Scene<S> {
    motion: TaylorMotion<S>,
    beam: Beam<S>,
    line_of_sight: Vector3<S>,
}

fn scene<S: Real>(parameters: &[S; SIGNAL_PARAMETERS]) -> Result<Scene<S>, String> {
    let &[
        spin,
        oblateness,
        combination,
        asymmetry,
        alpha,
        beta,
        gamma,
        alpha_rate,
        beta_rate,
        chi,
        rho,
        theta_o,
        phi_o,
    ] = parameters;
    let one = S::one();
    let spheroid = RigidSpheroid { inertia_xx: one, inertia_zz: one + oblateness, constant_c: one };
    let zz = combination / 3.0;
    let s = PrincipalCoefficients { xx: (asymmetry - zz) / 2.0, yy: (-asymmetry - zz) / 2.0, zz };
    let (_, cos) = beta.sin_cos();
    let rates = EulerRates { alpha: alpha_rate, beta: beta_rate, gamma: spin - alpha_rate * cos };
    let initial = BodyState::from_angles(&spheroid, &EulerAngles { alpha, beta, gamma }, &rates);
    Ok(Scene {
        motion: propagate(&spheroid, &s.tensor(), &initial, SPAN, 1e-14).map_err(|e| e.to_string())?,
        beam: Beam::new(chi, S::zero(), rho),
        line_of_sight: Observer::at(theta_o, phi_o).direction,
    })
}

/// Edges of all whole pulses and the rates of `m.n` there.
fn edges(scene: &Scene<f64>) -> Result<Vec<(f64, f64)>, String> {
    let Scene { motion, beam, line_of_sight } = scene;
    let train = pulse_train(motion, beam, line_of_sight, SPAN).map_err(|e| e.to_string())?;
    let whole = train.pulses.iter().filter(|pulse| pulse.is_whole());
    whole
        .flat_map(|pulse: &Pulse| [pulse.start, pulse.end])
        .map(|t| {
            let state = motion.state(t).map_err(|e| e.to_string())?;
            let [_, rate, ..] = beam.margin_rates(motion.spheroid(), motion.violation(), &state, line_of_sight);
            Ok((t, rate))
        })
        .collect()
}

/// The Jacobian of the edges.
fn signal_jacobian(parameters: [f64; SIGNAL_PARAMETERS], edges: &[(f64, f64)]) -> Result<DMatrix<f64>, String> {
    jacobian(parameters, |p| {
        let Scene { motion, beam, line_of_sight } = scene(p)?;
        let edge = |&(t, rate): &(f64, f64)| {
            let state = motion.state(Dual64::from(t)).map_err(|e| e.to_string())?;
            // m.n = cos rho stays true along an edge: dt = -d(m.n - cos rho) / (m.n)'.
            Ok(-beam.margin(&state, &line_of_sight) / rate)
        };
        edges.iter().map(edge).collect()
    })
}

fn rank_of_signal() -> Result<Measured, String> {
    let parameters = signal_parameters()?;
    let edges = edges(&scene(&parameters)?)?;
    let jacobian = signal_jacobian(parameters, &edges)?;
    let ScaledSvd { values, .. } = scaled_svd(&jacobian)?;
    let covariance = (jacobian.transpose() * &jacobian).try_inverse().ok_or("the Fisher matrix has no inverse")?;
    // Of times known to 1e-3 t_c.
    let [oblateness, combination] = [1, 2].map(|i| 1e-3 * covariance[(i, i)].sqrt() / parameters[i].abs());
    Ok(Measured::new(
        values[values.len() - 1] / values[0],
        format!(
            "{} edges; singular values {}; edges known to 1e-3 t_c give eps to {:.1} %, 2 s^ZZ - s^XX - s^YY to {:.1} %",
            edges.len(),
            listed(&values),
            oblateness * 100.0,
            combination * 100.0
        ),
    ))
}

fn edge_derivatives() -> Result<Measured, String> {
    let step = 1e-6;
    let parameters = signal_parameters()?;
    let edges_at = |parameters: &[f64; SIGNAL_PARAMETERS]| edges(&scene(parameters)?);
    let jacobian = signal_jacobian(parameters, &edges_at(&parameters)?)?;
    let mut worst = Worst::default();
    for parameter in [1, 2] {
        let moved = [1.0, -1.0].map(|sign| {
            let mut parameters = parameters;
            parameters[parameter] += sign * step;
            edges_at(&parameters)
        });
        let [above, below] = moved;
        let (above, below, column) = (above?, below?, jacobian.column(parameter));
        if above.len() != column.len() || below.len() != column.len() {
            return Err(format!("{} and {} edges for {}", above.len(), below.len(), column.len()));
        }
        let scale = largest(column.iter().map(|x| x.abs()));
        for (i, ((above, below), derivative)) in above.iter().zip(&below).zip(column.iter()).enumerate() {
            let difference = (above.0 - below.0) / (2.0 * step);
            worst.see((difference - derivative).abs() / scale, || {
                format!("parameter {parameter}, edge {i}: {derivative}")
            });
        }
    }
    worst.finish()
}

fn listed(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:.1e}")).collect::<Vec<_>>().join(", ")
}
