//! Splitting schemes: order conditions, measured orders, what they conserve, agreement with the Taylor motion, estimates.

mod many;
mod order_conditions;

use nalgebra::Matrix3;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::propagation::splitting::{
    GRADIENT_8_6_4, GRADIENT_8_6_6, GRADIENT_8_8_6, NEAR_INTEGRABLE_6_2, NEAR_INTEGRABLE_10_4, SCHEMES, SRKN_6B,
    Scheme, Splitting, propagate_by_splitting, propagate_orientation_by_best_splitting,
    propagate_orientation_by_splitting,
};
use twofold::propagation::{AxisState, Motion, propagate, propagate_axis};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest, largest_component};
use crate::physical_domain::{RandomScene, scenes, worst_over};
use crate::reference::{reference_motion, reference_motions};
use twofold::straight_line::slope;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "splitting-order-conditions",
            kind: Kind::Property,
            equations: &[25],
            statement: "the logarithm of one step of every scheme is A + B up to the orders claimed, with one, two, three and more kicks",
            figure: "largest coefficient that should vanish",
            bound: Bound::AtMost(5e-14),
            reason: "weights published with 15 digits; the logarithm adds up some hundred products of size one",
            measure: order_conditions::residuals,
        },
        Check {
            id: "splitting-orders",
            kind: Kind::Regime,
            equations: &[25],
            statement: "the error of every scheme falls with the step as its order says, at s of order one",
            figure: "largest |measured - claimed| order",
            bound: Bound::AtMost(0.35),
            reason: "the next term of the error is smaller by the square of the step, at most a tenth here",
            measure: measured_orders,
        },
        Check {
            id: "splitting-near-integrable",
            kind: Kind::Regime,
            equations: &[25],
            statement: "the error of the near-integrable schemes at large steps is of first order in s",
            figure: "largest |measured exponent of s - 1|",
            bound: Bound::AtMost(0.1),
            reason: "terms of second order in s are below a hundredth where s is below 1e-5",
            measure: factor_of_violation,
        },
        Check {
            id: "splitting-casimirs",
            kind: Kind::Property,
            equations: &[24],
            statement: "|n| and L.n keep their values over 1e6 steps of every scheme, tp-II",
            figure: "largest of ||n| - 1| and |L.n - its start|",
            bound: Bound::AtMost(2e-14),
            reason: "rounding of at most 64 steps of 17 stages, each some 1e-16, added up at random: 33 times 2e-16",
            measure: casimirs,
        },
        Check {
            id: "splitting-time-reversal",
            kind: Kind::Property,
            equations: &[25],
            statement: "300 steps of every scheme forth and as many back return to the start, tp-II: the schemes are symmetric",
            figure: "largest component of the difference",
            bound: Bound::AtMost(1e-11),
            reason: "rounding of 600 steps, at most 10,200 stages of 1e-16 added up at random and grown with a phase of 700 rad",
            measure: time_reversal,
        },
        Check {
            id: "splitting-reference",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "n, L and e_x of the ten reference scenes are those of a 34-digit integration, forced to small steps",
            figure: "largest error of a component",
            bound: Bound::AtMost(2e-12),
            reason: "truncation at steps of 0.1 t_c (5.7e-12 were measured at 0.15, sp-II at 400 t_c, and it falls with the sixth power), rounding grown with a phase of 600 rad",
            measure: against_reference,
        },
        Check {
            id: "splitting-taylor-motion",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "n, L and e_x of 200 random motions by the chosen scheme, n and L by a forced one, are those of the Taylor motion, within steps and backwards too",
            figure: "largest difference / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the same motion, computed in two ways; each states its error",
            measure: against_taylor_motion,
        },
        Check {
            id: "splitting-many-motions",
            kind: Kind::Property,
            equations: &[25],
            statement: "the numbers and errors of 90 random motions side by side do not depend on their neighbours: alone, in other company, in another order, at several times, backwards",
            figure: "number of motions with other bits",
            bound: Bound::AtMost(0.0),
            reason: "no operation mixes two lanes",
            measure: many::neighbours,
        },
        Check {
            id: "splitting-many-accuracy",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "90 random motions side by side are those of the Taylor motion to the accuracies asked, from 1e-3 to 1e-14",
            figure: "largest difference / (accuracy + error estimate of the Taylor motion)",
            bound: Bound::AtMost(1.0),
            reason: "the accuracy asked; below rounding, the rounding that the Taylor motion states, which is alike",
            measure: many::accuracy,
        },
    ]
}

fn tp_2() -> (RigidSpheroid<f64>, Matrix3<f64>, AxisState<f64>) {
    let scene = reference_motion("tp-2");
    (scene.spheroid, scene.violation(), AxisState::from(&scene.initial()))
}

fn difference(a: &AxisState<f64>, b: &AxisState<f64>) -> f64 {
    largest([a.axis - b.axis, a.momentum - b.momentum].iter().map(largest_component))
}

/// The largest error of `scheme` at 20 times up to 10 t_c of tp-II with s multiplied by `factor`.
fn error_of(scheme: &'static Scheme, factor: f64, step: f64) -> Result<(f64, f64), String> {
    let (spheroid, s, start) = tp_2();
    let s = s * factor;
    let truth = propagate_axis(&spheroid, &s, &start, (0.0, 10.0), 1e-16)?;
    let motion = propagate_by_splitting(&spheroid, &s, &start, (0.0, 10.0), scheme, step)?;
    let mut most = 0.0;
    for i in 1..=20 {
        let t = 0.5 * f64::from(i);
        let error = difference(&motion.axis_state(t)?, &truth.axis_state(t)?);
        most = largest([most, error]);
    }
    Ok((motion.step(), most))
}

