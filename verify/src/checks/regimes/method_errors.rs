//! Errors of the closed-form motions relative to the numerical one, as functions of the strength of the torque and of time.

use super::perturbation_error::{Case, axis_at};
use crate::prelude::*;
use twofold::propagation::TorusMotion;

/// Tolerance of the numerical motion and of the series on the torus.
const TOLERANCE: f64 = 1e-13;

/// `s_max - s_min` of the examples.
const SPREAD: f64 = 0.06;

/// Iterations for a strength; each reduces the error by about the strength.
const ITERATIONS: usize = 8;

/// Samples between two times.
const SAMPLES: u32 = 10;

checks! {
    /// n, L and e_x of the averaged motion have errors below 3 x^2 + 1.5 x^2 t to first order and 3 x^2 + 5 x^3 t to second, t in t_c: L near Z
    /// and tilted, single precession, near the separatrix
    Regime "averaged-motion-regimes" [25, 57]: averaged_motions;
    AtMost(1.0) "largest error over that, x from 1e-5 to 1e-2, t to 3,000 t_c";
    because "the periodic part of second order, and rates of the next order, with coefficients of order one";
}

fn averaged_motions() -> Result<Measured, String> {
    worst_of(Geometry::ALL, |&geometry| {
        worst_of([1e-5, 1e-4, 1e-3, 1e-2], |&x| {
            worst_of(
                errors(geometry, x, &[1.0, 10.0, 100.0, 1000.0, 3000.0])?,
                |&Errors { time, averaged_state, .. }| {
                    let [first, second] = averaged_state;
                    let allowed = [3.0 * x * x + 1.5 * x * x * time, 3.0 * x * x + 5.0 * x.powi(3) * time];
                    Ok(largest([first / allowed[0], second / allowed[1]]))
                },
            )
        })
    })
}

/// Geometry of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Geometry {
    /// Twofold precession with the angular momentum near Z, as tp-I.
    NearAxis,
    /// With tilted angular momentum, as tp-II.
    Tilted,
    /// Single precession, as sp-I.
    Single,
    /// Twofold precession, `k'^2` of 1e-3 from the separatrix through the middle axis.
    NearSeparatrix,
}

impl Geometry {
    /// All geometries.
    pub const ALL: [Self; 4] = [Self::NearAxis, Self::Tilted, Self::Single, Self::NearSeparatrix];

    /// The printed and the corrected perturbation solution for such motions, for the examples' `s` scaled by `k`. The amplitude
    /// `A` of single precession is of the order of `s`.
    fn cases(self, k: f64) -> Option<[Case; 2]> {
        let (kind, amplitude) = match self {
            Self::NearAxis => (Precession::Twofold, 0.0),
            Self::Tilted => (Precession::Twofold, 0.4),
            Self::Single => (Precession::Single, 0.01 * k),
            Self::NearSeparatrix => return None,
        };
        Some([Form::Printed, Form::Corrected].map(|form| Case::paper(form, kind, k, 0.7, amplitude)))
    }
}

/// Largest errors up to a time; `None` for a solution that does not describe such motions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// The end of the interval.
    pub time: f64,
    /// Distance between the heads of the true axis and that of the printed perturbation solution.
    pub printed: Option<f64>,
    /// For the corrected solution.
    pub corrected: Option<f64>,
    /// Error of the axis in the averaged motion of first and second order.
    pub averaged: [f64; 2],
    /// The same for the largest distance of `n`, `L / |L|` or `e_x`.
    pub averaged_state: [f64; 2],
    /// Error of the axis in the series on the torus.
    pub torus: f64,
}

/// Errors up to given times, for the examples' `s` scaled so that the strength of the torque, `C (s_max - s_min) I^xx / L.L`, is the given one.
pub fn errors(geometry: Geometry, strength: f64, times: &[f64]) -> Result<Vec<Errors>, String> {
    let start = |k: f64| match geometry.cases(k) {
        Some([printed, _]) => printed.problem().map(|problem| *problem.initial()),
        None => Ok(by_separatrix()),
    };
    // The initial L depends weakly on s.
    let mut k = strength;
    for _ in 0..ITERATIONS {
        k = strength * start(k)?.momentum.norm_squared() / SPREAD;
    }
    let s = PrincipalCoefficients::new([0.02, 0.01, -0.04]).scaled(k);
    let problem = Problem::new(RigidSpheroid::in_units_of_tc(1.1), s.tensor(), start(k)?)?;
    let span = (0.0, *times.last().ok_or("no times")?);
    let exact = problem.taylor(span, TOLERANCE)?;
    let averaged = [AveragingOrder::First, AveragingOrder::Second].map(|order| AveragedSolution::new(&problem, order));
    let [first, second] = averaged;
    let averaged = [first?, second?];
    let torus = TorusMotion::new(&problem, span, TOLERANCE)?;
    // Each perturbation solution is compared with the motion from its own initial values.
    let mut solutions = Vec::new();
    for case in geometry.cases(k).into_iter().flatten() {
        solutions.push((case.solution()?, case.problem()?.taylor(span, TOLERANCE)?, 0.0));
    }
    let (mut rows, mut from) = (Vec::new(), 0.0);
    let (mut axis_errors, mut state_errors, mut torus_error) = ([0.0; 2], [0.0; 2], 0.0);
    for &time in times {
        for sample in 1..=SAMPLES {
            let t = (from + (time - from) * f64::from(sample) / f64::from(SAMPLES)).min(span.1);
            let state = exact.state(t)?;
            torus_error = largest([torus_error, (torus.state(t)?.axis - state.axis).norm()]);
            for (i, solution) in averaged.iter().enumerate() {
                let BodyState { axis, momentum, equatorial_axis } = solution.state(t);
                let off = (axis - state.axis).norm();
                let direction = (momentum - state.momentum).norm() / state.momentum.norm();
                axis_errors[i] = largest([axis_errors[i], off]);
                state_errors[i] =
                    largest([state_errors[i], off, direction, (equatorial_axis - state.equatorial_axis).norm()]);
            }
            for (solution, own, error) in &mut solutions {
                *error = largest([*error, (own.axis_state(t)?.axis - axis_at(solution, t)).norm()]);
            }
        }
        let of = |i: usize| solutions.get(i).map(|(.., error)| *error);
        rows.push(Errors {
            time,
            printed: of(0),
            corrected: of(1),
            averaged: axis_errors,
            averaged_state: state_errors,
            torus: torus_error,
        });
        from = time;
    }
    Ok(rows)
}

/// `L` near the middle axis, displaced towards the third one, and the symmetry axis 0.7 rad from it.
fn by_separatrix() -> BodyState<f64> {
    // k'^2 = 6 l_3^2 for the examples' s.
    let third = (1e-3_f64 / 6.0).sqrt();
    let l = Vector3::new(0.0, (1.0 - third * third).sqrt(), third);
    let across = Vector3::x();
    let axis = l * f64::cos(0.7) + across * f64::sin(0.7);
    BodyState { axis, momentum: l * 1.5, equatorial_axis: l.cross(&across) }
}
