//! Splitting schemes: order conditions, measured orders, conserved quantities, agreement with the Taylor motion, estimates.

mod many;
mod order_conditions;

use crate::prelude::*;
use twofold::propagation::splitting::{
    GRADIENT_8_6_4, GRADIENT_8_6_6, GRADIENT_8_8_6, NEAR_INTEGRABLE_6_2, NEAR_INTEGRABLE_10_4, SCHEMES, SRKN_6B,
    Scheme, Splitting,
};

checks! {
    /// the logarithm of one step of every scheme is A + B up to the orders claimed, with one, two, three and more kicks
    Property "splitting-order-conditions" [25]: order_conditions::residuals;
    AtMost(2e-15) "largest coefficient that should vanish";
    because "weights are rounded to 1e-16; the logarithm adds up some hundred products of size one, a random walk of 1e-15";
    /// the error of every scheme falls with the step as its order says, at s of order one
    Regime "splitting-orders" [25]: measured_orders;
    AtMost(0.35) "largest |measured - claimed| order";
    because "the next term of the error is smaller by the square of the step, at most a tenth here";
    /// the error of the near-integrable schemes at large steps is of first order in s
    Regime "splitting-near-integrable" [25]: factor_of_violation;
    AtMost(0.1) "largest |measured exponent of s - 1|";
    because "terms of second order in s are below a hundredth where s is below 1e-5";
    /// |n| and L.n keep their values over 1e6 steps of every scheme, tp-II
    Property "splitting-casimirs" [24]: casimirs;
    AtMost(2e-14) "largest of ||n| - 1| and |L.n - its start|";
    because "rounding of at most 64 steps of 17 stages, each some 1e-16, added up at random: 33 times 2e-16";
    /// 300 steps of every scheme forth and as many back return to the start, tp-II: the schemes are symmetric
    Property "splitting-time-reversal" [25]: time_reversal;
    AtMost(1e-12) "largest component of the difference";
    because "rounding of 600 steps, at most 10,200 stages of 1e-16 added up at random, 1e-14, and grown with a phase of 700 rad, which they spread over";
    /// n, L and e_x of the ten reference scenes are those of a 34-digit integration, at small imposed steps
    Oracle "splitting-reference" [25]: against_reference;
    AtMost(2e-12) "largest error of a component";
    because "truncation at steps of 0.1 t_c (5.7e-12 were measured at 0.15, sp-II at 400 t_c, and it falls with the sixth power), rounding grown \
     with a phase of 600 rad";
    /// n, L and e_x of 200 random motions by the chosen scheme, n and L by a prescribed one, agree with the Taylor motion, also within steps and
    /// backwards
    Oracle "splitting-taylor-motion" [25]: against_taylor_motion;
    AtMost(1.0) "largest difference / sum of the two error estimates";
    because "the same motion, computed in two ways; each states its error";
    /// values and errors of 90 random motions side by side do not depend on their neighbours: alone, with other motions, in another order, at
    /// several times, backwards
    Property "splitting-many-motions" [25]: many::neighbours;
    AtMost(0.0) "number of motions with other bits";
    because "no operation combines two lanes";
    /// 90 random motions side by side agree with the Taylor motion to the requested tolerances, from 1e-3 to 1e-14
    Oracle "splitting-many-accuracy" [25]: many::tolerance;
    AtMost(1.0) "largest difference / (tolerance + error estimate of the Taylor motion)";
    because "the error may reach the tolerance; where rounding is larger, it is as large as that of the Taylor motion, which its estimate counts";
}

fn tp_2() -> Problem<f64, AxisState<f64>> {
    reference_motion("tp-2").problem().reduced()
}

/// The step taken by `scheme`, and its largest error at 20 times up to 10 t_c of tp-II with s multiplied by `factor`.
fn error_of(scheme: &'static Scheme, factor: f64, step: f64) -> Result<(f64, f64), Error> {
    let tp_2 = tp_2();
    let problem = Problem::new(*tp_2.spheroid(), tp_2.coefficients() * factor, *tp_2.initial())?;
    let truth = problem.taylor((0.0, 10.0), 1e-16)?;
    let motion = problem.splitting_by(scheme, (0.0, 10.0), step)?;
    let times = (1..=20).map(|i| 0.5 * f64::from(i));
    let errors = times.map(|t| Ok(largest_difference(&motion.state(t)?, &truth.state(t)?, 1.0)));
    Ok((motion.step(), largest_of(errors)?))
}

