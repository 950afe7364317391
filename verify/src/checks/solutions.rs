//! Free rotation, steady precession and the constants of integration of the perturbation solutions.

use nalgebra::{Matrix4, Vector4};
use proptest::prelude::*;
use twofold::solutions::perturbation::constants_from_initial_values;

use crate::checks::perturbation_equations::{FORMS, KINDS};
use crate::paper_examples::PaperExample;
use crate::prelude::*;
use crate::printed::{caption_values, rounds_to};

checks! {
    /// the closed form of free rotation reproduces the 34-digit motion without Lorentz violation
    Oracle "free-rotation-reference" [48]: free_reference;
    AtMost(5e-13) "largest error of a component of n, e_x over 200 t_c";
    because "rounding of the initial state, grown with a phase of 300 rad";
    /// Eq. (34) gives the initial values in the captions of the four examples, to every digit printed
    Oracle "caption-initial-values" [34]: || {
        let differs = |(_, printed, ours): &(_, &str, f64)| !rounds_to(*ours, printed);
        let differing: Vec<_> = caption_values()?.into_iter().filter(differs).map(|(what, ..)| what).collect();
        Ok(Measured::new(differing.len() as f64, differing.join(", ")))
    };
    AtMost(0.0) "values of 16 that do not round to the printed one";
    because "rounding of the printed digits";
    /// the closed form of free rotation satisfies the regular equations of motion, L = 0 and t = 0 included
    Autodiff "free-rotation-equations" [25, 48]: free_equations;
    AtMost(8.0) "largest |d/dt - rate| / (2.2e-16, size of the rates, 1 + phase)";
    because "rounding of two rotations and of their phase";
    /// with the rates of Eq. (48) the angular momentum lies along Z
    Property "free-precession-rates" [48]: free_rates;
    AtMost(4.0) "largest |L x Z| / (2.2e-16 |L|)";
    because "rounding of the rotation matrix and of the rates";
    /// both roots of Eq. (26) make Eq. (25) hold with constant beta, for s symmetric about Z and either sign of the spin
    Property "steady-precession-equations" [25, 26]: steady_equations;
    AtMost(8.0) "largest residual of Eq. (25) / (2.2e-16, sum of the magnitudes of its terms)";
    because "the root is right to a few ulp, and each residual has four terms";
    /// as s -> 0 the single root of Eq. (26) keeps its digits: it equals its series 2 s C cos b / (I^zz Omega^z) (1 + x + 2 x^2)
    Oracle "steady-precession-limit" [26]: steady_limit;
    AtMost(4.0) "largest relative error in 2.2e-16, s from 1e-6 to 1e-300";
    because "the next term of the series is 5 x^3 < 1e-17; a difference of the two terms of (26) would lose all digits";
    /// constants of integration -> initial values (34) -> constants is the identity for the four examples
    Property "initial-values-inverse" [34]: inverse_round_trip;
    AtMost(1e-13) "largest error of alpha_0, beta_0, A cos phi, A sin phi";
    because "rounding of 1e-16 through a Newton matrix of condition up to 1e3";
    /// initial values -> constants of integration -> initial values (34) is the identity, and no smaller A was missed
    Property "initial-values-inverse-random" [34]: inverse_at_random;
    AtMost(1e-13) "largest error of an initial value";
    because "the Newton iteration ends at rounding of terms of size pi, divided by a of 0.03 at the least";
    /// the derivatives of the inverse of Eq. (34) are the inverse matrix of the derivatives of Eq. (34)
    Autodiff "initial-values-inverse-derivatives" [34]: inverse_derivatives;
    AtMost(1e-11) "largest entry of |J(inverse) J - 1|";
    because "rounding through two matrices of condition up to 1e3";
}

fn free_reference() -> Result<Measured, String> {
    let scene = reference_motion("free");
    worst_of(&scene.states, |(t, state)| {
        Ok(largest_difference(&free_rotation(&scene.spheroid, &scene.initial(), *t), state, f64::INFINITY))
    })
}

