//! The motion of the symmetry axis and the angular momentum alone, without the angle about the axis.

use nalgebra::Vector3;
use num_dual::Dual64;
use twofold::dynamics::AxisState;
use twofold::dynamics::equations_of_motion::reduced_rates;
use twofold::propagation::Motion;

use super::propagation::{against_reference, estimate_against_reference};
use crate::check::{Bound, Check, Kind, Measured, Worst, largest, largest_component, largest_difference};
use crate::physical_domain::{scenes, worst_over};
use crate::reference::reference_motion;
use crate::second_integrator::axis_states;

/// Checks of this subject.
pub fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "axis-motion-reference",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "the motion of n and L alone reproduces those of a 34-digit integration, ten scenes at every listed time",
            figure: "largest error of a component",
            bound: Bound::AtMost(1e-12),
            reason: "rounding of the initial values (1e-16) and of up to 1,200 steps, grown with a phase of 600 rad",
            measure: against_reference::<AxisState<f64>>,
        },
        Check {
            id: "axis-motion-error-estimate",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "the error estimate of the motion of n and L alone is not below its true error, from accuracy 1e-3 to 1e-14",
            figure: "largest true error / estimate",
            bound: Bound::AtMost(1.0),
            reason: "an estimate below the true error is wrong",
            measure: estimate_against_reference::<AxisState<f64>>,
        },
        Check {
            id: "axis-motion-of-whole-motion",
            kind: Kind::Property,
            equations: &[25],
            statement: "n and L of random motions do not depend on whether e_x is carried along, forwards and backwards in time",
            figure: "largest difference / sum of the two error estimates",
            bound: Bound::AtMost(1.0),
            reason: "the same motion, twice computed with other steps",
            measure: against_whole_motion,
        },
        Check {
            id: "axis-motion-second-integrator",
            kind: Kind::Oracle,
            equations: &[25],
            statement: "between the steps, too, n and L of the paper's four examples are those of a Runge-Kutta method of another crate with dense output",
            figure: "largest difference of a component at 1,000 times up to 100 t_c",
            bound: Bound::AtMost(1e-11),
            reason: "the other method's tolerance 1e-14 per step, added up over some hundred steps and grown with a phase of 150 rad",
            measure: against_second_integrator,
        },
        Check {
            id: "axis-motion-dense-output",
            kind: Kind::Autodiff,
            equations: &[25],
            statement: "the dense output of the motion of n and L, differentiated in time by duals, satisfies dn/dt = L x n / I^xx and dL/dt = -2 C n x (s n)",
            figure: "largest residual / (2.2e-16, size of the rates), 100 random motions",
            bound: Bound::AtMost(16.0),
            reason: "differentiating a series of order 22 multiplies its rounding by up to 22/3; the state and its rates add a few",
            measure: dense_output_solves_equations,
        },
    ]
}

fn against_whole_motion() -> Result<Measured, String> {
    worst_over(23, 200, &scenes(), |scene| {
        let problem = scene.problem();
        let size = problem.initial().momentum.norm().max(1.0);
        let mut most = 0.0;
        for end in [30.0, -30.0] {
            let whole = problem.taylor((0.0, end), 1e-13)?;
            let alone = problem.reduced().taylor((0.0, end), 1e-13)?;
            for part in [0.37, 1.0] {
                let t = part * end;
                let ours = alone.state(t)?;
                let estimates = alone.error_estimate(t) + whole.error_estimate(t);
                for state in [whole.axis_state(t)?, AxisState::from(&whole.state(t)?)] {
                    most = largest([most, largest_difference(&ours, &state, size) / estimates]);
                }
            }
        }
        Ok(most)
    })
}

fn against_second_integrator() -> Result<Measured, String> {
    let times: Vec<f64> = (0..=1000).map(|i| 0.1 * f64::from(i)).collect();
    let mut worst = Worst::default();
    for name in ["tp-1", "tp-2", "sp-1", "sp-2"] {
        let problem = reference_motion(name).problem().reduced();
        let motion = problem.taylor((0.0, 100.0), 1e-14)?;
        for (t, theirs) in times.iter().zip(axis_states(&problem, &times, 1e-14)?) {
            worst.see(largest_difference(&motion.state(*t)?, &theirs, 1.0), || format!("{name} at t = {t}"));
        }
    }
    worst.finish()
}

fn dense_output_solves_equations() -> Result<Measured, String> {
    worst_over(24, 100, &scenes(), |scene| {
        let problem = scene.problem().reduced();
        let motion = problem.map(Dual64::from_re).taylor((0.0, 10.0), 1e-16)?;
        let mut most = 0.0;
        for i in 1..40 {
            let state = motion.state(Dual64::new(0.25 * f64::from(i), 1.0))?;
            let real = |v: &Vector3<Dual64>| v.map(|x| x.re);
            let (axis_rate, momentum_rate) =
                reduced_rates(problem.spheroid(), problem.coefficients(), &real(&state.axis), &real(&state.momentum));
            let residuals = [state.axis.map(|x| x.eps) - axis_rate, state.momentum.map(|x| x.eps) - momentum_rate];
            let size = 1.0 + real(&state.momentum).norm().powi(2);
            most = largest([most, largest(residuals.iter().map(largest_component)) / (size * f64::EPSILON)]);
        }
        Ok(most)
    })
}
