//! The numerical motion: against the 34-digit reference motions, its invariants, its dense output and its derivatives.

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual2_64, Dual64};
use twofold::dynamics::euler_angle_equations::{AxisAngles, euler_angle_accelerations};
use twofold::dynamics::first_integrals::{first_integrals, symmetric_adjugate};
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::lorentz_violation::PrincipalCoefficients;
use twofold::propagation::{Motion, propagate};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest, largest_component};
use crate::physical_domain::{RandomScene, scenes, worst_over};
use crate::reference::{reference_motion, reference_motions};

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "propagation-reference",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "the numerical motion of ten scenes reproduces n, L, e_x of a 34-digit integration at every listed time",
            figure: "largest error of a component",
            bound: Bound::AtMost(1e-12),
            reason: "rounding of the initial values (1e-16) and of up to 1,200 steps, grown with a phase of 600 rad",
            measure: against_reference,
        },
        Check {
            id: "propagation-error-estimate",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "the error estimate of the numerical motion is not below its true error, from accuracy 1e-3 to 1e-14",
            figure: "largest true error / estimate",
            bound: Bound::AtMost(1.0),
            reason: "an estimate below the true error is wrong",
            measure: estimate_against_reference,
        },
        Check {
            id: "propagation-integrals",
            kind: Kind::Property,
            equations: &[24],
            statement: "E, Omega^z and K of the four examples of the paper do not drift over 400 t_c",
            figure: "largest drift / sum of the magnitudes of the integral's terms",
            bound: Bound::AtMost(1e-14),
            reason: "rounding of 1,200 steps adds up as their square root, 35 times 1.1e-16",
            measure: integrals_of_examples,
        },
        Check {
            id: "propagation-random-integrals",
            kind: Kind::Property,
            equations: &[24],
            statement: "E, Omega^z, K, |n|, |e_x| and n.e_x are conserved along random motions over 50 t_c",
            figure: "largest drift / (sum of magnitudes, 2.2e-16, sqrt(steps + 1))",
            bound: Bound::AtMost(8.0),
            reason: "a random walk of the rounding of each step, a few ulp at most each",
            measure: integrals_of_random_motions,
        },
        Check {
            id: "propagation-dense-output",
            kind: Kind::Autodiff,
            equations: &[22, 25],
            statement: "the Euler angles of the dense output, differentiated twice in time by duals, satisfy Eq. (25)",
            figure: "largest (|a'' - a''(25)| sin b + |b'' - b''(25)|) sin^2 b / (size of the terms, 2.2e-16)",
            bound: Bound::AtMost(256.0),
            reason: "rounding of n is divided by sin^2 b; differentiating a series of order 22 twice multiplies its rounding by up to (22/3)^2",
            measure: dense_output_solves_equations,
        },
        Check {
            id: "propagation-derivatives",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "derivatives of the motion by a parameter, carried by duals through every step, agree with differences",
            figure: "largest |dual - difference| / largest derivative",
            bound: Bound::AtMost(1e-6),
            reason: "a central difference of step 1e-5 has 1e-10 of truncation, grown with t^3, and 1e-8 of rounding",
            measure: derivatives_by_duals,
        },
        Check {
            id: "propagation-time-reversal",
            kind: Kind::Property,
            equations: &[25],
            statement: "a random motion propagated over 30 t_c and back returns to its start",
            figure: "largest error / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the equations are reversible; what remains is the error that both ways estimate, and the other rate at which the way back turns e_x about n",
            measure: time_reversal,
        },
        Check {
            id: "propagation-units",
            kind: Kind::Property,
            equations: &[35],
            statement: "the motion in any units is the dimensionless one with time in t_c",
            figure: "largest difference / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the same motion, twice computed",
            measure: scaling_in_time_unit,
        },
        Check {
            id: "propagation-frame-covariance",
            kind: Kind::Property,
            equations: &[7, 36],
            statement: "a motion seen from a rotated inertial frame, the axis permutation (36) included, is the rotated motion",
            figure: "largest difference / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the same motion, twice computed",
            measure: frame_covariance,
        },
    ]
}