fn free_equations() -> Result<Measured, String> {
    worst_over(11, 300, &(scenes(), 0.0..100.0f64, 0..10), |(scene, t, pick)| {
        // One case in ten is at t = 0, one below the switch to the series, and one has L = 0.
        let t = if *pick == 0 { 0.0 } else { *t };
        let slow = match pick {
            1 => 1e-9,
            2 => 0.0,
            _ => 1.0,
        };
        let mut problem: Problem<Dual64> = scene.problem().map(Dual64::from_re);
        let momentum = problem.initial().momentum * Dual64::from_re(slow);
        problem = problem.starting_from(BodyState { momentum, ..*problem.initial() })?;
        let state = free_rotation(problem.spheroid(), problem.initial(), Dual64::new(t, 1.0));
        let rates = body_state_rates(problem.spheroid(), &Matrix3::zeros(), &state);
        let size = scene.state().momentum.norm() * slow;
        let moved = state.vectors().map(|v| v.map(|x| x.eps));
        let rates = rates.vectors().map(|v| v.map(|x| x.re));
        let most = largest(moved.iter().zip(&rates).map(|(moved, rate)| largest_component(&(moved - rate))));
        let unit =
            f64::EPSILON * (size * (1.0 + size * t) * (1.0 + 1.0 / scene.spheroid.inertia_zz) + f64::MIN_POSITIVE);
        Ok(most / unit)
    })
}

fn free_rates() -> Result<Measured, String> {
    worst_over(
        12,
        300,
        &(0.2..2.0f64, -3.0..3.0f64, 0.01..1.5f64, -PI..PI, -PI..PI),
        |&(ratio, spin, beta, alpha, gamma)| {
            let spheroid = RigidSpheroid::in_units_of_tc(ratio);
            let rates = free_precession_rates(&spheroid, spin, beta)?;
            let state = BodyState::from_angles(&spheroid, &EulerAngles { alpha, beta, gamma }, &rates);
            Ok(state.momentum.xy().norm() / (f64::EPSILON * state.momentum.norm()))
        },
    )
}

fn steady_equations() -> Result<Measured, String> {
    let body = (0.3..3.0f64, 0.2..2.0f64, 0.3..3.0f64);
    let spin = prop_oneof![-3.0..-0.3f64, 0.3..3.0f64];
    let domain = (body, spin, 0.05..3.09f64, -0.2..0.2f64, -0.2..0.2f64, -PI..PI);
    worst_over(13, 500, &domain, |&((inertia_xx, ratio, constant_c), spin, beta, xx, zz, alpha)| {
        let spheroid = RigidSpheroid { inertia_xx, inertia_zz: inertia_xx * ratio, constant_c };
        let s = PrincipalCoefficients { xx, yy: xx, zz };
        let mut most = 0.0_f64;
        for kind in [Precession::Twofold, Precession::Single] {
            let Ok(rate) = steady_precession_rate(kind, &spheroid, &s, spin, beta) else {
                let radicand = (inertia_xx * ratio * spin).powi(2)
                    - 8.0 * (zz - xx) * constant_c * inertia_xx * beta.cos().powi(2);
                return if radicand < 0.0 { Ok(0.0) } else { Err(format!("refused at radicand {radicand}")) };
            };
            let q = AxisAngles { alpha, beta, alpha_rate: rate, beta_rate: 0.0 };
            let (first, second) = euler_angle_residuals(&spheroid, &s, spin, &q, (0.0, 0.0));
            let (sin, cos) = beta.sin_cos();
            let terms = (sin * cos * rate * rate).abs()
                + (ratio * spin * sin * rate).abs()
                + (2.0 * (xx.abs() + zz.abs()) * constant_c / inertia_xx * sin * cos).abs();
            most = largest([most, second.abs() / terms, first.abs()]);
        }
        Ok(most / f64::EPSILON)
    })
}

fn steady_limit() -> Result<Measured, String> {
    let spheroid = RigidSpheroid::in_units_of_tc(1.1);
    let cases = [6, 8, 12, 20, 100, 300].into_iter().flat_map(|exponent| [(exponent, 1.0), (exponent, -0.7)]);
    worst_of(cases, |&(exponent, spin)| {
        let zz = -0.4 * 10f64.powi(-exponent);
        let s = PrincipalCoefficients { xx: 0.0, yy: 0.0, zz };
        let rate = steady_precession_rate(Precession::Single, &spheroid, &s, spin, 0.7)?;
        let p = 1.1 * spin;
        let x = 2.0 * zz * 0.7f64.cos().powi(2) / (p * p);
        let series = 2.0 * zz * 0.7f64.cos() / p * (1.0 + x + 2.0 * x * x);
        Ok((rate / series - 1.0).abs() / f64::EPSILON)
    })
}

const S: [f64; 3] = [0.02, 0.01, -0.04];

