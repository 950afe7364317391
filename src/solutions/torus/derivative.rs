//! Derivatives of the exact motion by a parameter, at a cost that does not depend on time.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;

use super::TorusSolution;
use super::flow::{Axes, Integrals, derivative, joined, tangents};
use super::flow_series::DOUBLE;
use crate::dynamics::{BodyState, Problem, RotationState};
use crate::error::Error;
use crate::numerics::angle::about;
use crate::numerics::scalar::Scalar;

/// What a closed way may leave between a changed start and its end beside the torus, in units of the change.
const CLOSED: f64 = 1e-8;

/// The exact motion as a function of one parameter: the states of a [`TorusSolution`] with their derivatives.
///
/// After `m_1` and `m_2` whole turns of the angles of the torus less than one cell of its closed ways `(t_i, k_i)` is left of the time `t`:
///
/// ```text
/// (n, L)(t) = flow of the start by (t, 0) - m_1 (t_1, k_1) - m_2 (t_2, k_2)
/// e_x(t)    = the vector that this flow carries, turned about n by m_1 psi_1 + m_2 psi_2 - epsilon Omega^z t
/// ```
///
/// The flow, its times and the turn are functions of the parameter, the whole numbers are not. A closed way leads back to the start, whatever the parameter is: that
/// gives the derivatives of `t_i`, `k_i` and `psi_i`, by one flow along each way. Times are in the unit of time of the problem. See `docs/exact-motion.md`.
#[derive(Debug, Clone)]
pub struct TorusDerivative<'a> {
    solution: &'a TorusSolution,
    integrals: Integrals<Dual64>,
    start: Axes<Dual64>,
    periods: [[Dual64; 2]; 2],
    /// Derivatives of the turns along both closed ways, and of the rate of `e_x` about `n` against the vector that the flow of `H` carries.
    turns: [f64; 2],
    spin: f64,
}

impl<'a> TorusDerivative<'a> {
    /// For the solution of a problem, and the same problem as a function of one parameter.
    ///
    /// # Errors
    /// [`Error::NotConverged`] where the tori beside that of the motion have not its closed ways: `n` on `L`, `L` on an axis, the separatrix.
    pub fn new(solution: &'a TorusSolution, problem: &Problem<Dual64>) -> Result<Self, Error> {
        let (spheroid, coefficients) = (problem.spheroid(), problem.coefficients());
        let torus_from_given = solution.given_from_torus.transpose().map(Dual64::from_re);
        let tensor = torus_from_given * coefficients * torus_from_given.transpose();
        let tensor = tensor - Matrix3::from_diagonal_element(Dual64::from_re(tensor.m22.re));
        let start = problem.initial().rotated(&torus_from_given).vectors();
        let spin = -spheroid.oblateness() * start[1].dot(&start[0]) / spheroid.inertia_zz;
        let mut found = Self {
            solution,
            integrals: Integrals::new(spheroid, &tensor, Dual64::from_re(solution.spread), DOUBLE),
            start,
            periods: solution.periods.map(|times| times.map(Dual64::from_re)),
            turns: [0.0; 2],
            spin: spin.eps,
        };
        let size = solution.unit;
        let longest = [0, 1].map(|flow| solution.periods.iter().map(|times| times[flow].abs()).fold(0.0, f64::max));
        let change = joined(&start, size, derivative);
        for (period, turn) in found.periods.iter_mut().zip(&mut found.turns) {
            let mut end = found.integrals.moved(*period, &start);
            let open = change - joined(&end, size, derivative);
            let not_closed = |residual| Error::NotConverged {
                what: "closed ways of the tori beside that of the motion",
                iterations: 1,
                residual,
            };
            if !open.norm().is_finite() {
                return Err(not_closed(f64::NAN));
            }
            let rates = found.integrals.both_rates(&end);
            let tangents = tangents(&rates, size);
            let svd = tangents.svd(true, true);
            let slopes =
                svd.solve(&open, f64::EPSILON * svd.singular_values.max()).expect("both factors were asked for");
            // Not all flows change with the parameter.
            let along = [0, 1].map(|flow| longest[flow] * joined(&rates[flow], size, derivative).norm());
            let (left, most) = ((open - tangents * slopes).norm(), change.norm() + open.norm() + along[0] + along[1]);
            if left > CLOSED * most {
                return Err(not_closed(left / most));
            }
            for ((time, slope), rates) in period.iter_mut().zip(&slopes).zip(&rates) {
                time.eps = *slope;
                end.iter_mut().zip(rates).for_each(|(end, rate)| *end += rate * Dual64::new(0.0, *slope));
            }
            *turn = about(&end[0], &start[2], &end[2]).eps;
        }
        Ok(found)
    }