fn largest_difference(a: &BodyState<f64>, b: &BodyState<f64>) -> f64 {
    largest([
        largest_component(&(a.axis - b.axis)),
        largest_component(&(a.momentum - b.momentum)) / b.momentum.norm().max(1.0),
        largest_component(&(a.equatorial_axis - b.equatorial_axis)),
    ])
}

fn against_reference() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for reference in reference_motions() {
        let end = reference.states.last().map_or(0.0, |(t, _)| *t);
        let motion = propagate(&reference.spheroid, &reference.violation(), &reference.initial(), (0.0, end), 1e-14)?;
        for (t, state) in &reference.states {
            let ours = motion.state(*t)?;
            let differences =
                [ours.axis - state.axis, ours.momentum - state.momentum, ours.equatorial_axis - state.equatorial_axis];
            worst.see(largest(differences.iter().map(largest_component)), || format!("{} at t = {t}", reference.name));
        }
    }
    worst.finish()
}

fn estimate_against_reference() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for reference in reference_motions() {
        let end = reference.states.last().map_or(0.0, |(t, _)| *t);
        for exponent in 3..=14 {
            let accuracy = 10f64.powi(-exponent);
            let motion =
                propagate(&reference.spheroid, &reference.violation(), &reference.initial(), (0.0, end), accuracy)?;
            for (t, state) in &reference.states {
                let error = largest_difference(&motion.state(*t)?, state);
                worst.see(error / motion.error_estimate(*t), || {
                    format!("{} at t = {t}, accuracy {accuracy:e}, error {error:e}", reference.name)
                });
            }
        }
    }
    worst.finish()
}

/// `[E, Omega^z, K]` and the sums of the magnitudes of their terms.
fn integrals_and_scales(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    state: &BodyState<f64>,
) -> ([f64; 3], [f64; 3]) {
    let integrals = first_integrals(spheroid, s, state);
    let (n, l) = (state.axis.abs(), state.momentum.abs());
    let (s_size, adjugate_size) = (s.abs(), symmetric_adjugate(s).abs());
    let c = spheroid.constant_c.abs();
    let energy = l.dot(&l) / (2.0 * spheroid.inertia_xx)
        + l.dot(&n).powi(2) / (2.0 * spheroid.inertia_zz)
        + c * n.dot(&(s_size * n));
    let clebsch = l.dot(&(s_size * l)) + 2.0 * c * spheroid.inertia_xx * n.dot(&(adjugate_size * n));
    ([integrals.energy, integrals.spin, integrals.clebsch], [energy, l.dot(&n) / spheroid.inertia_zz, clebsch])
}

fn integrals_of_examples() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for name in ["tp-1", "tp-2", "sp-1", "sp-2"] {
        let scene = reference_motion(name);
        let s = scene.violation();
        let motion = propagate(&scene.spheroid, &s, &scene.initial(), (0.0, 400.0), 1e-14)?;
        let (start, scale) = integrals_and_scales(&scene.spheroid, &s, &scene.initial());
        for i in 0..=800 {
            let t = f64::from(i) / 2.0;
            let (now, _) = integrals_and_scales(&scene.spheroid, &s, &motion.state(t)?);
            for (k, label) in ["E", "Omega^z", "K"].iter().enumerate() {
                worst.see((now[k] - start[k]).abs() / scale[k], || format!("{label} of {name} at t = {t}"));
            }
        }
    }
    worst.finish()
}