fn measured_orders() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for scheme in SCHEMES {
        let largest_step = 0.06 * scheme.stages() as f64;
        let mut points = Vec::new();
        for k in 0..16 {
            let (step, error) = error_of(scheme, 20.0, largest_step / 1.15_f64.powi(k))?;
            // Smaller errors are rounding.
            if error > 1e-12 {
                points.push((step.log10(), error.log10()));
            }
        }
        let points = points.split_off(points.len().saturating_sub(5));
        let fit = slope(&points)?;
        worst.see((fit.value - f64::from(scheme.order())).abs(), || {
            format!("{}: {:.3} +- {:.3}", scheme.name, fit.value, fit.error)
        });
    }
    worst.finish()
}

fn factor_of_violation() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (scheme, step) in [
        (&NEAR_INTEGRABLE_6_2, 1.6),
        (&NEAR_INTEGRABLE_10_4, 3.0),
        (&GRADIENT_8_6_4, 1.6),
        (&GRADIENT_8_6_6, 2.0),
        (&GRADIENT_8_8_6, 2.5),
    ] {
        let mut points = Vec::new();
        for k in 0..4 {
            let factor = 1e-4 / 4f64.powi(k);
            points.push((factor.log10(), error_of(scheme, factor, step)?.1.log10()));
        }
        let fit = slope(&points)?;
        worst.see((fit.value - 1.0).abs(), || format!("{}: {:.4} +- {:.4}", scheme.name, fit.value, fit.error));
    }
    worst.finish()
}

fn casimirs() -> Result<Measured, String> {
    let (spheroid, s, start) = tp_2();
    let mut worst = Worst::default();
    for scheme in SCHEMES {
        let mut motion = Splitting::from_parts(&spheroid, &s, &start, scheme, 0.1 * scheme.stages() as f64)?;
        // Not a multiple of the steps between projections.
        for _ in 0..10 {
            motion.advance(99_999);
            let state = motion.state();
            worst.see((state.axis.norm() - 1.0).abs(), || format!("|n| of {}", scheme.name));
            let drift = (state.axis.dot(&state.momentum) - start.axis.dot(&start.momentum)).abs();
            worst.see(drift, || format!("L.n of {}", scheme.name));
        }
    }
    worst.finish()
}

fn time_reversal() -> Result<Measured, String> {
    let (spheroid, s, start) = tp_2();
    let mut worst = Worst::default();
    for scheme in SCHEMES {
        let step = 0.1 * scheme.stages() as f64;
        let mut motion = Splitting::from_parts(&spheroid, &s, &start, scheme, step)?;
        motion.advance(300);
        let mut back = Splitting::from_parts(&spheroid, &s, &motion.state(), scheme, -step)?;
        back.advance(300);
        worst.see(difference(&back.state(), &start), || scheme.name.to_string());
    }
    worst.finish()
}

fn against_reference() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for reference in reference_motions() {
        let end = reference.states.last().map_or(0.0, |(t, _)| *t);
        let (spheroid, s, start) = (reference.spheroid, reference.violation(), reference.initial());
        let motion = propagate_orientation_by_splitting(&spheroid, &s, &start, (0.0, end), &GRADIENT_8_8_6, 0.1);
        let motion = motion?;
        for (t, state) in &reference.states {
            let ours = motion.state(*t)?;
            let third_angle = largest_component(&(ours.equatorial_axis - state.equatorial_axis));
            let error = largest([difference(&AxisState::from(&ours), &AxisState::from(state)), third_angle]);
            worst.see(error, || format!("{} at t = {t}", reference.name));
        }
    }
    worst.finish()
}

fn against_taylor_motion() -> Result<Measured, String> {
    worst_over(25, 200, &scenes(), |scene: &RandomScene| {
        let (spheroid, s, state): (_, _, BodyState<f64>) =
            (scene.spheroid(), scene.coefficients().tensor(), scene.state());
        let start = AxisState::from(&state);
        let mut most = 0.0;
        for end in [40.0, -40.0] {
            let span = (0.0, end);
            let taylor = propagate(&spheroid, &s, &state, span, 1e-14)?;
            let forced = propagate_by_splitting(&spheroid, &s, &start, span, &SRKN_6B, 0.3)?;
            let chosen = propagate_orientation_by_best_splitting(&spheroid, &s, &state, span, 1e-9)?;
            for part in [0.13, 0.5, 0.77, 1.0] {
                let t = part * end;
                let theirs = taylor.state(t)?;
                let size = start.momentum.norm().max(1.0);
                let apart = |ours: &AxisState<f64>| {
                    let apart = [ours.axis - theirs.axis, (ours.momentum - theirs.momentum) / size];
                    largest(apart.iter().map(largest_component))
                };
                let estimates = forced.error_estimate(t) + taylor.error_estimate(t);
                most = largest([most, apart(&forced.axis_state(t)?) / estimates]);
                let ours = chosen.state(t)?;
                let third_angle = largest_component(&(ours.equatorial_axis - theirs.equatorial_axis));
                let estimates = chosen.error_estimate(t) + taylor.error_estimate(t);
                most = largest([most, largest([apart(&AxisState::from(&ours)), third_angle]) / estimates]);
            }
        }
        Ok(most)
    })
}
