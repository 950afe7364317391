//! The motion of the symmetry axis and the angular momentum alone, without the angle about the axis.

use super::propagation::{against_reference, estimate_against_truth};
use crate::prelude::*;
use crate::second_integrator::axis_states;

checks! {
    /// the motion of n and L alone reproduces those of a 34-digit integration, ten scenes at every listed time
    Oracle "axis-motion-reference" [25]: against_reference::<AxisState<f64>>;
    AtMost(1e-12) "largest error of a component";
    because "rounding of the initial values (1e-16) and of up to 1,200 steps, grown with a phase of 600 rad";
    /// the error estimate of the motion of n and L alone is not below its true error, from tolerance 1e-3 to 1e-14
    Oracle "axis-motion-error-estimate" [25]: estimate_against_truth::<AxisState<f64>>;
    AtMost(1.0) "largest true error / estimate";
    because "an estimate below the true error is wrong";
    /// n and L of random motions do not depend on whether e_x is carried along, forwards and backwards in time
    Property "axis-motion-of-whole-motion" [25]: against_whole_motion;
    AtMost(1.0) "largest difference / sum of the two error estimates";
    because "the same motion, computed twice with other steps";
    /// also between the steps, n and L of the paper's four examples agree with a Runge-Kutta method of another crate with dense output
    Oracle "axis-motion-second-integrator" [25]: against_second_integrator;
    AtMost(1e-11) "largest difference of a component at 1,000 times up to 100 t_c";
    because "the other method's tolerance 1e-14 per step, added up over some hundred steps and grown with a phase of 150 rad";
    /// the dense output of the motion of n and L, differentiated in time by duals, satisfies dn/dt = L x n / I^xx and dL/dt = -2 C n x (s n)
    Autodiff "axis-motion-dense-output" [25]: dense_output_solves_equations;
    AtMost(16.0) "largest residual / (2.2e-16, size of the rates), 100 random motions";
    because "differentiating a series of order 22 multiplies its rounding by up to 22/3; the state and its rates add a few";
}

fn against_whole_motion() -> Result<Measured, String> {
    worst_over(23, 200, &scenes(), |scene| {
        let problem = scene.problem();
        let size = problem.initial().momentum.norm().max(1.0);
        worst_of([30.0, -30.0], |&end| {
            let whole = problem.taylor((0.0, end), 1e-13)?;
            let alone = problem.reduced().taylor((0.0, end), 1e-13)?;
            worst_of([0.37 * end, end], |&t| {
                let ours = alone.state(t)?;
                let estimates = alone.error_estimate(t) + whole.error_estimate(t);
                let states = [whole.axis_state(t)?, whole.state(t)?.axis_state()];
                Ok(largest(states.map(|state| largest_difference(&ours, &state, size) / estimates)))
            })
        })
    })
}

fn against_second_integrator() -> Result<Measured, String> {
    let times: Vec<f64> = (0..=1000).map(|i| 0.1 * f64::from(i)).collect();
    worst_of(["tp-1", "tp-2", "sp-1", "sp-2"], |name| {
        let problem = reference_motion(name).problem().reduced();
        let motion = problem.taylor((0.0, 100.0), 1e-14)?;
        let theirs = axis_states(&problem, &times, 1e-14)?;
        worst_of(times.iter().zip(theirs), |(t, theirs)| Ok(largest_difference(&motion.state(**t)?, theirs, 1.0)))
    })
}

fn dense_output_solves_equations() -> Result<Measured, String> {
    worst_over(24, 100, &scenes(), |scene| {
        let problem = scene.problem().reduced();
        let motion = problem.map(Dual64::from_re).taylor((0.0, 10.0), 1e-16)?;
        worst_of(1..40, |&i| {
            let state = motion.state(Dual64::new(0.25 * f64::from(i), 1.0))?;
            let real = |v: &Vector3<Dual64>| v.map(|x| x.re);
            let (axis_rate, momentum_rate) =
                reduced_rates(problem.spheroid(), problem.coefficients(), &real(&state.axis), &real(&state.momentum));
            let residuals = [state.axis.map(|x| x.eps) - axis_rate, state.momentum.map(|x| x.eps) - momentum_rate];
            let size = 1.0 + real(&state.momentum).norm().powi(2);
            Ok(largest(residuals.iter().map(largest_component)) / (size * f64::EPSILON))
        })
    })
}