fn integrals_of_random_motions() -> Result<Measured, String> {
    worst_over(1, 200, &scenes(), |scene| {
        let (spheroid, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let motion = propagate(&spheroid, &s, &initial, (0.0, 50.0), 1e-14)?;
        let end = motion.state(50.0)?;
        let ((before, scale), (after, _)) =
            (integrals_and_scales(&spheroid, &s, &initial), integrals_and_scales(&spheroid, &s, &end));
        let drift = largest((0..3).map(|k| (after[k] - before[k]).abs() / scale[k]));
        let frame = [end.axis.norm() - 1.0, end.equatorial_axis.norm() - 1.0, end.axis.dot(&end.equatorial_axis)];
        Ok(largest([drift, largest(frame.map(f64::abs))]) / (f64::EPSILON * (motion.step_count() as f64 + 1.0).sqrt()))
    })
}

fn dense_output_solves_equations() -> Result<Measured, String> {
    worst_over(2, 100, &scenes(), |scene| {
        let lift = |x: f64| Dual2_64::from_re(x);
        let spheroid = RigidSpheroid::in_units_of_tc(lift(scene.inertia_ratio));
        let s = PrincipalCoefficients::new(scene.s.map(lift)).tensor();
        let initial = scene.state();
        let lift_vector = |v: &Vector3<f64>| v.map(lift);
        let initial = BodyState {
            axis: lift_vector(&initial.axis),
            momentum: lift_vector(&initial.momentum),
            equatorial_axis: lift_vector(&initial.equatorial_axis),
        };
        // The truncation must be far below rounding: two derivatives multiply it by (order / step)^2.
        let motion = propagate(&spheroid, &s, &initial, (0.0, 10.0), 1e-16)?;
        let mut most = 0.0_f64;
        for i in 1..20 {
            let state = motion.state(Dual2_64::new(0.5 * f64::from(i), 1.0, 0.0))?;
            let angles = state.angles()?;
            let sin = angles.beta.re.sin();
            if sin.abs() < 1e-3 {
                continue;
            }
            let q = AxisAngles {
                alpha: angles.alpha.re,
                beta: angles.beta.re,
                alpha_rate: angles.alpha.v1,
                beta_rate: angles.beta.v1,
            };
            let spin = q.alpha_rate * q.beta.cos() + angles.gamma.v1;
            let (alpha, beta) = euler_angle_accelerations(&scene.spheroid(), &scene.coefficients(), spin, &q);
            let size = 1.0 + q.alpha_rate.abs().powi(2) + q.beta_rate.abs() * q.alpha_rate.abs();
            let residual = ((angles.alpha.v2 - alpha) * sin).abs() + (angles.beta.v2 - beta).abs();
            most = largest([most, residual * sin * sin / (size * f64::EPSILON)]);
        }
        Ok(most)
    })
}

fn derivatives_by_duals() -> Result<Measured, String> {
    let scene = reference_motion("tp-2");
    let at = |s_yy: f64| -> Result<BodyState<f64>, String> {
        let s = PrincipalCoefficients { yy: s_yy, ..scene.coefficients }.tensor();
        propagate(&scene.spheroid, &s, &scene.initial(), (0.0, 50.0), 1e-15)
            .and_then(|m| m.state(50.0))
            .map_err(String::from)
    };
    let lift = |x: f64| Dual64::from_re(x);
    let mut s = scene.violation().map(lift);
    s[(1, 1)].eps = 1.0;
    let spheroid = RigidSpheroid::in_units_of_tc(lift(scene.spheroid.inertia_zz));
    let initial = scene.initial();
    let initial = BodyState {
        axis: initial.axis.map(lift),
        momentum: initial.momentum.map(lift),
        equatorial_axis: initial.equatorial_axis.map(lift),
    };
    let dual = propagate(&spheroid, &s, &initial, (0.0, 50.0), 1e-15).and_then(|m| m.state(lift(50.0)))?;
    let step = 1e-5;
    let (above, below) = (at(scene.coefficients.yy + step)?, at(scene.coefficients.yy - step)?);
    let mut worst = Worst::default();
    let pairs = [
        (dual.axis, above.axis - below.axis),
        (dual.momentum, above.momentum - below.momentum),
        (dual.equatorial_axis, above.equatorial_axis - below.equatorial_axis),
    ];
    let size = largest(pairs.iter().map(|(d, _)| largest_component(&d.map(|x| x.eps))));
    for (index, (dual, difference)) in pairs.iter().enumerate() {
        let error = largest_component(&(dual.map(|x| x.eps) - difference / (2.0 * step)));
        worst.see(error / size, || format!("d/ds^YY of n, L, e_x [{index}] of tp-2 at t = 50, largest {size:.3}"));
    }
    worst.finish()
}

fn end_of(
    spheroid: &RigidSpheroid<f64>,
    s: &Matrix3<f64>,
    initial: &BodyState<f64>,
    span: (f64, f64),
) -> Result<(BodyState<f64>, f64), String> {
    let motion = propagate(spheroid, s, initial, span, 1e-13)?;
    Ok((motion.state(span.1)?, motion.error_estimate(span.1)))
}

fn time_reversal() -> Result<Measured, String> {
    worst_over(3, 200, &scenes(), |scene| {
        let (spheroid, s, initial) = (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let (end, there) = end_of(&spheroid, &s, &initial, (0.0, 30.0))?;
        let (back, back_again) = end_of(&spheroid, &s, &end, (30.0, 0.0))?;
        // The way back turns e_x about n at the rate of its own start: by what rounding has made of L.n there.
        let spin = |state: &BodyState<f64>| state.momentum.dot(&state.axis) / spheroid.inertia_zz;
        let turned = 30.0 * (spheroid.oblateness() * (spin(&end) - spin(&initial))).abs();
        Ok(largest_difference(&back, &initial) / (there + back_again + turned))
    })
}

fn scaling_in_time_unit() -> Result<Measured, String> {
    worst_over(4, 200, &scenes(), |scene| {
        let (inertia, c): (f64, f64) = (2.7e3, 0.019);
        let unit = (inertia / c).sqrt();
        let plain = end_of(&scene.spheroid(), &scene.coefficients().tensor(), &scene.state(), (0.0, 20.0))?;
        let spheroid = RigidSpheroid { inertia_xx: inertia, inertia_zz: inertia * scene.inertia_ratio, constant_c: c };
        let initial = BodyState { momentum: scene.state().momentum * (inertia / unit), ..scene.state() };
        let (scaled, estimate) = end_of(&spheroid, &scene.coefficients().tensor(), &initial, (0.0, 20.0 * unit))?;
        let scaled = BodyState { momentum: scaled.momentum / (inertia / unit), ..scaled };
        Ok(largest_difference(&scaled, &plain.0) / (plain.1 + estimate))
    })
}

fn frame_covariance() -> Result<Measured, String> {
    let compare = |scene: &RandomScene, q: &Matrix3<f64>| -> Result<f64, String> {
        let s = scene.coefficients().tensor();
        let (plain, estimate) = end_of(&scene.spheroid(), &s, &scene.state(), (0.0, 20.0))?;
        let rotated = end_of(&scene.spheroid(), &(q * s * q.transpose()), &scene.state().rotated(q), (0.0, 20.0))?;
        Ok(largest_difference(&rotated.0, &plain.rotated(q)) / (estimate + rotated.1))
    };
    worst_over(5, 200, &scenes(), |scene| {
        let any = twofold::euler_angles::body_from_inertial(&scene.angles());
        let permuted = twofold::euler_angles::permuted_from_inertial();
        Ok(largest([compare(scene, &any)?, compare(scene, &permuted)?]))
    })
}

#[cfg(test)]
mod tests {
    use twofold::dynamics::first_integrals::spin_in_angles;

    use super::*;

    /// The scale of `Omega^z` in the drift is that of its terms, not of the sum.
    #[test]
    fn spin_of_angles_and_of_state_agree() {
        let scene = reference_motion("retrograde");
        let direct = spin_in_angles(&scene.angles, &scene.rates);
        let (integrals, _) = integrals_and_scales(&scene.spheroid, &scene.violation(), &scene.initial());
        approx::assert_relative_eq!(direct, integrals[1], max_relative = 1e-15);
    }
}