fn measured_orders() -> Result<Measured, String> {
    let mut errors = Vec::new();
    for scheme in SCHEMES {
        let largest_step = 0.06 * scheme.stages() as f64;
        let points = (0..16).map(|k| error_of(scheme, 20.0, largest_step / 1.15_f64.powi(k)));
        let mut points = points.collect::<Result<Vec<_>, _>>()?;
        // Smaller errors are rounding.
        points.retain(|(_, error)| *error > 1e-12);
        errors.push((scheme.name, f64::from(scheme.order()), points.split_off(points.len().saturating_sub(5))));
    }
    largest_off_order(errors)
}

fn factor_of_violation() -> Result<Measured, String> {
    let mut errors = Vec::new();
    for (scheme, step) in [
        (&NEAR_INTEGRABLE_6_2, 1.6),
        (&NEAR_INTEGRABLE_10_4, 3.0),
        (&GRADIENT_8_6_4, 1.6),
        (&GRADIENT_8_6_6, 2.0),
        (&GRADIENT_8_8_6, 2.5),
    ] {
        let factors = [0, 1, 2, 3].map(|k| 1e-4 / 4f64.powi(k));
        errors.push((scheme.name, 1.0, errors_at(factors, |factor| Ok(error_of(scheme, factor, step)?.1))?));
    }
    largest_off_order(errors)
}

fn casimirs() -> Result<Measured, String> {
    let problem = tp_2();
    let spin = |state: &AxisState<f64>| state.axis.dot(&state.momentum);
    worst_of(SCHEMES, |scheme| {
        let mut motion = Splitting::new(&problem, scheme, 0.1 * scheme.stages() as f64)?;
        // Not a multiple of the steps between projections.
        worst_of([99_999; 10], |&steps| {
            motion.advance(steps);
            let state = motion.state();
            let drift = spin(&state) - spin(problem.initial());
            Ok(largest([(state.axis.norm() - 1.0).abs(), drift.abs()]))
        })
    })
}

fn time_reversal() -> Result<Measured, String> {
    worst_of(SCHEMES, |scheme| {
        let (problem, step) = (tp_2(), 0.1 * scheme.stages() as f64);
        let mut motion = Splitting::new(&problem, scheme, step)?;
        motion.advance(300);
        let mut back = Splitting::new(&problem.starting_from(motion.state())?, scheme, -step)?;
        back.advance(300);
        Ok(largest_difference(&back.state(), problem.initial(), 1.0))
    })
}

fn against_reference() -> Result<Measured, String> {
    worst_of(reference_motions(), |reference| {
        let end = reference.states.last().map_or(0.0, |(t, _)| *t);
        let motion = reference.problem().splitting_by(&GRADIENT_8_8_6, (0.0, end), 0.1)?;
        worst_of(&reference.states, |(t, state)| Ok(largest_difference(&motion.state(*t)?, state, 1.0)))
    })
}

fn against_taylor_motion() -> Result<Measured, String> {
    worst_over(25, 200, &scenes(), |scene| {
        let problem = scene.problem();
        let size = problem.initial().momentum.norm().max(1.0);
        worst_of([40.0, -40.0], |&end| {
            let span = (0.0, end);
            let taylor = problem.taylor(span, 1e-14)?;
            let forced = problem.reduced().splitting_by(&SRKN_6B, span, 0.3)?;
            let chosen = problem.splitting(span, 1e-9)?;
            worst_of([0.13 * end, 0.5 * end, 0.77 * end, end], |&t| {
                let theirs = taylor.state(t)?;
                let estimates =
                    [forced.error_estimate(t), chosen.error_estimate(t)].map(|e| e + taylor.error_estimate(t));
                let forced = largest_difference(&forced.state(t)?, &theirs.axis_state(), size);
                let chosen = largest_difference(&chosen.state(t)?, &theirs, size);
                Ok(largest([forced / estimates[0], chosen / estimates[1]]))
            })
        })
    })
}