fn inverse_round_trip() -> Result<Measured, String> {
    let (spheroid, s) = (RigidSpheroid::in_units_of_tc(1.1), PrincipalCoefficients::new(S));
    let vector = |c: &Constants<f64>| {
        let (sin, cos) = c.phase.sin_cos();
        Vector4::new(c.alpha_0, c.beta_0, c.amplitude * cos, c.amplitude * sin)
    };
    let cases = paper_examples().into_iter().flat_map(|example| FORMS.map(|form| (example, form)));
    worst_of(cases, |&(PaperExample { kind, constants, .. }, form)| {
        let initial = Perturbation::new(form, kind, &spheroid, &s, 1.0, &constants)?.at(0.0);
        let found = constants_from_initial_values(form, kind, &spheroid, &s, 1.0, &initial)?;
        Ok(largest((vector(&found) - vector(&constants)).iter().map(|x| x.abs())))
    })
}

/// Eq. (34) is not linear: several constants can give the same initial values. The inverse takes the smallest `A`.
fn inverse_at_random() -> Result<Measured, String> {
    let (spheroid, s) = (RigidSpheroid::in_units_of_tc(1.1), PrincipalCoefficients::new(S));
    let domain = (-PI..PI, 0.2..1.1f64, 0.0..0.02f64, -PI..PI, prop_oneof![-2.0..-0.5f64, 0.5..2.0f64]);
    worst_of(FORMS.into_iter().flat_map(|form| KINDS.map(|kind| (form, kind))), |&(form, kind)| {
        worst_over(14, 200, &domain, |&(alpha_0, beta_0, amplitude, phase, spin)| {
            let constants = Constants { alpha_0, beta_0, amplitude, phase };
            let forward = |c: &Constants<f64>| {
                Ok::<_, twofold::Error>(Perturbation::new(form, kind, &spheroid, &s, spin, c)?.at(0.0))
            };
            let initial = forward(&constants)?;
            let found = constants_from_initial_values(form, kind, &spheroid, &s, spin, &initial)?;
            if found.amplitude > amplitude + 1e-12 {
                return Err(format!("A = {} where {amplitude} is possible", found.amplitude));
            }
            let vector = |q: &AxisAngles<f64>| Vector4::new(q.alpha, q.beta, q.alpha_rate, q.beta_rate);
            Ok(largest((vector(&forward(&found)?) - vector(&initial)).iter().map(|x| x.abs())))
        })
    })
}

fn inverse_derivatives() -> Result<Measured, String> {
    type Numbers = [Dual64; 4];
    let lift = |x: f64| Dual64::from_re(x);
    let (spheroid, s, spin) =
        (RigidSpheroid::in_units_of_tc(lift(1.1)), PrincipalCoefficients::new(S.map(lift)), lift(1.0));
    let cases = [(Precession::Twofold, 0.7, 0.4), (Precession::Single, 0.7, 0.01)];
    let cases = FORMS.into_iter().flat_map(|form| cases.map(|case| (form, case)));
    worst_of(cases, |&(form, (kind, beta_0, amplitude))| {
        let forward = |[alpha_0, beta_0, amplitude, phase]: Numbers| {
            let constants = Constants { alpha_0, beta_0, amplitude, phase };
            let q = Perturbation::new(form, kind, &spheroid, &s, spin, &constants)?.at(lift(0.0));
            Ok([q.alpha, q.beta, q.alpha_rate, q.beta_rate])
        };
        let backward = |[alpha, beta, alpha_rate, beta_rate]: Numbers| {
            let initial = AxisAngles { alpha, beta, alpha_rate, beta_rate };
            constants_from_initial_values(form, kind, &spheroid, &s, spin, &initial)
                .map(|c| [c.alpha_0, c.beta_0, c.amplitude, c.phase])
        };
        let jacobian = |f: &dyn Fn(Numbers) -> Result<Numbers, Error>, at: [f64; 4]| {
            let column = |i: usize| {
                let mut seeded = at.map(lift);
                seeded[i].eps = 1.0;
                Ok(Vector4::from(f(seeded)?.map(|y| y.eps)))
            };
            Ok::<_, String>(Matrix4::from_columns(&(0..4).map(column).collect::<Result<Vec<_>, String>>()?))
        };
        let constants = [FRAC_PI_2, beta_0, amplitude, 1.2];
        let initial = forward(constants.map(lift))?.map(|x| x.re);
        let product = jacobian(&backward, initial)? * jacobian(&forward, constants)?;
        Ok(largest((product - Matrix4::identity()).iter().map(|x: &f64| x.abs())))
    })
}