    /// The state at the time `t[0] + t[1]` since the start, with its derivative: values are those of the solution.
    pub fn state(&self, t: [f64; 2]) -> BodyState<Dual64> {
        let mut times = [Dual64::from_re(0.0); 2];
        let mut turn = Dual64::new(0.0, self.spin * (t[0] + t[1]));
        for ((period, by_parameter), phase) in self.periods.iter().zip(self.turns).zip(&self.solution.phases) {
            let [whole, part] = phase.passed(t);
            turn.eps += whole * by_parameter;
            times.iter_mut().zip(period).for_each(|(time, way)| *time += Dual64::new(part * way.re, -whole * way.eps));
        }
        let given_from_torus = self.solution.given_from_torus.map(Dual64::from_re);
        let [n, momentum, u] = self.integrals.moved(times, &self.start).map(|v| given_from_torus * v);
        let value = self.solution.state(t);
        turn.re = about(&n, &u, &value.equatorial_axis.map(Dual64::from_re)).re;
        let (sin, cos) = turn.sin_cos();
        let changing = [n, momentum, u * cos + n.cross(&u) * sin];
        let both = |value: Vector3<f64>, changing: Vector3<Dual64>| {
            value.zip_map(&changing, |value, changing| Dual64::new(value, changing.eps))
        };
        let [n, momentum, e_x] = value.vectors();
        BodyState {
            axis: both(n, changing[0]),
            momentum: both(momentum, changing[1]),
            equatorial_axis: both(e_x, changing[2]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::fixture::{ANGLES, RATES, STAR, tensor};
    use crate::parameters::{Parameter, Parameters};
    use crate::propagation::Motion;
    use crate::solutions::steady::fixture::steady_precession;

    fn derivatives(state: &BodyState<Dual64>) -> [Vector3<f64>; 3] {
        state.vectors().map(|v| v.map(|x| x.eps))
    }

    /// Also with two equal or nearly equal eigenvalues, whose axes turn with any change, and where the frame of `s` turns by 1e7 rad for a change by one.
    #[test]
    fn derivatives_are_those_of_the_series_in_time() {
        for s in [[0.02, 0.01, -0.03], [0.2, 0.2, -0.4], [0.2, 0.2 + 1e-11, -0.4], [2e-7, 1e-7, -3e-7]] {
            let start = Parameters::new(STAR, tensor(s), ANGLES, RATES);
            let solution = TorusSolution::new(&start.problem().unwrap(), 1e-15, 40.0).unwrap();
            for parameter in Parameter::OF_MOTION {
                let problem = start.seeded(parameter).problem().unwrap();
                let torus = TorusDerivative::new(&solution, &problem).unwrap();
                let series = problem.taylor((0.0, 40.0), 1e-16).unwrap();
                for t in [0.0, 3.1, 40.0] {
                    let state = torus.state([t, 0.0]);
                    assert_eq!(state.vectors().map(|v| v.map(|x| x.re)), solution.state([t, 0.0]).vectors());
                    let [found, expected] =
                        [state, series.state(Dual64::from_f64(t)).unwrap()].map(|s| derivatives(&s));
                    let size = expected.iter().fold(1e-3, |most: f64, v| most.max(v.amax()));
                    let off = (0..3).fold(0.0, |most: f64, i| most.max((found[i] - expected[i]).amax()));
                    assert!(off < 1e-12 * size, "{s:?}, {parameter:?} at {t}: {off:e} of {size:e}");
                    // The same time in two parts.
                    let parts = derivatives(&torus.state([t - 1.75, 1.75]));
                    let off = (0..3).fold(0.0, |most: f64, i| most.max((parts[i] - expected[i]).amax()));
                    assert!(off < 1e-12 * size, "{s:?}, {parameter:?} at {t} in two parts: {off:e} of {size:e}");
                }
            }
        }
    }

    /// A turn of everything about Z turns every state, after any time.
    #[test]
    fn a_turn_of_everything_turns_the_state() {
        let start = Parameters::new(STAR, tensor([0.1, 0.1, -0.2]), ANGLES, RATES);
        let solution = TorusSolution::new(&start.problem().unwrap(), 1e-15, 1e9).unwrap();
        let problem = start.seeded(Parameter::Alpha).problem().unwrap();
        let state = TorusDerivative::new(&solution, &problem).unwrap().state([1e9, 0.1]);
        for (found, v) in derivatives(&state).iter().zip(solution.state([1e9, 0.1]).vectors()) {
            // Rounding in the derivative of a closed way, by the number of ways.
            assert!((found - Vector3::z().cross(&v)).amax() < 1e-15 * 1e9, "{found} {v}");
        }
    }

    /// A steady precession has a series, on a circle, and no derivatives.
    #[test]
    fn a_steady_precession_has_no_torus_of_its_neighbours() {
        for (spin, beta) in [(1.5, ANGLES.beta), (1.1, 0.3), (2.7, 1.2), (-1.9, 2.2), (6.0, 0.9), (0.7, 2.9)] {
            let problem = steady_precession(spin, beta).0;
            let solution = TorusSolution::new(&problem, 1e-12, 1.0).unwrap();
            let height = |t: f64| solution.state([t, 0.0]).axis.z;
            assert!((height(7.3) - beta.cos()).abs() < 1e-12, "{beta}: {}", height(7.3));
            let found = solution.error_of_derivatives();
            assert!(matches!(found, Err(Error::NotConverged { .. })), "{found:?}");
        }
    }
}
